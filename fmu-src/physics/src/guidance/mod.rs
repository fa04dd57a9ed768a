//! The commanded attitude: lines of sight, science and downlink attitudes, the orbit's schedule of both; the attitude law
//! of paper 001 with its pointing options.

mod attitudes;
pub mod command;
mod guided;
pub mod law;
pub mod moving;
mod schedule;
pub mod surroundings;
pub mod timeline;

pub use attitudes::{AttitudeCommand, LinesOfSight, ScienceRule, downlink, science, sun_pointing};
pub use guided::{Guided, GuidedAttitude};
pub use law::{Pointing, PointingVectors};
pub use schedule::{Activity, Schedule, Window};
pub use surroundings::{Surroundings, TargetPlanet};
