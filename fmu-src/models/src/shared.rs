//! What several models read from their variables and setups alike.

use fmi_export::{Choice, Enumeration, Real, SetupError, Values};
use physics::environment::surface::{self, PlanetSurface};
use physics::radiation::disturbance::{DisturbanceModel, Options};
use physics::spacecraft::Spacecraft;

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

/// Handles of the parameters that describe a planet's surface.
#[derive(Clone, Copy)]
pub struct SurfaceHandles {
    pub radius: Real,
    pub absorptivity: Real,
    pub diffuse_reflectivity: Real,
    pub emissivity: Real,
    pub night_temperature: Real,
    pub day_temperature: Choice<DayTemperature>,
}

impl SurfaceHandles {
    /// The surface the parameters describe; not checked yet.
    pub fn read(&self, values: &Values) -> PlanetSurface {
        PlanetSurface {
            radius_m: values.real(self.radius),
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

/// The faces reported one by one, none unless the file asks for that: for each the panel it belongs to, if to one.
pub fn reported_faces(file: &str, spacecraft: &Spacecraft) -> Result<Vec<Option<usize>>, SetupError> {
    if !spacecraft.per_plate_outputs {
        return Ok(Vec::new());
    }
    let model = DisturbanceModel::new(spacecraft, &Options::default())
        .map_err(|error| SetupError(format!("{file}: {error}")))?;
    Ok(model.face_panels().collect())
}
