//! The spinner's hardware, read once from its TOML file.

mod description;
mod file;
mod hardware;

#[cfg(feature = "schema")]
pub use description::schema;
pub use file::Spinner;
pub use hardware::{Group, Limits, MassTable, PulseExecution, StarTracker, SunSensor};
