//! Paper 002: ACE's nutation from pulse trains, and its observation by the star tracker.

mod history;
mod numbers;
mod spinner;
mod tracker;
mod trains;

pub(crate) use history::figure4;
pub(crate) use numbers::numbers;
pub(crate) use tracker::{figure6, figure7};
pub(crate) use trains::{figure2, figure3};
