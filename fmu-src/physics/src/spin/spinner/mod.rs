//! The spinner's hardware, read once from its TOML file.

mod file;
mod hardware;

pub use file::Spinner;
pub use hardware::{Group, Limits, MassTable, StarTracker, SunSensor};
