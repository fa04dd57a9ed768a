//! Readings of the sensors: Sun crossings and star samples.

use core::f64::consts::PI;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::directions::{Directions, is_unit};
use super::start::{Sampling, Start};
use crate::attitude::{Inertia, RigidBodyState, angle_between_rad};
use crate::math;
use crate::numerics::noise::{Channel, normal};
use crate::spin::{
    crossing::{Crossing, CrossingDetector, Pole},
    motion::Motion,
    nutation::Spin,
    spinner::Spinner,
    tracker::{NutationEstimator, picket_of, searched},
    work::{Work, WorkKind},
};

/// A star tracker sample.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StarSample {
    /// When, in s; -1 before any.
    pub time_s: f64,
    /// Measured declination in the sensor, in rad.
    pub declination_rad: f64,
    /// Number of samples so far.
    pub count: u32,
}

/// Sensor that has a reading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sensor {
    Sun,
    StarTracker,
}

/// Sun sensor and star tracker with what they saw so far.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sensors {
    /// Sun crossings.
    pub sun: CrossingDetector,
    pub(super) star: CrossingDetector,
    /// Last reading of the Sun sensor, in rad.
    pub sun_sample_rad: f64,
    sampling: Sampling,
    clock_period_s: f64,
    clock_start_s: f64,
    clock_count: u64,
    /// Turns from one reading of the star to the next.
    every: u32,
    /// Last star tracker sample.
    pub sample: StarSample,
    /// Estimator over the samples since the last pulse.
    pub estimator: NutationEstimator,
    estimator_since_s: f64,
    /// Directions of the slits of Sun sensor and star tracker, body frame.
    azimuths: [Vector3<f64>; 2],
    seed: u64,
}

/// Motion and directions, as the sensors see them.
#[derive(Clone, Copy)]
pub(super) struct SensorView<'a> {
    pub motion: &'a Motion,
    pub directions: &'a Directions,
    pub theory: &'a Spin,
}

impl Sensors {
    /// Returns sensors before their first reading.
    pub(super) fn new(spinner: &Spinner, start: &Start, start_s: f64) -> Self {
        let slit = |azimuth_deg: f64| {
            let (sine, cosine) = math::sin_cos(azimuth_deg.to_radians());
            Vector3::new(cosine, sine, 0.0)
        };
        Self {
            sun: CrossingDetector::new(start_s),
            star: CrossingDetector::new(start_s),
            sun_sample_rad: 0.0,
            sampling: start.sampling,
            clock_period_s: f64::from(spinner.star_tracker.every) * 2.0 * PI / start.nominal_rate_rad_s,
            clock_start_s: start_s,
            clock_count: 0,
            every: spinner.star_tracker.every,
            sample: StarSample { time_s: -1.0, ..StarSample::default() },
            estimator: NutationEstimator::default(),
            estimator_since_s: start_s,
            azimuths: [spinner.sun_sensor.azimuth_deg, spinner.star_tracker.azimuth_deg].map(slit),
            seed: start.seed,
        }
    }

    /// Nominal time between samples of one star, in s.
    pub fn sample_spacing_s(&self, theory: &Spin) -> f64 {
        match self.sampling {
            Sampling::Clock => self.clock_period_s,
            Sampling::Spins => f64::from(self.every) * theory.period_s(),
        }
    }

    /// Forgets the motion from `now_s` on, where it changed.
    pub(super) fn forget_motion(&mut self, now_s: f64) {
        self.sun.forget(now_s);
        self.star.forget(now_s);
    }

    /// A pulse ended: nutation is estimated anew.
    pub(super) fn restart_estimate(&mut self, now_s: f64) {
        self.estimator = NutationEstimator::default();
        self.estimator_since_s = now_s;
    }

    /// The first thing there is to see up to `until_s`, and when, in s.
    pub(super) fn next_reading(
        &mut self,
        view: &SensorView<'_>,
        until_s: f64,
        work: &mut Work,
    ) -> Option<(Sensor, f64)> {
        let SensorView { motion, directions, .. } = *view;
        let [sun_azimuth, star_azimuth] = self.azimuths;
        let crossing = |body, inertial| move || Crossing { body, inertial, pole: Pole::SpinAxis };
        let due_s = |detector: &mut CrossingDetector, body, inertial: Vector3<f64>, work: &mut Work| {
            // A direction of 0 is none.
            let known = inertial != Vector3::zeros();
            let due_s =
                known.then(|| detector.due_s(motion, crossing(body, inertial), until_s, work)).flatten();
            due_s.unwrap_or(f64::INFINITY)
        };
        let sun_s = due_s(&mut self.sun, sun_azimuth, directions.sun_inertial, work);
        let star_s = if self.sampling == Sampling::Clock {
            let tick_s = self.clock_start_s + self.clock_count as f64 * self.clock_period_s;
            if tick_s <= until_s { tick_s } else { f64::INFINITY }
        } else {
            due_s(&mut self.star, star_azimuth, directions.star_inertial, work)
        };
        if sun_s.is_infinite() && star_s.is_infinite() {
            return None;
        }
        if sun_s <= star_s {
            return Some((Sensor::Sun, sun_s));
        }
        if self.sampling == Sampling::Clock {
            work.spend(WorkKind::ClockSample);
        }
        Some((Sensor::StarTracker, star_s))
    }

    /// The Sun sensor's reading as the Sun crosses it.
    pub(super) fn read_sun(&mut self, spinner: &Spinner, view: &SensorView<'_>, time_s: f64) {
        let SensorView { motion, directions, .. } = *view;
        let state = motion.at(time_s);
        let angle = angle_between_rad(&state.attitude.spin_axis_inertial(), &directions.sun_inertial);
        let noise = normal(self.seed, Channel::SunSensor, self.sun.count);
        self.sun_sample_rad = angle + spinner.sun_sensor.noise_deg.to_radians() * noise;
        self.sun.pass(time_s, state.rate_rad_s(&motion.inertia).z);
    }

    /// The star tracker's reading, if it sees the star.
    pub(super) fn read_star(&mut self, spinner: &Spinner, view: &SensorView<'_>, time_s: f64) {
        let SensorView { motion, directions, theory } = *view;
        let state = motion.at(time_s);
        let tracker = &spinner.star_tracker;
        let declination =
            math::asin(state.attitude.spin_axis_inertial().dot(&directions.star_inertial).clamp(-1.0, 1.0));
        let visible = directions.star_inertial != Vector3::zeros()
            && declination.abs() <= 0.5 * tracker.field_of_view_deg.to_radians();
        let turn = match self.sampling {
            Sampling::Clock => {
                self.clock_count = self.clock_count.saturating_add(1);
                None
            }
            Sampling::Spins => {
                self.star.pass(time_s, state.rate_rad_s(&motion.inertia).z);
                Some(self.star.count.wrapping_sub(1))
            }
        };
        // Pickets count from the Sun pulse: without a Sun there are none.
        let sun_known = directions.sun_inertial != Vector3::zeros();
        let seen = turn.is_none_or(|turn| {
            sun_known
                && searched(star_picket(spinner, directions, &motion.inertia, &state), turn, tracker.every)
        });
        if !(visible && seen) {
            return;
        }
        let noise = normal(self.seed, Channel::StarTracker, u64::from(self.sample.count));
        let declination_rad = declination + tracker.noise_deg.to_radians() * noise;
        self.sample = StarSample { time_s, declination_rad, count: self.sample.count.wrapping_add(1) };
        let phase = theory.ratio * theory.rate_rad_s * (time_s - self.estimator_since_s);
        self.estimator.add(phase, declination_rad);
    }

    /// Rejects decoded sensors that no simulation can produce at `time_s`.
    pub(super) fn is_valid(&self, time_s: f64) -> bool {
        let tick_s = self.clock_start_s + self.clock_count as f64 * self.clock_period_s;
        self.sun.is_valid()
            && self.star.is_valid()
            && self.clock_period_s > 0.0
            && (self.sampling == Sampling::Spins || tick_s > time_s - self.clock_period_s)
            && self.every > 0
            && self.estimator.is_valid()
            && self.azimuths.iter().all(is_unit)
    }
}

/// Picket of the star: its azimuth about the momentum after the Sun's.
fn star_picket(spinner: &Spinner, directions: &Directions, inertia: &Inertia, state: &RigidBodyState) -> u32 {
    let pole = state.momentum_inertial;
    let ahead = |direction: &Vector3<f64>| {
        let seen = state
            .attitude
            .body_from_inertial(&(direction - pole * (pole.dot(direction) / pole.norm_squared())));
        let seen = inertia.spin_frame_from_body(&seen);
        math::atan2(seen.y, seen.x)
    };
    // Half a picket of margin keeps a star that starts on a border off it.
    let pickets = spinner.star_tracker.pickets;
    let margin = PI / f64::from(pickets);
    picket_of(ahead(&directions.star_inertial) - ahead(&directions.sun_inertial) + margin, pickets)
}
