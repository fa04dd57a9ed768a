//! What several models read from their spacecraft alike.

use std::collections::BTreeSet;

use fmi_export::{Failure, Knowns, RealMatrix, RealVector, SetupError, Values};
use nalgebra::Matrix3;
use physics::momentum::WheelArray;
use physics::radiation::SolarModel;
use physics::radiation::disturbance::{DisturbanceModel, Options};
use physics::spacecraft::{self, Spacecraft, SunshadeModel};
use serde::Serialize;

/// The inertia in body axes that `spacecraft.inertia` holds by rows, in kg m2.
///
/// # Errors
/// What was found and what is allowed, of a matrix no body has.
pub fn inertia_body_kg_m2(values: &Values, handle: RealMatrix<3, 3>) -> Result<Matrix3<f64>, Failure> {
    let rows = values.matrix(handle);
    let inertia = Matrix3::from(rows).transpose();
    spacecraft::check_inertia(&inertia)
        .map_err(|allowed| Failure::new(format!("spacecraft.inertia is {rows:?}, allowed: {allowed}")))?;
    Ok(inertia)
}

/// A spacecraft prepared for sunlight with its shade in each shape.
#[derive(Clone, Debug)]
pub struct PreparedShapes {
    /// The shade as plates; absent if the file describes it as a cylinder only.
    plates: Option<SolarModel>,
    /// The shade as a cylinder.
    cylinder: Option<SolarModel>,
}

impl PreparedShapes {
    /// Of one spacecraft.
    pub fn of(spacecraft: &Spacecraft) -> Self {
        let prepared = |model| SolarModel::with_sunshade_model(spacecraft, model).ok();
        Self { plates: prepared(SunshadeModel::Plates), cylinder: prepared(SunshadeModel::Cylinder) }
    }

    /// The shape asked for, of the spacecraft of this name.
    ///
    /// # Errors
    /// A shape that the file does not describe.
    pub fn solar(&self, model: SunshadeModel, name: &str) -> Result<&SolarModel, Failure> {
        let prepared = match model {
            SunshadeModel::Plates => &self.plates,
            SunshadeModel::Cylinder => &self.cylinder,
        };
        prepared.as_ref().ok_or_else(|| {
            let (asked, other) = match model {
                SunshadeModel::Plates => ("plates", "cylinder"),
                SunshadeModel::Cylinder => ("cylinder", "plates"),
            };
            Failure::new(format!(
                "sunshade.shape: found {asked}, allowed: {other}, as which alone the spacecraft.toml of {name} describes the \
                 shade"
            ))
        })
    }
}

/// The dump threshold; without one in the file what its wheels guarantee, and without wheels in all directions paper
/// 000's for small wheels.
pub fn dump_threshold_n_m_s(spacecraft: &Spacecraft, wheel_array: Option<&WheelArray>) -> [f64; 3] {
    let smallest_n_m_s = spacecraft::PAPER_DUMP_THRESHOLDS_N_M_S[0].1;
    let capacities_n_m_s = spacecraft.wheels.iter().map(|wheel| wheel.capacity_n_m_s);
    let guaranteed_n_m_s = wheel_array.map(|it| it.guaranteed_threshold_n_m_s(capacities_n_m_s));
    spacecraft.dump_threshold_n_m_s.map_or([guaranteed_n_m_s.unwrap_or(smallest_n_m_s); 3], Into::into)
}

/// A face whose temperature and force are reported.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReportedFace {
    /// What the file calls its surface, and whether it is the rear.
    pub name: String,
    /// The panel it belongs to, if to one.
    pub panel: Option<usize>,
    /// Whether another surface can shadow it, or the face it shares heat with.
    pub shadowed: bool,
    /// The panels whose angle changes its light and heat: its own, and those that can shadow it.
    pub lit_past: BTreeSet<usize>,
    /// Whether its recoil can push along each body axis.
    pub recoils_along: [bool; 3],
    /// Whether it stores heat.
    pub stores_heat: bool,
}

/// The faces reported one by one, none unless the file asks for that.
pub fn reported_faces(file: &str, spacecraft: &Spacecraft) -> Result<Vec<ReportedFace>, SetupError> {
    if !spacecraft.per_plate_outputs {
        return Ok(Vec::new());
    }
    let model = DisturbanceModel::new(spacecraft, &Options::default())
        .map_err(|error| SetupError(format!("{file}: {error}")))?;
    let faces = model.face_names().zip(model.face_panels()).enumerate();
    let reported = |(face, (name, panel)): (usize, (String, Option<usize>))| {
        let shadowers = model.shadowers(face);
        ReportedFace {
            name,
            panel,
            shadowed: !shadowers.is_empty(),
            lit_past: shadowers.into_iter().chain([panel]).flatten().collect(),
            recoils_along: [0, 1, 2].map(|axis| model.recoils_along(face, axis)),
            stores_heat: model.face_stores_heat(face),
        }
    };
    Ok(faces.map(reported).collect())
}

/// Whether the file describes the shade in both shapes, so that a shape can be chosen.
pub fn has_both_shapes(spacecraft: &Spacecraft) -> bool {
    let both = [spacecraft::SunshadeModel::Plates, spacecraft::SunshadeModel::Cylinder];
    spacecraft.sunshade.as_ref().is_some_and(|shade| both.into_iter().all(|shape| shade.has(shape)))
}

/// Whether any surface can shadow another.
pub fn can_shadow(spacecraft: &Spacecraft) -> bool {
    DisturbanceModel::new(spacecraft, &Options::default()).is_ok_and(|model| model.can_shadow())
}

/// Elements of an inertia that a gravity gradient's torque about `axis` does not pass by: all but its own moment.
pub fn inertia_about_others(inertia: RealMatrix<3, 3>, axis: usize) -> Knowns {
    let all = (0..9).map(|i| (i / 3, i % 3)).filter(|&at| at != (axis, axis));
    all.map(|(row, column)| inertia.element(row, column)).collect()
}

/// Elements of an inertia that count for the momentum along `axis`: its row, and its column, which is the same.
pub fn inertia_along(inertia: RealMatrix<3, 3>, axis: usize) -> Knowns {
    (0..3).flat_map(|i| [inertia.element(axis, i), inertia.element(i, axis)]).collect()
}

/// Components of a centre of mass that count for a torque about `axis`: those across it.
pub fn across(center_of_mass: RealVector<3>, axis: usize) -> Knowns {
    (0..3).filter(|&i| i != axis).map(|i| center_of_mass.element(i)).collect()
}

/// Whether a panel's angle changes its force along a body axis beyond how much light falls on it: not if it turns about
/// that axis and shadows nothing.
pub fn turns_out_of(spacecraft: &Spacecraft, panel: usize, axis: usize) -> bool {
    spacecraft.panels.get(panel).is_some_and(|panel| {
        panel.axis_body[axis].abs() < 1.0 || panel.polygon.is_some() && can_shadow(spacecraft)
    })
}

/// Whether the shade's shape changes its recoil along a body axis.
pub fn shape_recoils_along(spacecraft: &Spacecraft, axis: usize) -> bool {
    has_both_shapes(spacecraft) && spacecraft.sunshade.as_ref().is_some_and(|shade| shade.faces_along(axis))
}

/// Whether a face that stores heat can be shadowed: it radiates over all of itself then, otherwise from where it is lit.
pub fn stores_heat_in_shadow(spacecraft: &Spacecraft) -> bool {
    DisturbanceModel::new(spacecraft, &Options::default()).is_ok_and(|model| {
        (0..model.face_count()).any(|face| model.face_stores_heat(face) && !model.shadowers(face).is_empty())
    })
}
