//! Conditions about the spacecraft at one time, and its path ahead.

pub(super) mod air_and_field_builder;
pub(super) mod air_and_field_segment;
pub(super) mod conditions;
pub(super) mod geometry;
mod guided_law;
#[expect(clippy::module_inception, reason = "the type of the folder")]
pub(super) mod instant;
pub(super) mod kinematics;
