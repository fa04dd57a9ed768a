//! What several models read from their variables and setups alike.

use fmi_export::{Choice, Enumeration, Failure, Real, RealMatrix, SetupError, Values, Variables};
use nalgebra::Matrix3;
use physics::environment::surface::{self, MERCURY, PlanetSurface};
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
}

impl From<DayTemperature> for surface::DayTemperature {
    fn from(choice: DayTemperature) -> Self {
        match choice {
            DayTemperature::Uniform => Self::Uniform,
            DayTemperature::Cosine => Self::Cosine,
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
}

/// The faces reported one by one, none unless the file asks for that.
pub fn reported_faces(file: &str, spacecraft: &Spacecraft) -> Result<Vec<ReportedFace>, SetupError> {
    if !spacecraft.per_plate_outputs {
        return Ok(Vec::new());
    }
    let model = DisturbanceModel::new(spacecraft, &Options::default())
        .map_err(|error| SetupError(format!("{file}: {error}")))?;
    let faces = model.face_names().zip(model.face_panels());
    Ok(faces.map(|(name, panel)| ReportedFace { name, panel }).collect())
}
