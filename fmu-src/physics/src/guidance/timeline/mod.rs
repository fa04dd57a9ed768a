//! Commands over time from a file, checked before the flight.
//!
//! A timeline is one TOML file ([`Timeline::from_toml`]) of `[[command]]` tables. Keys and items are those of Guidance's
//! variables; numbers are SI, or strings with a unit.

mod build;
mod burn;
mod commands;
mod description;
mod entry;
mod instant;
mod quantity;
mod reads;
mod scans;
#[cfg(feature = "schema")]
mod schema;

#[cfg(test)]
mod tests;

pub use build::Timeline;
pub use entry::{KeepInOverride, TimelineBurn, TimelineClock, TimelineEntry};
#[cfg(feature = "schema")]
pub use schema::schema;
