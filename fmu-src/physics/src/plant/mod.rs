//! The three-axis spacecraft put together: orbit, attitude, light and gravity gradient in one flight.
//!
//! [`Configuration`] says what flies where; [`Plant`] evaluates it and is the [`crate::momentum::Flight`] that momentum
//! accumulates over. What it has to remember between two evaluations is a [`Course`]: an integrated orbit, and a
//! [`LightCell`] of slowly changing light and heat.

mod configuration;
mod flight;
mod geometry;
mod kinematics;
mod light;
mod light_cell;
mod stored_heat;
mod stretch;
mod trajectory;
mod work;

pub use configuration::{
    AttitudeSource, Command, Configuration, EphemerisSource, Motion, PanelSetting, SunLight,
    orbit_from_elements,
};
pub use flight::{Craft, ExternalLoad, Plant, Snapshot};
pub use geometry::Geometry;
pub use kinematics::{Instant, Regime};
pub use light::{LightEffects, LightModel};
pub use light_cell::LightCell;
pub use stretch::{Course, PlantError};
pub use trajectory::Trajectory;
pub use work::{Cost, Work, WorkExceeded};
