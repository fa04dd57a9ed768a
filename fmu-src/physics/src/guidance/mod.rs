//! The commanded attitude: lines of sight, science and downlink attitudes, the orbit's schedule of both; the attitude law
//! of paper 001 with its pointing options.

pub mod aimpoint;
mod attitudes;
pub mod boresight;
pub mod command;
mod guided;
pub mod law;
pub mod lighting;
pub mod limb;
pub mod lvlh;
pub mod moving;
pub mod planet_point;
pub mod roll;
pub mod scan;
pub mod scenario;
#[cfg(test)]
mod scenario_tests;
mod schedule;
pub mod surroundings;
#[cfg(test)]
mod test_orbit;

pub use attitudes::{AttitudeCommand, LinesOfSight, ScienceRule, downlink, science, sun_pointing};
pub use guided::{Guided, GuidedAttitude};
pub use law::{Pointing, PointingVectors};
pub use schedule::{Activity, Schedule, Window};
pub use surroundings::{Surroundings, TargetPlanet};
