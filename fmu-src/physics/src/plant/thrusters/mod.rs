//! Thrusters at work: valves, allocation of torque, dumps, force and torque.

pub(super) mod allocation;
pub(super) mod at_once;
pub(super) mod pulsed_dump;
pub(super) mod reaction_control;
pub(super) mod thruster_load;
pub(super) mod valves;
