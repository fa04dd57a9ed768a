//! What parameters set about wheels and sensors where the attitude is followed ideally.

use nalgebra::Vector3;

use crate::attitude::control::SunSensor;
use crate::momentum::WheelArray;

/// Wheels and sensors of a flight in an attitude that is followed ideally.
#[derive(Clone, Debug)]
pub struct IdealSettings {
    /// Distribution of momentum over the wheels; none unless they span all directions.
    pub array: Option<WheelArray>,
    /// Inertia of each wheel, in kg m2, and what it can hold, in N m s.
    pub wheels: Vec<[f64; 2]>,
    /// Sun sensors.
    pub sun_sensors: Vec<SunSensor>,
    /// Samples of the sensors a second.
    pub rate_hz: f64,
    /// Of the sensors' noise.
    pub seed: u64,
    /// The system's momentum where the flight begins, body frame, in N m s.
    pub start_momentum_body_n_m_s: Vector3<f64>,
}
