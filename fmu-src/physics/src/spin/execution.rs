//! How a spinner's thrusters execute their pulses: valve and scatter.

use serde::{Deserialize, Serialize};

use super::spinner::Spinner;
use crate::spacecraft::{MOST_THRUSTERS, Thruster, ValveTiming};

/// How a thruster executes its pulses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PulseExecution {
    /// How its valve opens and closes.
    pub valve: ValveTiming,
    /// Standard deviation of the thrust from pulse to pulse, as a fraction of it.
    pub scatter: f64,
}

impl PulseExecution {
    /// Returns the execution by the spinner's file, thruster by thruster.
    pub fn from_spinner(spinner: &Spinner) -> [Self; MOST_THRUSTERS] {
        let mut execution = [Self::default(); MOST_THRUSTERS];
        for (of_one, Thruster { valve, scatter, .. }) in execution.iter_mut().zip(&spinner.thrusters) {
            *of_one = Self { valve: *valve, scatter: *scatter };
        }
        execution
    }

    /// Rejects decoded numbers that no simulation can produce.
    pub fn is_valid(&self) -> bool {
        self.valve.is_valid() && (0.0..=1.0).contains(&self.scatter)
    }
}
