//! The spacecraft's file: its shape as people write it, and one function for each part that checks and turns it into data.

pub(super) mod antennas;
pub(super) mod body;
pub(crate) mod description;
pub(super) mod devices;
pub(super) mod mass;
pub(super) mod materials;
pub(super) mod names;
pub(super) mod part_reader;
pub(super) mod planet_map;
pub(super) mod plates;
pub(crate) mod pointing;
pub(super) mod propulsion;
pub(super) mod swinging;
pub(super) mod thruster_sets;
pub(super) mod windows;

mod copies;
mod describe_shapes;
mod describe_swinging;
mod describe_thermal;
mod facets;
mod outline;
#[cfg(feature = "schema")]
mod schema;
mod shapes;
mod thermal;
mod written_time;

#[cfg(feature = "schema")]
pub use schema::schema;
