//! Disturbances of the body at an instant and over an interval.

pub(super) mod disturbance_interval;
pub(super) mod evaluation;
pub(super) mod plant;
pub(super) mod simulation_context;
pub(super) mod simulation_models;
