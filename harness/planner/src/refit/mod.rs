//! Refit: centre of mass and the factor of sunlight's force from a history of momentum, with their covariance.

mod directions;
mod estimate;
mod expansion;
mod failure;
mod fitted;
mod parameters;
mod telemetry;

pub use directions::Direction;
pub use failure::Failure;
pub use fitted::{Fitted, Requested, fit};
pub use parameters::{Deviations, FITTED, Parameters};
pub use telemetry::{MOMENTUM, Telemetry};

use nalgebra::Vector3;

/// What a flight gives at the requested times.
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    /// EME2000, in N m s.
    pub momentum_inertial_n_m_s: Vec<Vector3<f64>>,
    /// Dumps so far.
    pub dumps: Vec<i32>,
}

/// The mission, flown with any values of what is fitted.
pub trait Flights {
    /// Momentum at times in s, which grow, in a flight without dumps by threshold.
    ///
    /// # Errors
    /// What ends a flight.
    fn fly(&self, parameters: &Parameters, times_s: &[f64]) -> Result<History, Failure>;
}

#[cfg(test)]
mod tests;
