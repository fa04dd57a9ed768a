//! Thrusters at work: what they exert, dumps, reaction control.

pub mod pulsed_dump;
pub mod reaction_control;
pub mod thruster_load;
