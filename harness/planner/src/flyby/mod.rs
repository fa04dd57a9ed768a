//! Encounters of a recorded flight: what its B-plane depends on, at any time before, and what a miss costs behind it.

pub mod controls;
pub mod encounter;
pub mod flight;
mod light;
pub mod miss;
pub mod sensitivity;
#[cfg(test)]
mod test_flight;

pub use encounter::Encounter;
pub use flight::Surroundings;
pub use sensitivity::Sensitivity;
