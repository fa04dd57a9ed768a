//! Figures of a spacecraft's file for a person to judge: extents, areas, gyration, torque, and what cannot belong
//! together.

mod figures;
mod flight_settings;
mod flight_survey;
mod flight_watch;
mod hull;
mod surfaces;
mod thrusters;
mod warnings;

#[cfg(test)]
mod tests;

pub use figures::Figures;
pub use flight_settings::{FlightSettings, WheelSettings, air_moves_orbit};
pub use flight_survey::FlightSurvey;
pub use flight_watch::{FlightWatch, is_sun_offset_reached};
pub use hull::is_outside;
pub use thrusters::{ThrusterFigures, TorqueBothWays};
pub use warnings::{defaults_at_their_bounds, warnings};
