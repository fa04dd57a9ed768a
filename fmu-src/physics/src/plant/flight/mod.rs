//! The spacecraft in flight: ideal and dynamic attitude, forecasts.

pub mod attitude_dynamics;
pub mod current;
pub mod ideal_flight;
pub mod outlook;
pub mod propagator_state;
pub mod sun_choice;
pub mod wheel_control;
