//! Commands of the master: thrusters over a step, pulses within it, torque from outside.

use serde::{Deserialize, Serialize};

use crate::propulsion::PulseCommand;
use crate::spacecraft::MOST_THRUSTERS;
use crate::spin::series::BodyTorque;

/// Commands of the master for a step; by default they fire no thruster and exert no torque.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Commands {
    /// Thrusters that fire over the whole step.
    pub fire: u32,
    /// Pulses within the step, by thruster.
    pub pulses: [PulseCommand; MOST_THRUSTERS],
    /// Whether any of them is on.
    pub any_pulse: bool,
    /// Outside torque, body components.
    pub torque: BodyTorque,
}

impl Commands {
    /// Whether any thruster is to fire.
    pub(super) fn fires(&self) -> bool {
        self.fire != 0 || self.any_pulse
    }

    /// The first thruster, from 0, whose pulse does not end within a step, by more than the rounding of times.
    pub fn cut_by(&self, start_s: f64, end_s: f64) -> Option<usize> {
        self.pulses.iter().position(|pulse| pulse.is_cut(start_s, end_s))
    }

    /// Rejects decoded commands that no simulation can produce.
    pub(super) fn is_valid(&self) -> bool {
        self.pulses.iter().all(PulseCommand::is_valid)
    }
}
