//! What the master commands: thrusters over a step, pulses within it, torque from outside.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::propulsion::PulseCommand;
use crate::spacecraft::MOST_THRUSTERS;
use crate::spin::{execution::PulseExecution, series::BodyTorque};

/// What the master commands for a step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Commands {
    /// Thrusters that fire over the whole step.
    pub fire: u32,
    /// Pulses within the step, by thruster.
    pub pulses: [PulseCommand; MOST_THRUSTERS],
    /// Whether any of them is on.
    pub any_pulse: bool,
    /// Thrusters whose pulse is shorter than their valves open at least, bit by bit: it is left out.
    pub too_short: u32,
    /// Outside torque, body components.
    pub torque: BodyTorque,
}

impl Commands {
    /// Nothing.
    pub fn none() -> Self {
        Self {
            fire: 0,
            pulses: [PulseCommand::default(); MOST_THRUSTERS],
            any_pulse: false,
            too_short: 0,
            torque: BodyTorque::constant(Vector3::zeros()),
        }
    }

    /// The same commands without the pulses that are too short for their valves.
    pub(super) fn executable(mut self, execution: &[PulseExecution; MOST_THRUSTERS]) -> Self {
        self.too_short = 0;
        for (k, (pulse, of_one)) in self.pulses.iter_mut().zip(execution).enumerate() {
            if of_one.is_too_short(pulse.on_s) {
                self.too_short |= 1 << k;
                pulse.on_s = 0.0;
            }
        }
        self.any_pulse = self.any_pulse && self.pulses.iter().any(|pulse| pulse.on_s > 0.0);
        self
    }

    /// The first thruster, from 0, whose pulse does not end within a step, by more than the rounding of times.
    pub fn cut_by(&self, start_s: f64, end_s: f64) -> Option<usize> {
        self.pulses.iter().position(|pulse| pulse.is_cut(start_s, end_s))
    }

    /// Whether decoded commands can be some.
    pub(super) fn is_sound(&self) -> bool {
        self.pulses.iter().all(PulseCommand::is_sound) && self.torque.is_sound()
    }

    /// Thrusters on just after `time_s`, in a step from `from_s`.
    pub(super) fn mask_after(&self, from_s: f64, time_s: f64) -> u32 {
        let mut mask = self.fire;
        if self.any_pulse {
            for (k, pulse) in self.pulses.iter().enumerate() {
                let on_s = from_s + pulse.delay_s;
                if pulse.on_s > 0.0 && on_s <= time_s && time_s < on_s + pulse.on_s {
                    mask |= 1 << k;
                }
            }
        }
        mask
    }

    /// The first edge of a pulse later than `time_s`, in a step from `from_s`.
    pub(super) fn edge_after_s(&self, from_s: f64, time_s: f64) -> f64 {
        let mut next_s = f64::INFINITY;
        if self.any_pulse {
            for pulse in self.pulses.iter().filter(|pulse| pulse.on_s > 0.0) {
                let on_s = from_s + pulse.delay_s;
                for edge_s in [on_s, on_s + pulse.on_s] {
                    if edge_s > time_s {
                        next_s = next_s.min(edge_s);
                    }
                }
            }
        }
        next_s
    }
}
