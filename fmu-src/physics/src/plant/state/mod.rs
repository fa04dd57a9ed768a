//! Saved state of the propagator: trajectory, segments of light, air and field, Sun direction, centre of mass.

pub(super) mod center_of_mass;
pub(super) mod propagator_state;
pub(super) mod sun_choice;
