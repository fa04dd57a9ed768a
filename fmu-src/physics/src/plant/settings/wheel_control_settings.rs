//! Settings of wheel control: allocation, balancing of the momenta, friction compensation.

use crate::attitude::control::Allocation;

/// Settings of wheel control.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelControlSettings {
    /// Rule that distributes a torque over the wheels.
    pub allocation: Allocation,
    /// Time constant with which the wheels' momenta are brought to the same distribution, in s; infinite = not at all.
    pub balance_time_s: f64,
    /// Whether the motors make up for the wheels' known friction.
    pub compensates_friction: bool,
}
