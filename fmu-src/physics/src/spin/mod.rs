//! The spinner: exact pulses, nutation, damper, sequencing, observation (paper 002).

pub mod burn;
pub mod burn_error;
pub mod burn_request;
pub mod coast;
pub mod crossing;
pub mod damper;
pub mod forecast;
pub mod geometry;
pub mod motion;
pub mod nutation;
pub mod plant;
pub mod sequencer;
pub mod series;
pub mod sizing;
pub mod spinner;
pub mod tracker;
pub mod train;
pub mod work;

#[cfg(test)]
mod tests;
