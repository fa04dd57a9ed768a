//! What holds for the physics as a whole.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "tests")]

mod module_order;
mod plant_flight;
mod plant_orbit;
#[cfg(feature = "schema")]
mod schema_file;
