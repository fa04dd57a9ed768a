//! Three accelerometers along the body axes: sampled velocity increments with bias, its drift, scale error and noise.
//!
//! Over an interval dt each axis gives dv' = (1 + s) dv + (b + n) dt. Bias b and scale error s are drawn once from the seed,
//! the noise n once a sample; drift is a random walk of b. Draws are pure functions of seed and sample number.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::numerics::noise::{Channel, normal_vector};

/// How well the accelerometers measure; all zero is exact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AccelerometerSettings {
    /// Standard deviation of each axis's bias at the start, in m/s2.
    pub bias_m_s2: f64,
    /// Standard deviation of each axis's scale error.
    pub scale: f64,
    /// Standard deviation of each axis's mean acceleration over a sample's interval, in m/s2.
    pub noise_m_s2: f64,
    /// Random walk of the bias, in m/s2/sqrt(s).
    pub drift_m_s2_sqrt_s: f64,
    /// Seed of the random draws.
    pub seed: u64,
}

/// State of the accelerometers: biases and increments so far.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AccelerometerState {
    /// Bias at the last sample, in m/s2.
    bias_body_m_s2: Vector3<f64>,
    scale_error: Vector3<f64>,
    /// Sum of the increments, in m/s.
    delta_v_body_m_s: Vector3<f64>,
}

impl AccelerometerState {
    /// Before the first sample.
    pub fn new(settings: &AccelerometerSettings) -> Self {
        Self {
            bias_body_m_s2: drawn(settings, settings.bias_m_s2, Channel::AccelerometerBias, 0),
            scale_error: drawn(settings, settings.scale, Channel::AccelerometerScale, 0),
            delta_v_body_m_s: Vector3::zeros(),
        }
    }

    /// Adds the sample of this number: without gravity the velocity grew by `true_increment_body_m_s` along the body axes in
    /// the `interval_s` before it.
    pub fn sample(
        &mut self,
        settings: &AccelerometerSettings,
        true_increment_body_m_s: &Vector3<f64>,
        interval_s: f64,
        number: u64,
    ) {
        let walk_m_s2 = settings.drift_m_s2_sqrt_s * interval_s.sqrt();
        self.bias_body_m_s2 += drawn(settings, walk_m_s2, Channel::AccelerometerDrift, number);
        let noise_m_s2 = drawn(settings, settings.noise_m_s2, Channel::AccelerometerNoise, number);
        self.delta_v_body_m_s += true_increment_body_m_s
            + self.scale_error.component_mul(true_increment_body_m_s)
            + (self.bias_body_m_s2 + noise_m_s2) * interval_s;
    }

    /// Sum of the increments along the body axes since the start, in m/s.
    pub fn delta_v_body_m_s(&self) -> &Vector3<f64> {
        &self.delta_v_body_m_s
    }
}

/// Three numbers of this standard deviation.
fn drawn(settings: &AccelerometerSettings, deviation: f64, channel: Channel, event: u64) -> Vector3<f64> {
    if deviation == 0.0 {
        return Vector3::zeros();
    }
    normal_vector(settings.seed, channel, event) * deviation
}
