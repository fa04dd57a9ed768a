//! Groups of variables that several models have.

use fmi_export::{Choice, Failure, Integer, Real, Values, Variables};
use physics::bodies::surface::{self, MERCURY, PlanetSurface};
use physics::environment::eclipse::{Shadow, ShadowModel};

use super::choices::{DayTemperature, EclipseMethod};

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
    #[parameter(start = DayTemperature(surface::DayTemperature::Uniform))]
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
                .map_or(surface::DayTemperature::Uniform, |it| it.0),
        }
    }
}

/// Shadow of the planet.
#[derive(Variables)]
pub struct EclipseVariables {
    /// How the planet's shadow dims the Sun.
    #[parameter(start = EclipseMethod(ShadowModel::DiscOverlap))]
    pub method: Choice<EclipseMethod>,
}

impl EclipseVariables {
    /// The shadow of a planet of this radius.
    pub fn read(&self, values: &Values, radius_m: f64) -> Result<Shadow, Failure> {
        let model = values.choice(self.method).map_or(ShadowModel::DiscOverlap, |it| it.0);
        Shadow::new(model, radius_m).map_err(|error| Failure::new(format!("planet.radius: {error}")))
    }
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
