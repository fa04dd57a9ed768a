//! Star tracker, gyros, accelerometers and Sun sensors of a flight, sampled with the controller.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::attitude::control::{AccelerometerState, Estimate, EstimatorState, sensed_sun};
use crate::attitude::{Attitude, BodyMotion, Quaternion};
use crate::plant::settings::dynamics_settings::{DynamicsInputs, DynamicsSettings};

/// Turn below which the quaternion keeps its nearer sign, in rad; a half turn at the most.
const SAME_SIGN_RAD: f64 = 1.0;

/// Last measurements of the sensors.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Sensing {
    /// Number of the next sample and its time, in s.
    next: (i64, f64),
    /// Time of the last sample, in s.
    pub sampled_s: f64,
    /// Attitude and velocity change at the last sample.
    sampled: (Quaternion, Vector3<f64>),
    estimator: EstimatorState,
    /// Attitude and rate at the last sample.
    pub estimate: Estimate,
    /// The Sun in the body frame as last sensed.
    pub sun_sensed_body: Option<Vector3<f64>>,
    /// Accelerometers.
    pub accelerometer: AccelerometerState,
}

impl Sensing {
    /// At the start of a flight in this attitude and at this rate; the first sample is due there.
    pub(crate) fn new(
        settings: &DynamicsSettings,
        time_s: f64,
        attitude: Attitude,
        rate_body_rad_s: Vector3<f64>,
    ) -> Self {
        Self {
            next: ((time_s * settings.rate_hz).floor() as i64, time_s),
            sampled_s: time_s,
            sampled: (attitude.unit_quaternion(), Vector3::zeros()),
            estimator: EstimatorState::new(&settings.sensors, attitude),
            estimate: Estimate { attitude, is_valid: true, rate_body_rad_s: Some(rate_body_rad_s) },
            sun_sensed_body: None,
            accelerometer: AccelerometerState::new(&settings.accelerometer),
        }
    }

    /// Whether a simulation can produce it.
    pub(crate) fn is_valid(&self) -> bool {
        let norm: f64 = self.sampled.0.0.iter().map(|x| x * x).sum();
        self.next.0.unsigned_abs() < 1 << 60
            && (norm - 1.0).abs() < 1e-9
            && self.estimator.is_valid()
            && self.estimate.attitude.is_rotation()
    }

    /// When the next sample is due, in s.
    pub(crate) fn next_s(&self) -> f64 {
        self.next.1
    }

    /// Samples the sensors of attitude and acceleration at `time_s`; the number of the sample.
    pub(crate) fn sample(
        &mut self,
        settings: &DynamicsSettings,
        inputs: &DynamicsInputs,
        time_s: f64,
        body: &BodyMotion,
    ) -> i64 {
        let sample = self.next.0;
        let next = (time_s * settings.rate_hz + 1e-6).floor() as i64 + 1;
        self.next = (next, next as f64 / settings.rate_hz);
        let number = sample as u64;
        let interval_s = time_s - self.sampled_s;
        if interval_s > 0.0 {
            let (before, velocity_m_s) = self.sampled;
            let increment = body.delta_v_inertial_m_s - velocity_m_s;
            let increment_body_m_s = before.halfway(&body.attitude).body_from_inertial(&increment);
            self.accelerometer.sample(&settings.accelerometer, &increment_body_m_s, interval_s, number);
        }
        let before = self.last_sign_reference(time_s, interval_s);
        self.sampled_s = time_s;
        self.sampled = (body.attitude, body.delta_v_inertial_m_s);
        let attitude = Attitude::from_unit(body.attitude);
        let rate = &body.rate_body_rad_s;
        self.estimate = self.estimator.sample(&settings.sensors, inputs.health, &attitude, rate, number);
        self.estimate.attitude = self.estimate.attitude.continuing(&before);
        sample
    }

    /// Samples the Sun sensors where the other sensors were sampled last, the Sun being in this direction (EME2000), so much of its disc
    /// visible.
    pub(crate) fn sample_sun(
        &mut self,
        settings: &DynamicsSettings,
        inputs: &DynamicsInputs,
        (to_sun, lit_fraction): (Vector3<f64>, f64),
        number: i64,
    ) {
        let (attitude, _) = self.sampled;
        self.sun_sensed_body = sensed_sun(
            &settings.sun_sensors,
            |k| inputs.sun_sensor_failed.get(k).is_some_and(|failed| *failed),
            &attitude.body_from_inertial(&to_sun),
            lit_fraction,
            (settings.sensors.seed, number as u64),
        );
    }

    /// Quaternion whose sign an estimate at `time_s` takes, `interval_s` after the last one: that one's own, unless the body may
    /// have turned far since.
    fn last_sign_reference(&self, time_s: f64, interval_s: f64) -> Quaternion {
        let rate_rad_s = self.estimate.rate_body_rad_s.map_or(0.0, |rate| rate.norm());
        let estimate =
            if rate_rad_s * interval_s < SAME_SIGN_RAD { self.estimate } else { self.estimate_at(time_s) };
        estimate.attitude.unit_quaternion()
    }

    /// The last estimate, propagated to `time_s`.
    pub(crate) fn estimate_at(&self, time_s: f64) -> Estimate {
        let rate_body_rad_s = self.estimate.rate_body_rad_s.unwrap_or_default();
        let attitude = self.estimate.attitude.propagated(rate_body_rad_s, time_s - self.sampled_s);
        Estimate { attitude, ..self.estimate }
    }
}
