//! The models through the functions a master calls.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "what a test expects may come from the system's functions")]

mod articulation;
mod center_defaults;
mod cruise;
mod cruise_centers;
mod cruise_legs;
mod cruise_predictions;
mod custom_body;
mod dependencies;
mod disturbance_degenerate;
mod disturbance_torque;
mod downlink_windows;
mod dynamics;
mod earth;
mod fixed;
mod guidance;
mod management;
mod maneuvers;
mod named_model;
mod onboard_ephemeris;
mod plant_changes;
mod plant_commands;
mod plant_cuts;
mod plant_ephemeris;
mod plant_light;
mod plant_refusals;
mod plant_rounding;
mod plant_slopes;
mod plant_thresholds;
mod plant_tolerance;
mod plant_unset;
mod plant_work;
mod random;
mod restored_states;
mod scheduled_events;
mod science_unload;
mod spacecraft;
mod spin_plant;
mod start_values;
mod timeline;
mod torn_states;
mod valves;
mod vocabulary;
mod wheel_torque;
mod without_effect;
