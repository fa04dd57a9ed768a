//! Thrusters at work: what they exert, dumps, reaction control.

pub(super) mod at_once;
pub(super) mod pulsed_dump;
pub(super) mod reaction_control;
pub(super) mod selected;
pub(super) mod thruster_load;
