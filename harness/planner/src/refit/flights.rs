//! Simulations of the mission with values of what is fitted.

use nalgebra::Vector3;

use super::parameters::Parameters;
use crate::Failure;

/// Momentum of a flight at the requested times.
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    /// EME2000, in N m s.
    pub momentum_inertial_n_m_s: Vec<Vector3<f64>>,
    /// Dumps so far.
    pub dumps: Vec<i32>,
}

/// The mission, simulated with any values of what is fitted.
pub trait Flights {
    /// Momentum at times in s, which grow, in a flight without dumps by threshold.
    ///
    /// # Errors
    /// What ends a flight.
    fn simulate(&self, parameters: &Parameters, times_s: &[f64]) -> Result<History, Failure>;
}
