//! Air and magnetic field along the orbit, and what the air does to the spacecraft's surfaces.

pub(crate) mod aerodynamic_solver;
pub(crate) mod air_and_field_builder;
pub(crate) mod air_and_field_segment;
