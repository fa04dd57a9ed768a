//! What several models read from their variables and setups alike.

use std::collections::BTreeSet;

use fmi_export::{
    Choice, Enumeration, Failure, Integer, Knowns, Real, RealMatrix, RealVector, SetupError, Values,
    Variables,
};
use nalgebra::Matrix3;
use physics::bodies::surface::{self, MERCURY, PlanetSurface};
use physics::radiation::disturbance::{DisturbanceModel, Options};
use physics::spacecraft::{self, Spacecraft};
use serde::Serialize;

/// How the day side's temperature is distributed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum DayTemperature {
    /// One temperature for the whole day side (paper 004, eq 32).
    Uniform = 1,
    /// Local balance: the fourth power of temperature goes with the cosine of the Sun's zenith angle.
    Cosine = 2,
    /// The night's temperature everywhere, as under an atmosphere.
    Isothermal = 3,
}

impl From<DayTemperature> for surface::DayTemperature {
    fn from(choice: DayTemperature) -> Self {
        match choice {
            DayTemperature::Uniform => Self::Uniform,
            DayTemperature::Cosine => Self::Cosine,
            DayTemperature::Isothermal => Self::Isothermal,
        }
    }
}

/// What a planet's surface does with sunlight; the defaults are Mercury's as they fit paper 004, which prints none.
#[derive(Variables)]
pub struct SurfaceVariables {
    /// Fraction of sunlight the planet absorbs; 0.88 fits paper 004, which does not print it.
    #[parameter(unit = "1", min = 0.0, max = 1.0, start = MERCURY.absorptivity)]
    pub absorptivity: Real,
    /// Fraction of sunlight the planet reflects diffusely; 0.12 fits paper 004, which does not print it.
    #[parameter(unit = "1", min = 0.0, max = 1.0, start = MERCURY.diffuse_reflectivity)]
    pub diffuse_reflectivity: Real,
    /// Infrared emissivity of the planet; 0.9 fits paper 004, which does not print it.
    #[parameter(unit = "1", min = 0.0, max = 1.0, start = MERCURY.emissivity)]
    pub emissivity: Real,
    /// Temperature of the planet's night side; 100 K fits paper 004, which does not print it.
    #[parameter(unit = "K", min = 0.0, max = 1e4, start = MERCURY.night_temperature_k)]
    pub night_temperature: Real,
    /// How the temperature of the planet's day side is distributed.
    #[parameter(start = DayTemperature::Uniform)]
    pub day_temperature: Choice<DayTemperature>,
}

/// Bound on the work of one step.
#[derive(Variables)]
pub struct WorkLimit {
    /// Most work a step may take, in units of about a microsecond; a step that would take more fails and says how far it
    /// came. The default is more than twice what a Mercury year with every effect takes.
    #[parameter(min = 1_000, max = 1_000_000_000, start = 20_000_000)]
    pub work_limit: Integer,
}

impl WorkLimit {
    /// The units.
    pub fn units(&self, values: &Values) -> u32 {
        values.integer(self.work_limit).unsigned_abs()
    }
}

impl SurfaceVariables {
    /// The surface of a planet of this radius; not checked yet.
    pub fn read(&self, values: &Values, radius: Real) -> PlanetSurface {
        PlanetSurface {
            radius_m: values.real(radius),
            absorptivity: values.real(self.absorptivity),
            diffuse_reflectivity: values.real(self.diffuse_reflectivity),
            emissivity: values.real(self.emissivity),
            night_temperature_k: values.real(self.night_temperature),
            day_temperature: values
                .choice(self.day_temperature)
                .map_or(surface::DayTemperature::Uniform, Into::into),
        }
    }
}

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
