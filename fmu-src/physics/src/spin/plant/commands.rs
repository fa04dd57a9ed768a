//! What the master gives a flight: commands and directions.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::spin::{series::BodyTorque, spinner::MOST_THRUSTERS};

/// Directions in inertial space that the sensors look for; unit vectors, or 0 for one that is not known: nothing is seen
/// there. On the L1 orbit those of Sun and Earth do not count.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Directions {
    /// Sun.
    pub sun_inertial: Vector3<f64>,
    /// Earth.
    pub earth_inertial: Vector3<f64>,
    /// Star.
    pub star_inertial: Vector3<f64>,
}

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

impl Directions {
    /// Whether all are unit vectors, or none.
    pub(super) fn are_directions(&self) -> bool {
        let unit = |direction: &Vector3<f64>| {
            *direction == Vector3::zeros() || (direction.norm() - 1.0).abs() < 1e-6
        };
        [&self.sun_inertial, &self.earth_inertial, &self.star_inertial].into_iter().all(unit)
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
