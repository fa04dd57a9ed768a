//! Paper 002: ACE's nutation from pulse trains, and its observation by the star tracker.

mod history;
mod numbers;
mod spinner;
mod tracker;
mod trains;

pub use history::figure4;
pub use numbers::numbers;
pub use tracker::{figure6, figure7};
pub use trains::{figure2, figure3};
