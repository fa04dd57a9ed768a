//! Rotation of the planet, its air and its magnetic field.

use fmi_export::{Choice, Enumeration, Real, RealVector, Variables};
use physics::constants::{HALF_TURNS_RAD, QUARTER_TURNS_RAD};

use super::super::setup::PlantSetup as Setup;

/// Where density, temperature and molar mass of the air come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum AtmosphereMethod {
    /// Exponential decrease of the density with height.
    Exponential = 1,
    /// The model NRLMSISE-00 of the Earth.
    Nrlmsise00 = 2,
    /// The inputs atmosphere.given*.
    Given = 3,
}

/// Where the magnetic field comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum MagneticFieldMethod {
    /// Tilted, eccentric dipole: Earth, Mercury, Jupiter.
    Dipole = 1,
    /// The International Geomagnetic Reference Field, 14th generation: Earth, 1900 to 2030.
    Igrf14 = 2,
    /// The input magneticField.given.
    Given = 3,
}

/// The air about the planet.
#[derive(Variables)]
pub struct AtmosphereVariables {
    /// Where density, temperature and molar mass come from. Above 2000 km a model has no air.
    #[parameter(start = AtmosphereMethod::Exponential)]
    pub method: Choice<AtmosphereMethod>,
    /// Density at atmosphere.referenceHeight by the exponential model; by default of orbit.center, 0 where none is known.
    #[parameter(unit = "kg/m3", min = 0.0, max = 1e3, start = setup.center.air().reference_density_kg_m3)]
    pub reference_density: Real,
    /// Height of that density.
    #[parameter(unit = "m", display = "km", min = -1e6, max = 1e9, start = setup.center.air().reference_height_m)]
    pub reference_height: Real,
    /// Height over which it falls to 1/e.
    #[parameter(unit = "m", display = "km", min = 1.0, max = 1e9, start = setup.center.air().scale_height_m)]
    pub scale_height: Real,
    /// Factor of a model's density.
    #[parameter(tunable, unit = "1", min = 0.0, max = 1e6, start = 1.0)]
    pub density_factor: Real,
    /// Largest last Chebyshev term of air and magnetic field over a segment of the orbit, relative to their size; segments are
    /// shortened until it holds.
    #[parameter(unit = "1", min = 1e-12, max = 1e-2, start = 1e-6)]
    pub tolerance: Real,
    /// Density when atmosphere.method is given; 0 = no air.
    #[input(unit = "kg/m3", min = 0.0, max = 1e3, start = 0.0)]
    pub given_density: Real,
    /// Temperature of the air when atmosphere.method is given.
    #[input(unit = "K", min = 0.0, max = 1e5, start = 1000.0)]
    pub given_temperature: Real,
    /// Mean molar mass when atmosphere.method is given.
    #[input(unit = "kg/mol", display = "g/mol", min = 0.0, max = 1.0, start = 0.016)]
    pub given_molar_mass: Real,
    /// Velocity of the air relative to the rotating planet: east, north, up.
    #[input(unit = "m/s", min = -1e4, max = 1e4, start = [0.0; 3])]
    pub wind: RealVector<3>,
    /// Density where the spacecraft is; 0 unless aerodynamics.enabled.
    #[output(unit = "kg/m3", nominal = 1e-12)]
    pub density: Real,
    /// Temperature of the air there.
    #[output(unit = "K", nominal = 1e3)]
    pub temperature: Real,
    /// Mean molar mass of the air there.
    #[output(unit = "kg/mol", display = "g/mol", nominal = 1e-2)]
    pub molar_mass: Real,
    /// Velocity of the spacecraft relative to the air, body frame; 0 unless aerodynamics.enabled.
    #[output(unit = "m/s", display = "km/s", nominal = 1e4)]
    pub velocity_body: RealVector<3>,
}

/// Solar and geomagnetic activity, inputs of NRLMSISE-00.
#[derive(Variables)]
pub struct SpaceWeatherVariables {
    /// Flux of the Sun at 10.7 cm on the day before, in 1e-22 W/(m2 Hz).
    #[parameter(tunable, unit = "1", min = 0.0, max = 1e3, start = 150.0)]
    pub f107: Real,
    /// Its mean over 81 days about the day.
    #[parameter(tunable, unit = "1", min = 0.0, max = 1e3, start = 150.0)]
    pub f107_average: Real,
    /// Daily magnetic index Ap.
    #[parameter(tunable, unit = "1", min = 0.0, max = 400.0, start = 4.0)]
    pub ap: Real,
}

/// The planet's magnetic field.
#[derive(Variables)]
pub struct MagneticFieldVariables {
    /// Where it comes from.
    #[parameter(start = MagneticFieldMethod::Dipole)]
    pub method: Choice<MagneticFieldMethod>,
    /// Field in EME2000 when magneticField.method is given.
    #[input(unit = "T", display = "nT", min = -1.0, max = 1.0, start = [0.0; 3])]
    pub given: RealVector<3>,
    /// Field where the spacecraft is, body frame; 0 unless magnetics.enabled.
    #[output(unit = "T", display = "nT", nominal = 1e-5)]
    pub body: RealVector<3>,
    /// The same in EME2000.
    #[output(unit = "T", display = "nT", nominal = 1e-5)]
    pub inertial: RealVector<3>,
}

/// Place over the planet's ellipsoid.
#[derive(Variables)]
pub struct GeodeticVariables {
    /// Latitude of the ellipsoid's normal through the spacecraft; 0 without a planet, as the others.
    #[output(unit = "rad", display = "deg", min = QUARTER_TURNS_RAD[0], max = QUARTER_TURNS_RAD[1])]
    pub latitude: Real,
    /// Longitude, east.
    #[output(unit = "rad", display = "deg", min = HALF_TURNS_RAD[0], max = HALF_TURNS_RAD[1])]
    pub longitude: Real,
    /// Height over the ellipsoid.
    #[output(unit = "m", display = "km", nominal = 1e6)]
    pub height: Real,
}
