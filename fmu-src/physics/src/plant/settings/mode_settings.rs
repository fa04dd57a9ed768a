//! Settings of a flight by its mode.

use super::dynamics_settings::DynamicsSettings;
use crate::attitude::ReactionWheel;
use crate::attitude::control::SunSensor;
use crate::momentum::WheelArray;
use nalgebra::Vector3;

/// Settings of a mode, next to the configuration.
#[derive(Clone, Debug)]
pub enum ModeSettings {
    /// Settings of a flight whose attitude is followed ideally, and of one that waits.
    Ideal(IdealSettings),
    /// Settings of a flight by torque.
    Dynamic(Box<DynamicsSettings>),
}

/// Wheels and sensors of a flight in an attitude that is followed ideally.
#[derive(Clone, Debug)]
pub struct IdealSettings {
    /// Distribution of momentum over the wheels.
    pub array: WheelArray,
    /// The wheels, which follow ideally: inertia, capacity and bias count.
    pub wheels: Vec<ReactionWheel>,
    /// Sun sensors.
    pub sun_sensors: Vec<SunSensor>,
    /// Samples of the sensors a second.
    pub rate_hz: f64,
    /// Seed of the sensors' noise.
    pub seed: u64,
    /// The system's momentum where the flight begins, body frame, from the wheels' bias, in N m s.
    pub start_momentum_body_n_m_s: Vector3<f64>,
}

impl IdealSettings {
    /// Momentum of wheel `k` (0-based) where the wheels have to hold this together, body frame, in N m s: its bias, and its share of
    /// what is beside the biases of all.
    pub fn momentum_n_m_s(&self, k: usize, momentum_body_n_m_s: &Vector3<f64>) -> f64 {
        let from_bias = momentum_body_n_m_s - self.bias_body_n_m_s();
        self.wheels.get(k).map_or(0.0, |wheel| wheel.bias_n_m_s + self.array.momentum_n_m_s(k, &from_bias))
    }

    /// Sum of the wheels' biases, body frame, in N m s.
    fn bias_body_n_m_s(&self) -> Vector3<f64> {
        self.array.sum_body_n_m_s(self.wheels.iter().map(|wheel| wheel.bias_n_m_s))
    }
}
