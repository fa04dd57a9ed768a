//! Refit: centre of mass and the factor of sunlight's force from a history of momentum, with their covariance.

mod directions;
mod estimate;
mod expansion;
mod fitted;
mod flights;
mod parameters;
mod telemetry;

pub use directions::Direction;
pub use estimate::Requested;
pub use fitted::{Fitted, fit, is_trusted};
pub use flights::{Flights, History};
pub use parameters::{Deviations, FITTED, Parameters};
pub use telemetry::{MOMENTUM, Telemetry};

#[cfg(test)]
mod tests;
