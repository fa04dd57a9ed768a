//! Surfaces, antennas, wheels and inertia of a spacecraft, for several models.

use fmi_export::{Failure, RealMatrix, RealVector, SetupError, Values};
use nalgebra::{Matrix3, Vector3};
use physics::attitude::Attitude;
use physics::guidance::downlink::default_downlink::DefaultDownlink;
use physics::guidance::pointing::antenna::Antennas;
use physics::momentum::{WheelArray, wheels_body_n_m_s};
use physics::plant::ControlDefaults;
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

/// The attitude that `start.q` holds.
///
/// # Errors
/// A quaternion that is no attitude.
pub(crate) fn start_attitude(values: &Values, handle: RealVector<4>) -> Result<Attitude, Failure> {
    Attitude::from_quaternion(values.vector(handle))
        .map_err(|error| Failure::new(format!("start.q: {error}")))
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
    /// Prepares the shapes of one spacecraft.
    pub fn new(spacecraft: &Spacecraft) -> Self {
        let prepared = |model| SolarModel::new(spacecraft, Some(model)).ok();
        Self { plates: prepared(SunshadeModel::Plates), cylinder: prepared(SunshadeModel::Cylinder) }
    }

    /// The shape requested, of the spacecraft of this name.
    ///
    /// # Errors
    /// A shape that the file does not describe.
    pub fn solar(&self, model: SunshadeModel, name: &str) -> Result<&SolarModel, Failure> {
        let (prepared, requested, other) = match model {
            SunshadeModel::Plates => (&self.plates, "plates", "cylinder"),
            SunshadeModel::Cylinder => (&self.cylinder, "cylinder", "plates"),
        };
        prepared.as_ref().ok_or_else(|| {
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
    /// Prepares the antennas of one spacecraft.
    pub fn new(spacecraft: &Spacecraft) -> Self {
        let all = Antennas::new(&spacecraft.antennas);
        Self { default_downlink: DefaultDownlink::new(&all), all }
    }
}

/// Distribution of momentum over the wheels of a file.
pub(crate) fn wheel_array(spacecraft: &Spacecraft) -> WheelArray {
    WheelArray::from_axes(&spacecraft.wheels.iter().map(|wheel| wheel.axis_body).collect::<Vec<_>>())
}

/// Sum of the biases of a file's wheels, body frame, in N m s.
pub(crate) fn bias_body_n_m_s(spacecraft: &Spacecraft) -> Vector3<f64> {
    wheels_body_n_m_s(spacecraft.wheels.iter().map(|wheel| (wheel.axis_body, wheel.bias_n_m_s)))
}

/// The default dump threshold, in N m s.
pub(crate) fn dump_threshold_n_m_s(spacecraft: &Spacecraft) -> [f64; 3] {
    ControlDefaults::new(spacecraft, &wheel_array(spacecraft)).dump_threshold_n_m_s.into()
}

/// A face whose temperature and force are reported.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReportedFace {
    /// The file's name of its surface, and whether it is the rear.
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
