//! Delta-v: the velocity to add, its path and its thrust direction.

pub mod delta_v;
pub mod nominal_thrust;
pub mod velocity_path;
