//! Where the spacecraft is and how it moves: orbit, geometry, attitude, turning panels.

pub mod geometry;
pub mod instant;
pub mod kinematics;
pub mod panel_motion;
pub mod trajectory;
