//! The commanded attitude: lines of sight, science and downlink attitudes, the orbit's schedule of both; paper 001's
//! attitude law with its pointing options, constraints and modes.

pub mod aimpoint;
pub mod antenna;
mod attitudes;
pub mod boresight;
#[cfg(test)]
mod burn_tests;
pub mod command;
#[cfg(test)]
mod constraint_tests;
pub mod constraints;
pub mod delta_v;
pub mod downlink;
mod downlink_sun;
#[cfg(test)]
mod flight_tests;
mod guided;
pub mod hot_pole;
pub mod keep_in;
pub mod law;
pub mod lighting;
pub mod limb;
pub mod lvlh;
pub mod mode;
pub mod modes;
pub mod monitor;
pub mod moving;
pub mod nominal_thrust;
mod orbit_ahead;
pub mod orbit_phase;
pub mod places;
pub mod planet_point;
pub mod roll;
pub mod scan;
pub mod scenario;
#[cfg(test)]
mod scenario_tests;
mod schedule;
mod science_course;
mod slew;
pub mod surroundings;
pub mod system;
#[cfg(test)]
mod test_burn;
#[cfg(test)]
mod test_geometry;
#[cfg(test)]
mod test_orbit;
pub mod timeline;
pub mod velocity_path;

pub use attitudes::{
    AttitudeCommand, LinesOfSight, ScienceRule, downlink_toward, science, sun_pointing, unloading,
};
pub use downlink::{ChosenPlace, SunPlace};
pub use downlink_sun::{DownlinkSun, SunChooser, SunOnMinusY, WindowStart};
pub use guided::{Guided, GuidedAttitude};
pub use law::{Pointing, PointingVectors};
pub use orbit_ahead::{OrbitAhead, lines_of_sight};
pub use schedule::{Activity, Schedule, Window};
pub use science_course::{CoursePoint, ScienceCourse};
pub use surroundings::{Surroundings, TargetPlanet};
