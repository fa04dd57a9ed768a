//! The commanded attitude: lines of sight, science and downlink attitudes, the orbit's schedule of both.

mod attitudes;
mod guided;
mod schedule;

pub use attitudes::{AttitudeCommand, LinesOfSight, ScienceRule, downlink, science, sun_pointing};
pub use guided::{Guided, GuidedAttitude};
pub use schedule::{Activity, Schedule, Window};
