//! The spacecraft in flight: one flight in two modes, an attitude that is followed ideally and one by dynamics; forecasts.

mod control_loop;
mod craft;
mod dynamic;
mod ideal;
mod momentum_dumps;
mod sensing;

pub mod outlook;
pub mod propagator_state;
pub mod report;
pub mod sun_choice;
pub mod wheel_control;
pub mod whole;

pub use craft::Given;
pub use dynamic::StartMotion;
