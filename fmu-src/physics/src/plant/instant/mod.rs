//! Conditions about the spacecraft at one time, and its path ahead.

pub(super) mod conditions;
pub(super) mod path_ahead;
