//! Start values that are computed or come from the spacecraft.

use physics::environment::{ephemeris, time};
use physics::spacecraft::SunKeepIn;

use crate::momentum_plant::setup::PlantSetup;

/// 2009-04-06 00:00 TDB: orbit insertion in paper 000's plan, in s past J2000 TDB.
pub(crate) const EPOCH_TDB_S: f64 = time::MOMENTUM_STUDY_START_S;
pub(crate) const EARLIEST_EPOCH_S: f64 = ephemeris::EARLIEST_EPOCH_S;
pub(crate) const VALID_EPOCH_S: f64 = ephemeris::VALID_EPOCH_S;

/// Inertia by rows.
pub(crate) fn inertia_kg_m2(setup: &PlantSetup) -> [[f64; 3]; 3] {
    setup.spacecraft.mass_properties.inertia_body_kg_m2.transpose().into()
}

/// The keep-in zone; without one in the file every direction is allowed.
pub(crate) fn keep_in(setup: &PlantSetup) -> SunKeepIn {
    let everywhere = SunKeepIn {
        azimuth_rad: core::f64::consts::PI,
        elevation_rad: core::f64::consts::FRAC_PI_2,
        distance_m: SunKeepIn::FARTHEST_M,
    };
    setup.spacecraft.sun_keep_in.unwrap_or(everywhere)
}
