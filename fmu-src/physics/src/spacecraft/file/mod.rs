//! The spacecraft's file: its shape as people write it, and one function for each part that checks and turns it into data.

pub(crate) mod describe_operation;
pub(crate) mod pointing;

mod antennas;
pub(super) mod assembly;
mod body;
mod copies;
mod describe_body;
mod describe_devices;
mod describe_shapes;
mod describe_surfaces;
mod describe_swinging;
mod describe_thermal;
mod description;
mod devices;
mod facets;
mod mass;
mod materials;
mod names;
mod outline;
mod part_reader;
mod planet_map;
mod plates;
mod propulsion;
#[cfg(feature = "schema")]
mod schema;
mod shapes;
mod swinging;
mod thermal;
mod thruster_sets;
mod windows;
mod written_time;

#[cfg(feature = "schema")]
pub use schema::schema;
