//! Predictions of theory for a flight before it starts, and the limits of their validity.

use core::f64::consts::PI;

use nalgebra::Vector3;

use super::state::Plant;
use crate::attitude::angle_between_rad;
use crate::math;
use crate::spin::{
    forecast::Timing,
    nutation::exact_envelope_rad,
    tracker::{observation_time_eq20_s, observation_time_s},
};

/// Least clearance of a Sun-timed burn from the Sun's line, in pulses and kicks: closer it is not well timed.
const SUN_CLEARANCE: f64 = 4.0;

/// Values that hold for a whole flight.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Predictions {
    /// I3/I_T with its true mean for a triaxial body: 1 + lambda/Omega.
    pub nutation_ratio: f64,
    /// Gamma/n of the burn's widest pulse, in rad (eq 3).
    pub manoeuvre_per_pulse_rad: f64,
    /// Nutation kick of that pulse, in rad.
    pub kick_rad: f64,
    /// Sum of the moves of all pulses, in rad.
    pub manoeuvre_rad: f64,
    /// Largest nutation of a uniform train of such pulses, in rad.
    pub envelope_rad: f64,
    /// From the first edge to the last, in s.
    pub duration_s: f64,
    /// Pulses of the burn.
    pub count: u32,
    /// Eq 20, in s.
    pub observation_time_eq20_s: f64,
    /// Exactly, for the flight's own sampling, in s.
    pub observation_time_s: f64,
}

impl Predictions {
    /// Returns the predictions of theory before the flight starts.
    pub fn from_plant(plant: &Plant) -> Self {
        let spin = plant.initial.theory;
        let nutation_rad_s = spin.ratio * spin.rate_rad_s;
        let sample_s = plant.sensors.sample_spacing_s(&spin);
        let mut seen = Self {
            nutation_ratio: spin.ratio,
            observation_time_eq20_s: finite(observation_time_eq20_s(spin.rate_rad_s, spin.ratio)),
            observation_time_s: finite(observation_time_s(sample_s, nutation_rad_s)),
            ..Self::default()
        };
        if let Some(sequencer) = &plant.sequencer {
            let burn = &sequencer.burn;
            let across = plant.motion.inertia.spin_frame_from_body(&burn.torques_body_n_m[0]).xy();
            let (train, torque) = (&burn.train, across.norm());
            let widest_s = train.widest_s();
            let phase = spin.phase_advance_rad(train.turns_per_pulse());
            seen.manoeuvre_per_pulse_rad = spin.manoeuvre_rad(torque, widest_s);
            seen.kick_rad = spin.nutation_kick_rad(torque, widest_s);
            seen.manoeuvre_rad = train.manoeuvre_rad(&spin, torque);
            seen.envelope_rad = finite(exact_envelope_rad(seen.kick_rad, phase));
            seen.duration_s = train.duration_s(spin.period_s());
            seen.count = train.count;
        }
        seen
    }

    /// Angle from the momentum at the start to the burn's target, in rad, if the burn goes beyond it by more than a pulse:
    /// there pulses take back what the others did.
    pub fn passed_target_rad(&self, plant: &Plant) -> Option<f64> {
        let burn = &plant.sequencer.as_ref()?.burn;
        let apart_rad = angle_between_rad(&plant.initial.momentum_inertial, &burn.target_inertial);
        let is_passed = self.manoeuvre_rad > apart_rad + self.manoeuvre_per_pulse_rad;
        (burn.points() && is_passed).then_some(apart_rad)
    }

    /// How close the momentum comes to the Sun's line, in rad, if that is too close for a burn timed by the Sun: its azimuth
    /// swings with nutation there.
    pub fn too_close_to_sun_rad(&self, plant: &Plant) -> Option<f64> {
        let near_rad = SUN_CLEARANCE * (self.manoeuvre_per_pulse_rad + self.kick_rad);
        self.sun_clearance_rad(plant).filter(|&clearance_rad| clearance_rad < near_rad)
    }

    /// How close the momentum comes to the Sun's line (toward or away from it) on its way along the burn, in rad; `None`
    /// without a burn that is timed by the Sun.
    fn sun_clearance_rad(&self, plant: &Plant) -> Option<f64> {
        let burn = plant.sequencer.as_ref().map(|it| &it.burn)?;
        let sun = plant.directions.present.sun_inertial;
        if !burn.points() || burn.timing != Timing::SunCrossing || sun == Vector3::zeros() {
            return None;
        }
        let from = plant.initial.momentum_inertial.normalize();
        let toward = (burn.target_inertial - from * from.dot(&burn.target_inertial)).normalize();
        let travel_rad = self.manoeuvre_rad;
        let clearance = |line: Vector3<f64>| {
            let nearest = math::atan2(line.dot(&toward), line.dot(&from)).rem_euclid(2.0 * PI);
            let along = |angle: f64| from * math::cos(angle) + toward * math::sin(angle);
            let ends = angle_between_rad(&line, &from).min(angle_between_rad(&line, &along(travel_rad)));
            if nearest <= travel_rad { ends.min(angle_between_rad(&line, &along(nearest))) } else { ends }
        };
        Some(clearance(sun).min(clearance(-sun)))
    }
}

/// Infinity as the greatest number: masters and XML have no infinity.
pub(super) fn finite(value: f64) -> f64 {
    if value.is_finite() { value } else { f64::MAX }
}
