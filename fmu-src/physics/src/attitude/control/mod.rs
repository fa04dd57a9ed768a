//! Attitude control on board: sensors, estimation, reference attitude, feedback, distribution over wheels.
//!
//! Everything is sampled at one fixed rate. The order within a sample is: sensors and [`EstimatorState`] give an
//! [`Estimate`]; [`ControllerState`] follows the [`ControlTarget`] with it and gives the torque on the body over the
//! interval that begins at the sample; [`WheelAllocator`] spreads that over the wheels.

mod accelerometer;
mod allocation;
mod controller;
mod estimator;
mod reference;
mod sensors;
mod settings;
mod sun_sensors;

pub use accelerometer::{AccelerometerSettings, AccelerometerState};
pub use allocation::{Allocation, WheelAllocator};
pub use controller::ControllerState;
pub use estimator::{Estimate, EstimatorState};
pub use reference::{ControlTarget, Reference, ReferenceSample};
pub use sensors::{Gyro, SensorHealth, SensorSettings, StarTracker, sample_number};
pub use settings::{ControllerSettings, GainError};
pub use sun_sensors::{SunSensor, sensed_sun};

#[cfg(test)]
mod tests;
