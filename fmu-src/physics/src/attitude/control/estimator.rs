//! Attitude estimation from gyros and star tracker: propagation by gyros, Kalman correction by the tracker.
//!
//! Per body axis the state is the attitude error and the gyro bias (Farrenkopf 1978; Markley & Crassidis,
//! "Fundamentals of Spacecraft Attitude Determination and Control", 2014, sections 4.7.1 and 6.2). The covariance is
//! propagated, so that the gains are the steady ones after a while and right after an outage.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::estimate::Estimate;
use super::sensors::{SensorHealth, SensorSettings};
use crate::attitude::rotation::Attitude;
use crate::numerics::chebyshev::GREATEST_IN_STATE;
use crate::numerics::noise::{Channel, normal_vector};

/// A star tracker measurement.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Fix {
    attitude: Attitude,
    sample: u64,
}

/// Covariance of attitude error and bias error of each body axis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Covariance {
    /// In rad2.
    angle: Vector3<f64>,
    /// In rad2/s.
    cross: Vector3<f64>,
    /// In rad2/s2.
    bias: Vector3<f64>,
}

/// The gyros' true bias, and what the estimator keeps from one sample to the next.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EstimatorState {
    /// Bias of the gyros at the last sample, in rad/s.
    true_bias_rad_s: Vector3<f64>,
    /// Attitude at the last sample, from which the gyros' angle counts; `None` before the first.
    last_truth: Option<Attitude>,
    attitude: Attitude,
    /// In rad/s.
    bias_rad_s: Vector3<f64>,
    covariance: Covariance,
    /// Rate of the last sample, in rad/s.
    rate_body_rad_s: Option<Vector3<f64>>,
    last_fix: Option<Fix>,
    samples_since_fix: u64,
    /// Whether the inertial reference was lost, until the next fix.
    is_lost: bool,
}

impl Covariance {
    /// Adds what the gyros' noise does in `interval_s`.
    fn propagate(&mut self, settings: &SensorSettings) {
        let dt = settings.interval_s;
        let angle = settings.gyro.angle_random_walk_rad_sqrt_s.powi(2) * dt;
        let bias = settings.gyro.rate_random_walk_rad_s_sqrt_s.powi(2) * dt;
        self.angle += (self.bias * dt - self.cross * 2.0) * dt;
        self.angle = self.angle.add_scalar(angle + bias * dt * dt / 3.0);
        self.cross = (self.cross - self.bias * dt).add_scalar(-bias * dt / 2.0);
        self.bias = self.bias.add_scalar(bias);
    }

    /// Takes in a measurement of variance `noise_rad2`; gains on angle and bias.
    fn update(&mut self, noise_rad2: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        let sum = self.angle + noise_rad2;
        let over_sum = |numerator: Vector3<f64>, otherwise: f64| {
            numerator.zip_map(&sum, |numerator, sum| if sum > 0.0 { numerator / sum } else { otherwise })
        };
        // Without any noise the measurement is taken as it is.
        let gains = (over_sum(self.angle, 1.0), over_sum(self.cross, 0.0));
        self.bias -= gains.1.component_mul(&self.cross);
        self.cross = noise_rad2.component_mul(&gains.1);
        self.angle = noise_rad2.component_mul(&gains.0);
        gains
    }

    /// The attitude becomes that of a measurement of variance `noise_rad2`.
    fn replace(&mut self, noise_rad2: &Vector3<f64>) {
        self.angle = *noise_rad2;
        self.cross = Vector3::zeros();
    }
}

impl EstimatorState {
    /// At the start, where the attitude is known.
    pub fn new(settings: &SensorSettings, attitude: Attitude) -> Self {
        let squared = |vector: &Vector3<f64>| vector.component_mul(vector);
        Self {
            true_bias_rad_s: settings.gyro.initial_bias_rad_s,
            last_truth: None,
            attitude,
            bias_rad_s: Vector3::zeros(),
            covariance: Covariance {
                angle: squared(&settings.star_tracker.noise_rad),
                cross: Vector3::zeros(),
                bias: squared(&settings.gyro.initial_bias_rad_s),
            },
            rate_body_rad_s: None,
            last_fix: None,
            samples_since_fix: 0,
            is_lost: false,
        }
    }

    /// Whether its numbers can come from a flight; bytes from elsewhere may hold anything.
    pub fn is_sound(&self) -> bool {
        let Covariance { angle, cross, bias } = &self.covariance;
        let vectors = [&self.true_bias_rad_s, &self.bias_rad_s, angle, cross, bias];
        let mut numbers = vectors.into_iter().chain(&self.rate_body_rad_s).flat_map(|v| v.iter());
        let others = self.last_truth.iter().chain(self.last_fix.iter().map(|fix| &fix.attitude));
        numbers.all(|x| x.abs() <= GREATEST_IN_STATE)
            && others.chain([&self.attitude]).all(Attitude::is_rotation)
    }

    /// Estimate at sample number `sample`, which follows the one before by `settings.interval_s`.
    pub fn sample(
        &mut self,
        settings: &SensorSettings,
        health: SensorHealth,
        truth_attitude: &Attitude,
        truth_rate_body_rad_s: &Vector3<f64>,
        sample: u64,
    ) -> Estimate {
        let (angle, rate) = self.gyro(settings, truth_attitude, truth_rate_body_rad_s, sample);
        self.propagate(settings, health, angle);
        let is_fix = health.star_tracker && sample.is_multiple_of(settings.samples_per_fix());
        let from_tracker = if is_fix { self.correct(settings, health, truth_attitude, sample) } else { None };
        self.rate_body_rad_s = match health {
            SensorHealth { gyro: true, .. } => Some(rate - self.bias_rad_s),
            SensorHealth { star_tracker: true, .. } if is_fix => from_tracker,
            SensorHealth { star_tracker: true, .. } => self.rate_body_rad_s,
            _ => None,
        };
        let without_fix_s = self.samples_since_fix as f64 * settings.interval_s;
        let is_between_fixes = health.star_tracker && self.samples_since_fix < settings.samples_per_fix();
        let is_recent = is_between_fixes || without_fix_s <= settings.longest_without_tracker_s;
        Estimate {
            attitude: self.attitude,
            is_valid: is_recent && !self.is_lost,
            rate_body_rad_s: self.rate_body_rad_s,
        }
    }

    /// Angle since the last sample and rate that the gyros give, in rad and rad/s; moves their bias on (Markley &
    /// Crassidis, section 4.7.1).
    fn gyro(
        &mut self,
        settings: &SensorSettings,
        truth_attitude: &Attitude,
        truth_rate: &Vector3<f64>,
        sample: u64,
    ) -> (Option<Vector3<f64>>, Vector3<f64>) {
        let dt = settings.interval_s;
        let walk = settings.gyro.rate_random_walk_rad_s_sqrt_s;
        let last_bias = self.true_bias_rad_s;
        let last_truth = self.last_truth.replace(*truth_attitude);
        if walk > 0.0 && last_truth.is_some() {
            self.true_bias_rad_s +=
                normal_vector(settings.seed, Channel::GyroBias, sample) * (walk * dt.sqrt());
        }
        let angle_walk = settings.gyro.angle_random_walk_rad_sqrt_s;
        let deviation = (angle_walk * angle_walk / dt + walk * walk * dt / 12.0).sqrt();
        let mut error = (last_bias + self.true_bias_rad_s) * 0.5;
        if deviation > 0.0 {
            error += normal_vector(settings.seed, Channel::GyroAngle, sample) * deviation;
        }
        let angle = last_truth.map(|last| last.rotation_vector_to(truth_attitude) + error * dt);
        (angle, truth_rate + error)
    }

    fn propagate(&mut self, settings: &SensorSettings, health: SensorHealth, angle: Option<Vector3<f64>>) {
        let Some(angle) = angle else { return };
        self.samples_since_fix = self.samples_since_fix.saturating_add(1);
        self.covariance.propagate(settings);
        if health.gyro {
            self.attitude = self.attitude.turned(angle - self.bias_rad_s * settings.interval_s).normalized();
        } else if let (true, Some(rate)) = (health.star_tracker, self.rate_body_rad_s) {
            self.attitude = self.attitude.propagated(rate, settings.interval_s).normalized();
        } else {
            self.is_lost = true;
        }
    }

    /// Takes in the star tracker's measurement; the rate from its difference to the one before, where that was in time.
    fn correct(
        &mut self,
        settings: &SensorSettings,
        health: SensorHealth,
        truth_attitude: &Attitude,
        sample: u64,
    ) -> Option<Vector3<f64>> {
        let noise = settings.star_tracker.noise_rad;
        let measured = if noise == Vector3::zeros() {
            *truth_attitude
        } else {
            let drawn = normal_vector(settings.seed, Channel::StarTrackerAxes, sample);
            truth_attitude.turned(drawn.component_mul(&noise))
        };
        let variance = noise.component_mul(&noise);
        if self.is_lost || !health.gyro {
            self.covariance.replace(&variance);
            self.attitude = measured;
        } else {
            let innovation = self.attitude.rotation_vector_to(&measured);
            let (gain, bias_gain) = self.covariance.update(&variance);
            self.bias_rad_s += bias_gain.component_mul(&innovation);
            self.attitude = if noise == Vector3::zeros() {
                measured
            } else {
                self.attitude.turned(gain.component_mul(&innovation)).normalized()
            };
        }
        self.is_lost = false;
        self.samples_since_fix = 0;
        let last = self.last_fix.replace(Fix { attitude: measured, sample })?;
        let per_fix = settings.samples_per_fix();
        (sample.checked_sub(last.sample) == Some(per_fix))
            .then(|| last.attitude.rotation_vector_to(&measured) / (per_fix as f64 * settings.interval_s))
    }
}
