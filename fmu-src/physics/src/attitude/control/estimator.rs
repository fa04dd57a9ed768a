//! Attitude estimation from gyros and star tracker: propagation by gyros, Kalman correction by the tracker; without gyros
//! propagation by an estimated rate.
//!
//! Per body axis the state is the attitude error and the gyro bias (Farrenkopf 1978; Markley & Crassidis,
//! "Fundamentals of Spacecraft Attitude Determination and Control", 2014, sections 4.7.1 and 6.2). The covariance is
//! propagated, so that the gains are the steady ones after a while and right after an outage.
//!
//! Without gyros the state is attitude error and rate, which moves as a random walk: w' = n with the spectral density a^2 T of an
//! acceleration a that holds from one measurement to the next, T. That is the same filter with the rate in place of the
//! negative bias and gyros that read zero (Bar-Shalom, Li & Kirubarajan, "Estimation with Applications to Tracking and
//! Navigation", 2001, section 6.2.2).

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::sensors::{SensorHealth, SensorSettings};
use crate::attitude::rotation::Attitude;
use crate::math;
use crate::numerics::noise::{Channel, normal_vector};

/// Variance of an unknown rate, in rad2/s2.
const UNKNOWN_RATE_RAD2_S2: f64 = 1.0;

/// As many measurements of an attitude give a rate.
const FIXES_FOR_A_RATE: u8 = 2;

/// Estimated attitude and rate at a sample.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// EME2000 to body; relative to an unknown inertial frame where not valid.
    pub attitude: Attitude,
    /// Whether the attitude is known in EME2000.
    pub is_valid: bool,
    /// Body rate, in rad/s; `None` where nothing measures it.
    pub rate_body_rad_s: Option<Vector3<f64>>,
}

/// The rate while the gyros do not work.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct RateFilter {
    rate_body_rad_s: Vector3<f64>,
    /// Covariance of attitude and negative rate.
    covariance: Covariance,
    /// Measurements of the attitude since nothing was known; the second gives a rate.
    fixes: u8,
}

/// Covariance of attitude error and bias error of each body axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Covariance {
    /// In rad2.
    angle: Vector3<f64>,
    /// In rad2/s.
    cross: Vector3<f64>,
    /// In rad2/s2.
    bias: Vector3<f64>,
}

/// The gyros' true bias, and what the estimator keeps from one sample to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
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
    /// While the gyros do not work and the star tracker does.
    without_gyros: Option<RateFilter>,
    samples_since_fix: u64,
    /// Whether the inertial reference was lost, until the next fix.
    is_lost: bool,
}

impl Covariance {
    /// Adds what random walks of angle and bias with these spectral densities, in rad2/s and rad2/s3, do in `dt`, in s.
    fn propagate(&mut self, angle_rad2_s: f64, bias_rad2_s3: f64, dt: f64) {
        let (angle, bias) = (angle_rad2_s * dt, bias_rad2_s3 * dt);
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
        let true_bias_rad_s = settings.gyro.initial_bias_rad_s;
        let [angle, bias] = [settings.star_tracker.noise_rad, true_bias_rad_s]
            .map(|deviation| deviation.component_mul(&deviation));
        let covariance = Covariance { angle, bias, ..Covariance::default() };
        Self { true_bias_rad_s, attitude, covariance, ..Self::default() }
    }

    /// Rejects decoded states that no simulation can produce.
    pub fn is_valid(&self) -> bool {
        self.last_truth.iter().chain([&self.attitude]).all(Attitude::is_rotation)
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
        self.update_health(settings, health);
        self.propagate(settings, health, angle);
        let samples_per_fix = settings.samples_per_fix();
        let is_fix = health.star_tracker && sample.is_multiple_of(samples_per_fix);
        if is_fix {
            self.correct(settings, truth_attitude, sample);
        }
        let of_gyros = health.gyro.then(|| rate - self.bias_rad_s);
        self.rate_body_rad_s = self.without_gyros.as_ref().map_or(of_gyros, RateFilter::rate);
        let without_fix_s = self.samples_since_fix as f64 * settings.interval_s;
        let is_between_fixes = health.star_tracker && self.samples_since_fix < samples_per_fix;
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
        let dt = settings.interval_s;
        self.samples_since_fix = self.samples_since_fix.saturating_add(1);
        let (angle_walk, rate_walk) =
            (settings.gyro.angle_random_walk_rad_sqrt_s, settings.gyro.rate_random_walk_rad_s_sqrt_s);
        self.covariance.propagate(math::powi(angle_walk, 2), math::powi(rate_walk, 2), dt);
        match &mut self.without_gyros {
            Some(filter) => {
                filter.covariance.propagate(0.0, settings.rate_density_rad2_s3(), dt);
                self.attitude = self.attitude.propagated(filter.rate_body_rad_s, dt).normalized();
                self.is_lost |= filter.rate().is_none();
            }
            None if health.gyro => {
                self.attitude = self.attitude.turned(angle - self.bias_rad_s * dt).normalized();
            }
            None => self.is_lost = true,
        }
    }

    /// Begins or ends to estimate the rate without gyros, as the sensors work.
    fn update_health(&mut self, settings: &SensorSettings, health: SensorHealth) {
        match (health, self.without_gyros) {
            (SensorHealth { gyro: false, star_tracker: true }, None) => {
                let known = self.rate_body_rad_s.filter(|_| self.last_truth.is_some() && !self.is_lost);
                let of_gyros_rad2_s2 =
                    math::powi(settings.gyro.angle_random_walk_rad_sqrt_s, 2) / settings.interval_s;
                let Covariance { angle, bias, .. } = self.covariance;
                let unknown = (Vector3::repeat(UNKNOWN_RATE_RAD2_S2), 0);
                let (bias, fixes) =
                    known.map_or(unknown, |_| (bias.add_scalar(of_gyros_rad2_s2), FIXES_FOR_A_RATE));
                let covariance = Covariance { angle, bias, ..Covariance::default() };
                let rate_body_rad_s = known.unwrap_or_default();
                self.without_gyros = Some(RateFilter { rate_body_rad_s, covariance, fixes });
            }
            (SensorHealth { gyro: true, .. }, Some(filter)) => {
                self.covariance.replace(&filter.covariance.angle);
                self.without_gyros = None;
            }
            (SensorHealth { gyro: false, star_tracker: false }, Some(_)) => self.without_gyros = None,
            _ => {}
        }
    }

    /// Takes in the star tracker's measurement.
    fn correct(&mut self, settings: &SensorSettings, truth_attitude: &Attitude, sample: u64) {
        let noise = settings.star_tracker.noise_rad;
        let measured = if noise == Vector3::zeros() {
            *truth_attitude
        } else {
            let drawn = normal_vector(settings.seed, Channel::StarTrackerAxes, sample);
            truth_attitude.turned(drawn.component_mul(&noise))
        };
        let variance = noise.component_mul(&noise);
        let is_first = self.without_gyros.as_ref().map_or(self.is_lost, |filter| filter.fixes == 0);
        let innovation = self.attitude.rotation_vector_to(&measured);
        let (covariance, known, sign) = match &mut self.without_gyros {
            Some(filter) => (&mut filter.covariance, &mut filter.rate_body_rad_s, -1.0),
            None => (&mut self.covariance, &mut self.bias_rad_s, 1.0),
        };
        let gain = if is_first {
            covariance.replace(&variance);
            None
        } else {
            let (gain, known_gain) = covariance.update(&variance);
            *known += known_gain.component_mul(&innovation) * sign;
            Some(gain)
        };
        let corrected =
            |gain: Vector3<f64>| self.attitude.turned(gain.component_mul(&innovation)).normalized();
        self.attitude = gain.filter(|_| noise != Vector3::zeros()).map_or(measured, corrected);
        if let Some(filter) = &mut self.without_gyros {
            filter.fixes = filter.fixes.saturating_add(1).min(FIXES_FOR_A_RATE);
        }
        self.is_lost = false;
        self.samples_since_fix = 0;
    }
}

impl RateFilter {
    /// The rate, once it is known.
    fn rate(&self) -> Option<Vector3<f64>> {
        (self.fixes >= FIXES_FOR_A_RATE).then_some(self.rate_body_rad_s)
    }
}
