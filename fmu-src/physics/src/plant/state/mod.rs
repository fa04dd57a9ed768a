//! Everything of a flight that is saved; it knows no law of a source.

pub(super) mod center_of_mass;
pub(super) mod disturbance_interval;
pub(super) mod dynamic_state;
pub(super) mod flight_state;
pub(super) mod ideal_state;
pub(super) mod momentum_dumps;
pub(super) mod propagator_state;
