//! Groups of variables that several models have.

use fmi_export::{Boolean, Choice, Elements, Failure, Given, Integer, Real, Values, Variables};
use physics::bodies::surface::PlanetSurface;
use physics::environment::eclipse::{Shadow, ShadowModel};
use physics::environment::sun::SOLAR_FLUX_W_M2;
use physics::plant::{LightSource, SunLight};
use physics::spacecraft::ValveTiming;

use super::center::CenterBody;
use super::choices::{DayTemperature, EclipseMethod};
use super::numbers::Numbers;

/// Optical and thermal properties of a planet's surface; Mercury's fit paper 004, which prints none.
#[derive(Variables)]
#[variables(setup = CenterBody)]
pub struct SurfaceVariables {
    /// Fraction of sunlight the planet absorbs; Mercury's 0.88 fits paper 004, which does not print it.
    #[parameter(unit = "1", min = 0.0, max = 1.0, start = setup.surface().absorptivity)]
    pub absorptivity: Real,
    /// Fraction of sunlight the planet reflects diffusely; Mercury's 0.12 fits paper 004, which does not print it.
    #[parameter(unit = "1", min = 0.0, max = 1.0, start = setup.surface().diffuse_reflectivity)]
    pub diffuse_reflectivity: Real,
    /// Infrared emissivity of the planet; Mercury's 0.9 fits paper 004, which does not print it.
    #[parameter(unit = "1", min = 0.0, max = 1.0, start = setup.surface().emissivity)]
    pub emissivity: Real,
    /// Temperature of the planet's night side; Mercury's 100 K fits paper 004, which does not print it.
    #[parameter(unit = "K", min = 0.0, max = 1e4, start = setup.surface().night_temperature_k)]
    pub night_temperature: Real,
    /// How the temperature of the planet's day side is distributed.
    #[parameter(start = DayTemperature(setup.surface().day_temperature))]
    pub day_temperature: Choice<DayTemperature>,
}

impl SurfaceVariables {
    fn numbers(&self) -> Numbers<PlanetSurface, 4> {
        Numbers([
            (self.absorptivity, |it| &mut it.absorptivity),
            (self.diffuse_reflectivity, |it| &mut it.diffuse_reflectivity),
            (self.emissivity, |it| &mut it.emissivity),
            (self.night_temperature, |it| &mut it.night_temperature_k),
        ])
    }

    /// All of them.
    pub fn group(&self) -> [Elements; 5] {
        let [a, b, c, d] = self.numbers().group();
        [a, b, c, d, self.day_temperature.into()]
    }

    /// The surface, of what is not given `own`.
    pub fn read_or(&self, given: Given<'_>, own: &PlanetSurface) -> PlanetSurface {
        let day_temperature = given.choice_or(self.day_temperature, DayTemperature(own.day_temperature)).0;
        PlanetSurface { day_temperature, ..self.numbers().read_or(given, own) }
    }

    /// Writes this surface, but for its radius.
    pub fn write(&self, values: &mut Values, surface: &PlanetSurface) {
        self.numbers().write(values, *surface);
        values.set_choice(self.day_temperature, DayTemperature(surface.day_temperature));
    }

    /// The surface of a planet of this radius, as `read` reads it; not checked yet.
    pub fn read<T>(&self, values: &Values, radius: Real, read: impl Fn(Real) -> T) -> PlanetSurface<T> {
        PlanetSurface {
            radius_m: read(radius),
            absorptivity: read(self.absorptivity),
            diffuse_reflectivity: read(self.diffuse_reflectivity),
            emissivity: read(self.emissivity),
            night_temperature_k: read(self.night_temperature),
            day_temperature: values.choice(self.day_temperature).0,
        }
    }
}

/// Flux of sunlight.
#[derive(Variables)]
pub struct SolarFluxVariables {
    /// Solar flux at 1 AU; 1361 W/m2 is the nominal irradiance (IAU 2015 Resolution B3), 1353 reproduces paper 000's
    /// pressure, 1365 fits paper 004 (well-known simulators use 1349 to 1368).
    #[parameter(unit = "W/m2", min = 0.0, max = 1e6, start = SOLAR_FLUX_W_M2)]
    pub flux: Real,
    /// Factor of force and torque of direct sunlight, as a fit to measured momentum gives it; heat and light of the planet go by the
    /// flux alone.
    #[parameter(tunable, unit = "1", min = 0.0, max = 1e3, start = 1.0)]
    pub scale: Real,
}

/// Sunlight.
#[derive(Variables)]
pub struct SolarVariables {
    #[group(name = "")]
    pub at_1_au: SolarFluxVariables,
    /// Whether the pressure is solar.pressure everywhere instead of following the distance from the Sun.
    #[parameter(start = false)]
    pub fixed_pressure: Boolean,
    /// Radiation pressure when it is fixed; the default is paper 000's value at 0.3 AU.
    #[parameter(unit = "Pa", display = "uPa", min = 0.0, max = 1.0, start = 5.0145e-5)]
    pub pressure: Real,
}

impl SolarVariables {
    /// The sunlight.
    pub fn read(&self, values: &Values) -> SunLight {
        let source = if values.boolean(self.fixed_pressure) {
            LightSource::Fixed { pressure_pa: values.real(self.pressure) }
        } else {
            LightSource::Distance { flux_w_m2: values.real(self.at_1_au.flux) }
        };
        SunLight { source, scale: values.real(self.at_1_au.scale) }
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
    /// The shadow of a planet of this radius in the light of a Sun of this one, both in m.
    pub fn read(&self, values: &Values, radius_m: f64, sun_radius_m: f64) -> Result<Shadow, Failure> {
        let model = values.choice(self.method).0;
        Shadow::with_sun_radius(model, radius_m, sun_radius_m)
            .map_err(|error| Failure::new(format!("planet.radius, sun.radius: {error}")))
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

/// Opening and closing of a thruster's valve.
#[derive(Variables)]
#[variables(setup = ValveTiming)]
pub struct ValveVariables {
    /// Shortest time for which its valve opens: it does not close sooner after it opened, over the step's end if need be.
    #[parameter(unit = "s", display = "ms", min = 0.0, max = 1e3, start = setup.min_on_s)]
    pub min_on_time: Real,
    /// Time over which the thrust rises linearly after the valve opens.
    #[parameter(unit = "s", display = "ms", min = 0.0, max = 1e3, start = setup.rise_s)]
    pub rise_time: Real,
    /// Time over which the full thrust falls linearly to nothing after the valve closes.
    #[parameter(unit = "s", display = "ms", min = 0.0, max = 1e3, start = setup.tail_off_s)]
    pub tail_off_time: Real,
}

impl ValveVariables {
    /// The timing.
    pub fn read(&self, values: &Values) -> ValveTiming {
        let [min_on_s, rise_s, tail_off_s] =
            [self.min_on_time, self.rise_time, self.tail_off_time].map(|it| values.real(it));
        ValveTiming { min_on_s, rise_s, tail_off_s }
    }
}
