//! What several models read from their spacecraft alike.

use fmi_export::{Failure, RealMatrix, SetupError, Values};
use nalgebra::Matrix3;
use physics::guidance::downlink::default_downlink::DefaultDownlink;
use physics::guidance::pointing::antenna::Antennas;
use physics::momentum::WheelArray;
use physics::radiation::SolarModel;
use physics::radiation::disturbance::{DisturbanceModel, Options};
use physics::spacecraft::{self, Spacecraft, SunshadeModel};
use serde::Serialize;

/// The inertia in body axes that `spacecraft.inertia` holds by rows, in kg m2.
///
/// # Errors
/// What was found and what is allowed, of a matrix no body has.
pub(crate) fn inertia_body_kg_m2(values: &Values, handle: RealMatrix<3, 3>) -> Result<Matrix3<f64>, Failure> {
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
        let prepared = |model| SolarModel::new(spacecraft, Some(model)).ok();
        Self { plates: prepared(SunshadeModel::Plates), cylinder: prepared(SunshadeModel::Cylinder) }
    }

    /// The shape requested, of the spacecraft of this name.
    ///
    /// # Errors
    /// A shape that the file does not describe.
    pub fn solar(&self, model: SunshadeModel, name: &str) -> Result<&SolarModel, Failure> {
        let prepared = match model {
            SunshadeModel::Plates => &self.plates,
            SunshadeModel::Cylinder => &self.cylinder,
        };
        prepared.as_ref().ok_or_else(|| {
            let (requested, other) = match model {
                SunshadeModel::Plates => ("plates", "cylinder"),
                SunshadeModel::Cylinder => ("cylinder", "plates"),
            };
            Failure::new(format!(
                "sunshade.shape: found {requested}, allowed: {other}, as which alone the spacecraft.toml of {name} describes the \
                 shade"
            ))
        })
    }
}

/// The antennas of a spacecraft, and what follows from them once for all flights.
#[derive(Clone, Debug)]
pub struct PreparedAntennas {
    /// All of them.
    pub all: Antennas,
    /// The default downlink with them.
    pub default_downlink: DefaultDownlink,
}

impl PreparedAntennas {
    /// Of one spacecraft.
    pub fn of(spacecraft: &Spacecraft) -> Self {
        let all = Antennas::of(&spacecraft.antennas);
        Self { default_downlink: DefaultDownlink::of(&all), all }
    }
}

/// Distribution of momentum over the wheels of a file; `None` unless they span all directions.
pub(crate) fn wheel_array(spacecraft: &Spacecraft) -> Option<WheelArray> {
    WheelArray::new(&spacecraft.wheels.iter().map(|wheel| wheel.axis_body).collect::<Vec<_>>())
}

/// Smallest dump threshold that may be set, in N m s.
pub(crate) const LEAST_THRESHOLD_N_M_S: f64 = 1e-6;

/// The dump threshold; without one in the file what its wheels guarantee, and without wheels in all directions paper
/// 000's for small wheels.
pub(crate) fn dump_threshold_n_m_s(spacecraft: &Spacecraft) -> [f64; 3] {
    let smallest_n_m_s = spacecraft::PAPER_DUMP_THRESHOLDS_N_M_S[0].1;
    let capacities_n_m_s = spacecraft.wheels.iter().map(|wheel| wheel.capacity_n_m_s);
    let guaranteed_n_m_s = wheel_array(spacecraft)
        .map(|it| it.guaranteed_threshold_n_m_s(capacities_n_m_s).max(LEAST_THRESHOLD_N_M_S));
    spacecraft.dump_threshold_n_m_s.map_or([guaranteed_n_m_s.unwrap_or(smallest_n_m_s); 3], Into::into)
}

/// A face whose temperature and force are reported.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReportedFace {
    /// What the file calls its surface, and whether it is the rear.
    pub name: String,
    /// The panel it belongs to, if to one.
    pub panel: Option<usize>,
}

/// The faces reported one by one, none unless the file asks for that.
pub(crate) fn reported_faces(file: &str, spacecraft: &Spacecraft) -> Result<Vec<ReportedFace>, SetupError> {
    if !spacecraft.per_plate_outputs {
        return Ok(Vec::new());
    }
    let model = DisturbanceModel::new(spacecraft, &Options::default())
        .map_err(|error| SetupError(format!("{file}: {error}")))?;
    let faces = model.face_names().zip(model.face_panels());
    Ok(faces.map(|(name, panel)| ReportedFace { name, panel }).collect())
}
