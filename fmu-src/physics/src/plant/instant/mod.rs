//! Conditions about the spacecraft at one time, and its path ahead.

pub(super) mod air_and_field_builder;
pub(super) mod air_and_field_segment;
pub(super) mod at_time;
pub(super) mod conditions;
pub(super) mod geometry;
mod guided_law;
pub(super) mod kinematics;
