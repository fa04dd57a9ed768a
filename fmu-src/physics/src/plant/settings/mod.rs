//! What is set for a flight: configuration, dynamics, thrusters, light, bounds of work.

pub mod configuration;
pub mod control_defaults;
pub mod dynamics_settings;
pub mod error;
pub mod panel_setting;
pub mod radiation_settings;
pub mod reaction_control_settings;
pub mod work;
