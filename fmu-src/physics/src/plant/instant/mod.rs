//! Conditions about the spacecraft at one time, and its path ahead.

pub(super) mod air_and_field_segment;
pub(super) mod conditions;
pub(super) mod path_ahead;

mod air_and_field_builder;
