//! Settings of a flight: configuration, dynamics, thrusters, light, bounds of work.

pub(super) mod air_and_field_settings;
pub(super) mod attitude_source;
pub(super) mod configuration;
pub(super) mod control_defaults;
pub(super) mod digest;
pub(super) mod dynamics_settings;
pub(super) mod error;
pub(super) mod laws;
pub(super) mod mode_settings;
pub(super) mod panel_setting;
pub(super) mod prepared_spacecraft;
pub(super) mod reaction_control_settings;
pub(super) mod thruster_events;
pub(super) mod work;
