//! Reading a flight.

use core::f64::consts::PI;

use nalgebra::Vector3;

use super::commands::Directions;
use super::state::{Plant, Sampling, StarSample};
use crate::attitude::angle_between_rad;
use crate::spin::{
    crossing_detector::CrossingDetector, forecast::Timing, motion::Motion, nutation::Spin,
    sequencer::Sequencer, spinner::Spinner, tracker::NutationEstimator,
};

/// A Sun-timed burn that comes closer to the Sun's line than so many pulses and kicks is not well timed.
const SUN_CLEARANCE: f64 = 4.0;

impl Plant {
    /// The motion in force.
    pub fn motion(&self) -> &Motion {
        &self.motion
    }

    /// The burn in flight.
    pub fn sequencer(&self) -> Option<&Sequencer> {
        self.sequencer.as_ref()
    }

    /// Thrusters on, bit by bit.
    pub fn thrusters_on(&self) -> u32 {
        self.mask
    }

    /// Spin, ratio and inertia at the start, as planners know them.
    pub fn theory(&self) -> Spin {
        self.theory
    }

    /// Nutation by the linear theory after the last pulse, in rad.
    pub fn predicted_nutation_rad(&self) -> f64 {
        self.predicted.angle_rad()
    }

    /// Propellant used so far, in kg.
    pub fn propellant_used_kg(&self, spinner: &Spinner) -> f64 {
        self.used_at(spinner, self.time_s)
    }

    /// Delta-v so far, EME2000, in m/s.
    pub fn delta_v_inertial_m_s(&self, spinner: &Spinner) -> Vector3<f64> {
        self.delta_v_at(spinner, self.time_s)
    }

    /// Sun crossings.
    pub fn sun_watch(&self) -> &CrossingDetector {
        &self.sun
    }

    /// Last reading of the Sun sensor, in rad.
    pub fn sun_sample_rad(&self) -> f64 {
        self.sun_sample_rad
    }

    /// Last star tracker sample.
    pub fn sample(&self) -> StarSample {
        self.sample
    }

    /// Estimator over the samples since the last pulse.
    pub fn estimator(&self) -> &NutationEstimator {
        &self.estimator
    }

    /// Nominal time between samples of one star, in s.
    pub fn sample_spacing_s(&self) -> f64 {
        match self.sampling {
            Sampling::Clock => self.clock_period_s,
            Sampling::Spins => f64::from(self.every) * self.theory.period_s(),
        }
    }

    /// Spin axis at the start, inertial.
    pub fn initial_spin_axis_inertial(&self) -> Vector3<f64> {
        self.initial_spin_axis_inertial
    }

    /// Momentum at the start, inertial, in N m s.
    pub fn initial_momentum_inertial(&self) -> Vector3<f64> {
        self.initial_momentum_inertial
    }

    /// Propellant at the start, in kg.
    pub fn initial_propellant_kg(&self) -> f64 {
        self.initial_propellant_kg
    }

    /// Angle from the momentum at the start to the burn's target, in rad, if the burn goes beyond it by more than a pulse:
    /// there pulses take back what the others did.
    pub fn passed_target_rad(&self) -> Option<f64> {
        let burn = self.sequencer()?.burn();
        let apart_rad = angle_between_rad(&self.initial_momentum_inertial, &burn.target_inertial);
        let seen = self.predictions();
        let is_passed = seen.manoeuvre_rad > apart_rad + seen.manoeuvre_per_pulse_rad;
        (burn.points() && is_passed).then_some(apart_rad)
    }

    /// How close the momentum comes to the Sun's line, in rad, if that is too close for a burn timed by the Sun: its azimuth
    /// swings with nutation there.
    pub fn too_close_to_sun_rad(&self) -> Option<f64> {
        let seen = self.predictions();
        let near_rad = SUN_CLEARANCE * (seen.manoeuvre_per_pulse_rad + seen.kick_rad);
        self.sun_clearance_rad().filter(|&clearance_rad| clearance_rad < near_rad)
    }

    /// How close the momentum comes to the Sun's line (toward or away from it) on its way along the burn, in rad; `None`
    /// without a burn that is timed by the Sun.
    fn sun_clearance_rad(&self) -> Option<f64> {
        let burn = self.sequencer().map(Sequencer::burn)?;
        let sun = self.directions.sun_inertial;
        if !burn.points() || burn.timing != Timing::SunCrossing || sun == Vector3::zeros() {
            return None;
        }
        let from = self.initial_momentum_inertial.normalize();
        let toward = (burn.target_inertial - from * from.dot(&burn.target_inertial)).normalize();
        let way_rad = self.predictions().manoeuvre_rad;
        let clearance = |line: Vector3<f64>| {
            let nearest = line.dot(&toward).atan2(line.dot(&from)).rem_euclid(2.0 * PI);
            let along = |angle: f64| from * angle.cos() + toward * angle.sin();
            let ends = angle_between_rad(&line, &from).min(angle_between_rad(&line, &along(way_rad)));
            if nearest <= way_rad { ends.min(angle_between_rad(&line, &along(nearest))) } else { ends }
        };
        Some(clearance(sun).min(clearance(-sun)))
    }

    /// Directions at a time: on the L1 orbit they move.
    pub fn directions_at(&self, time_s: f64) -> Directions {
        let mut directions = self.directions;
        if let Some(l1) = &self.l1 {
            let seen = l1.sun_earth(time_s);
            directions.sun_inertial = seen.sun_inertial;
            directions.earth_inertial = seen.earth_inertial;
        }
        directions
    }
}
