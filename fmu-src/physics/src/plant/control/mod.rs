//! Control of the attitude: sensors, the controller's loop, motors of the wheels.

pub(super) mod control_loop;
pub(super) mod sensing;
pub(super) mod wheel_control;
