//! A CubeSat about the Earth: every torque against the height of its orbit, and a day in a low one.

mod cubesat;
mod day;
mod torques;

pub(crate) use day::day;
pub(crate) use torques::torques;
