//! Position and motion of the spacecraft: orbit, geometry, attitude, turning panels.

pub(super) mod approaches;
pub(super) mod command_slews;
pub(super) mod geometry;
mod guided_law;
pub(super) mod instant;
pub(super) mod kinematics;
pub(super) mod osculating_orbit;
pub(super) mod panel_motion;
pub(super) mod panel_turns;
mod passages;
mod periapses;
pub(super) mod trajectory;
