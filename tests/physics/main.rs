//! Tests of the physics as a whole, from outside.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "what a test expects may come from the system's functions")]

mod bus_and_space;
mod forecast;
mod module_order;
mod planet_nodes;
mod plant_flight;
mod plant_orbit;
mod plant_shadow;
#[cfg(feature = "schema")]
mod schema_file;
mod shape_mistakes;
mod shapes;
mod timeline_names;
