//! Motion of the spacecraft as it is saved: orbit, slews, turning panels.

pub(super) mod approaches;
pub(super) mod command_slews;
pub(super) mod osculating_orbit;
pub(super) mod panel_motion;
pub(super) mod panel_turns;
mod passages;
mod periapses;
pub(super) mod trajectory;
