//! What acts on the body at an instant and over an interval.

pub mod by_source;
pub mod disturbance_interval;
pub mod evaluation;
pub mod laws;
