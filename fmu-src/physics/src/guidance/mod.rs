//! The commanded attitude: lines of sight, science and downlink attitudes, the orbit's schedule of both; the attitude law
//! of paper 001 with its pointing options.

mod attitudes;
pub mod command;
pub mod constraints;
pub mod downlink;
mod guided;
pub mod hot_pole;
pub mod keep_in;
pub mod law;
pub mod modes;
pub mod monitor;
pub mod moving;
mod schedule;
pub mod surroundings;
#[cfg(test)]
mod test_geometry;

pub use attitudes::{AttitudeCommand, LinesOfSight, ScienceRule, downlink, science, sun_pointing};
pub use guided::{Guided, GuidedAttitude};
pub use law::{Pointing, PointingVectors};
pub use schedule::{Activity, Schedule, Window};
pub use surroundings::{Surroundings, TargetPlanet};
