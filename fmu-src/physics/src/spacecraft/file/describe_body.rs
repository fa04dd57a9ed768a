//! The shape of a body of the user's own, and of a planet's map, in a spacecraft file.

use crate::spacecraft::body::InertialFrame;
use crate::spacecraft::planet_map::MOST_BELTS;
use crate::toml::{
    BodyRadius, Eccentricity, Emissivity, Fraction, GravitationalParameter, HalfTurn, List, OrbitAxis, Point,
    RotationRate, TurnEither, ZonalHarmonic, tables,
};

tables! {
/// A body of one's own, an asteroid, a comet or a moon: with it `custom` is an item of `orbit.center` and the default there, and one
/// of `target.planet` and `aimpoint.body`.
struct BodyDescription {
    /// Its name.
    name: String,
    /// Gravitational parameter, in m3/s2.
    gravitational_parameter_m3_s2: GravitationalParameter,
    /// Radii of its ellipsoid along its own x, y and z, in m; shadow and light take their mean.
    radii_m: [BodyRadius; 3],
    /// Second zonal harmonic of its gravity, unnormalised, for the first radius.
    j2: ZonalHarmonic = 0.0,
    /// Right ascension and declination of its north pole in EME2000, in deg.
    pole_deg: [f64; 2] = [0.0, 90.0],
    /// Angle of its prime meridian from the node of its equator on that of EME2000 at J2000, in deg.
    prime_meridian_deg as prime_meridian_rad: TurnEither = 0.0,
    /// Rotation rate about its pole, in rad/s.
    rotation_rate_rad_s: RotationRate = 0.0,
    /// Diffusely reflected fraction of sunlight; the default is assumed.
    albedo: Fraction = 0.1,
    /// Infrared emissivity; the default is assumed.
    emissivity: Emissivity = 0.9,
    elements: Option<BodyElementsDescription>,
    /// Instead of elements, its position from the Sun at `epoch`, in m.
    position_m: Option<Point>,
    /// Its velocity then, in m/s.
    velocity_m_s: Option<Point>,
    /// When elements or state hold, a date such as "2030-01-01 TDB".
    epoch: Option<String>,
    /// Axes of elements or state: the ecliptic unless given.
    frame: Option<InertialFrame>,
} rules {
    Excludes elements => position_m velocity_m_s: "elements beside position_m or velocity_m_s",
        "either `elements`, or `position_m` and `velocity_m_s`";
    Requires epoch => elements position_m velocity_m_s: "no `elements` and no `position_m` beside it",
        "what the body's place about the Sun is at that time";
    Requires frame => epoch elements position_m velocity_m_s: "no `elements` and no `position_m` beside it",
        "what the body's place about the Sun is at that time";
}

/// Its orbit about the Sun. Without it and without a state, inputs or the file of onboard ephemerides say where the body is.
struct BodyElementsDescription {
    /// Semi-major axis, in m.
    semi_major_axis_m: OrbitAxis,
    /// Eccentricity, at most 0.99.
    eccentricity: Eccentricity,
    /// Inclination, in deg.
    inclination_deg as inclination_rad: HalfTurn,
    /// Longitude of the ascending node, in deg.
    ascending_node_deg as ascending_node_rad: TurnEither,
    /// Argument of periapsis, in deg.
    periapsis_argument_deg as periapsis_argument_rad: TurnEither,
    /// True anomaly at `epoch`, in deg.
    true_anomaly_deg as true_anomaly_rad: TurnEither,
}

/// The planet's surface cell by cell, for `planetLight.method` map of DisturbanceTorque. Each key has n rows, belts of
/// latitude from south to north, of 2 n cells each, from midnight over morning, noon and evening.
struct PlanetMapDescription {
    /// Diffusely reflected fraction of sunlight.
    diffuse_reflectivity: List<Vec<f64>, 1, MOST_BELTS>,
    /// Infrared emissivity.
    emissivity: List<Vec<f64>, 1, MOST_BELTS>,
    /// Temperature, in K.
    temperature_k: List<Vec<f64>, 1, MOST_BELTS>,
}
}
