//! Star tracker and gyros: what they measure and how well.

use nalgebra::Vector3;

use crate::math;

/// A greater acceleration than this, in rad/s2, is not distinguished from one without limit.
const GREATEST_ACCELERATION_RAD_S2: f64 = 1e3;

/// A star tracker.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct StarTracker {
    /// Standard deviation of the measured attitude about each body axis, in rad.
    pub noise_rad: Vector3<f64>,
    /// Time between two measurements, in s; rounded to whole control samples, at least one.
    pub interval_s: f64,
}

/// Three gyros along the body axes.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Gyro {
    /// Angle random walk, in rad/sqrt(s).
    pub angle_random_walk_rad_sqrt_s: f64,
    /// Rate random walk of the bias, in rad/s/sqrt(s).
    pub rate_random_walk_rad_s_sqrt_s: f64,
    /// Bias at the start, which the estimator does not know, in rad/s.
    pub initial_bias_rad_s: Vector3<f64>,
}

/// The attitude sensors and how they are sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorSettings {
    /// Star tracker.
    pub star_tracker: StarTracker,
    /// Gyros.
    pub gyro: Gyro,
    /// Seed of the random draws.
    pub seed: u64,
    /// Time between two control samples, in s.
    pub interval_s: f64,
    /// Angular acceleration of the body that an estimate without gyros expects between two measurements of the star tracker, in
    /// rad/s2; infinite where it is unknown.
    pub acceleration_rad_s2: f64,
    /// How long after the last star tracker measurement the propagated attitude counts as known, in s.
    pub longest_without_tracker_s: f64,
}

/// Number of the sample of sensors at `rate_hz` that holds at `time_s`.
pub fn sample_number(time_s: f64, rate_hz: f64) -> u64 {
    ((time_s * rate_hz + 1e-6).floor() as i64) as u64
}

/// Health of the sensors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SensorHealth {
    /// Whether the star tracker works.
    pub star_tracker: bool,
    /// Whether the gyros work.
    pub gyro: bool,
}

impl SensorSettings {
    /// Control samples from one star tracker measurement to the next.
    pub fn samples_per_fix(&self) -> u64 {
        // A saturating conversion: what is no positive number gives 0, which counts as 1.
        ((self.star_tracker.interval_s / self.interval_s).round() as u64).max(1)
    }

    /// Spectral density of the acceleration by which the rate moves, in rad2/s3.
    pub(super) fn rate_density_rad2_s3(&self) -> f64 {
        let acceleration_rad_s2 = self.acceleration_rad_s2.min(GREATEST_ACCELERATION_RAD_S2);
        math::powi(acceleration_rad_s2, 2) * (self.samples_per_fix() as f64 * self.interval_s)
    }
}
