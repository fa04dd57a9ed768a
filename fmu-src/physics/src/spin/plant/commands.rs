//! What the master commands: thrusters over a step, pulses within it, torque from outside.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::numerics::spacing::spacing;
use crate::spin::{series::BodyTorque, spinner::MOST_THRUSTERS};

/// A thruster command within a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PulseCommand {
    /// From the start of the step, in s.
    pub delay_s: f64,
    /// How long, in s.
    pub on_s: f64,
}

/// What the master commands for a step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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

impl PulseCommand {
    /// A pulse whose times are rounded to whole steps of `resolution_s`; 0 = not rounded.
    pub fn rounded(delay_s: f64, on_s: f64, resolution_s: f64) -> Self {
        let rounded = |time_s: f64| {
            let time_s = time_s.max(0.0);
            let steps = time_s / resolution_s;
            // So many steps that doubles do not count them are as fine as no rounding.
            if resolution_s > 0.0 && steps < 1e15 { steps.round() * resolution_s } else { time_s }
        };
        Self { delay_s: rounded(delay_s), on_s: rounded(on_s) }
    }
}

impl Commands {
    /// Nothing.
    pub fn none() -> Self {
        Self {
            fire: 0,
            pulses: [PulseCommand::default(); MOST_THRUSTERS],
            any_pulse: false,
            torque: BodyTorque::constant(Vector3::zeros()),
        }
    }

    /// The first thruster, from 0, whose pulse does not end within a step, by more than the rounding of times.
    pub fn cut_by(&self, start_s: f64, end_s: f64) -> Option<usize> {
        let length_s = end_s - start_s;
        let rounding_s = 1e-9 * length_s + 8.0 * spacing(start_s.abs().max(end_s.abs()));
        let is_cut =
            |pulse: &PulseCommand| pulse.on_s > 0.0 && pulse.delay_s + pulse.on_s > length_s + rounding_s;
        self.pulses.iter().position(is_cut)
    }

    /// Whether decoded commands can be some.
    pub(super) fn is_sound(&self) -> bool {
        let pulse = |pulse: &PulseCommand| pulse.delay_s >= 0.0 && pulse.on_s >= 0.0;
        self.pulses.iter().all(pulse) && self.torque.is_sound()
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
