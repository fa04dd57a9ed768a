//! What several models have in common: choices, groups of variables, what they read from a spacecraft.

pub mod choices;
pub mod spacecraft;
pub mod start_values;
pub mod variables;
