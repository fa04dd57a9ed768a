//! Commands over time from a file, checked before the flight.
//!
//! A timeline is one TOML file ([`Timeline::from_toml`]) of `[[command]]`, `[[panels]]` and `[[event]]` tables. Keys and items are
//! those of the FMUs' variables; numbers are SI, or strings with a unit.

mod attitude;
mod build;
mod burn;
mod commands;
mod description;
mod devices;
mod entry;
mod events;
mod law;
mod quantity;
mod reads;
mod scans;
mod times;

#[cfg(test)]
mod tests;

pub use build::Timeline;
#[cfg(feature = "schema")]
pub use description::schema;
pub use entry::{
    DownlinkOverride, KeepInOverride, PlanStatus, Slot, TimelineBurn, TimelineClock, TimelineDump,
    TimelineEntry, TimelineEvent, TimelineManeuver, TimelinePanels, begun, simulation_time_s,
};
pub use law::{TimelineLaw, TimelineSettings, bodies_of};
