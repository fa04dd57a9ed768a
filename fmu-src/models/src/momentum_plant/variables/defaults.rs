//! Start values that are computed or come from the spacecraft.

use physics::bodies::{Body, BodyData};
use physics::environment::{ephemeris, orbit, paper004, time};
use physics::spacecraft::SunKeepIn;

use crate::momentum_plant::setup::PlantSetup;

/// 2009-04-06 00:00 TDB: orbit insertion in paper 000's plan, in s past J2000 TDB.
pub const EPOCH_TDB_S: f64 = time::MOMENTUM_STUDY_START_S;
pub const EARLIEST_EPOCH_S: f64 = ephemeris::EARLIEST_EPOCH_S;
pub const VALID_EPOCH_S: f64 = ephemeris::VALID_EPOCH_S;
/// The body that the other defaults are of.
pub const MERCURY: &BodyData = Body::Mercury.data();
/// Elements of the default orbit: paper 004's Table 3, referred to Mercury's equator.
pub const ECCENTRICITY: f64 = paper004::MESSENGER_AS_PRINTED.eccentricity;
pub const INCLINATION_RAD: f64 = paper004::MESSENGER_AS_PRINTED.inclination_rad;
pub const ASCENDING_NODE_RAD: f64 = paper004::MESSENGER_AS_PRINTED.ascending_node_rad;
pub const PERIAPSIS_ARGUMENT_RAD: f64 = paper004::MESSENGER_AS_PRINTED.periapsis_argument_rad;

/// The semi-major axis of a 12 h orbit about Mercury (Kepler's third law).
pub fn semi_major_axis_m() -> f64 {
    orbit::semi_major_axis_m(MERCURY.gm_m3_s2, 43_200.0)
}

/// Inertia by rows.
pub fn inertia_kg_m2(setup: &PlantSetup) -> [[f64; 3]; 3] {
    setup.spacecraft.mass_properties.inertia_body_kg_m2.transpose().into()
}

/// The keep-in zone; without one in the file every direction is allowed.
pub fn keep_in(setup: &PlantSetup) -> SunKeepIn {
    let everywhere =
        SunKeepIn { azimuth_rad: core::f64::consts::PI, elevation_rad: core::f64::consts::FRAC_PI_2 };
    setup.spacecraft.sun_keep_in.unwrap_or(everywhere)
}
