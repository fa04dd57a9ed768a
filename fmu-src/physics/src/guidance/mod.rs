//! The commanded attitude: lines of sight, science and downlink attitudes, the orbit's schedule of both; paper 001's
//! attitude law with its pointing options, constraints and modes.

pub mod burn;
pub mod constraints;
pub mod downlink;
pub mod geometry;
pub mod modes;
pub mod orbit_phase;
pub mod pointing;
pub mod scenario;
#[cfg(test)]
pub(crate) mod tests;
pub mod timeline;

pub use downlink::sun_direction::{DownlinkSunDirection, SelectedSunDirection, SelectedSunDirections};
pub use geometry::ephemeris_at_time::{EphemerisAtTime, TargetPlanet};
pub use orbit_phase::attitudes::{
    AttitudeCommand, LinesOfSight, ScienceRule, Sight, downlink_toward, sun_pointing,
};
pub use orbit_phase::downlink_sun::{DownlinkSun, WindowStart};
pub use orbit_phase::guided::{DownlinkStatus, Guided, GuidedAttitude, OrbitPhaseLaw};
pub use orbit_phase::predicted_orbit::PredictedOrbit;
pub use orbit_phase::schedule::{Activity, NoCycle, Schedule, Window};
pub use orbit_phase::science_arc::{ArcPoint, ScienceArc};
pub use pointing::law::{Pointing, PointingVectors};
