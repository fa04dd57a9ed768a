//! Whether a decoded flight can be one: every number in its range, and those that belong together do.

use nalgebra::Vector3;

use super::commands::PulseCommand;
use super::state::{DIRECTION_INTERVAL_S, LEAST_WORK, MOST_WORK, Plant, Sampling};
use crate::spin::{
    geometry::L1Ephemeris,
    sequencer::{FASTEST_RAD_S, SLOWEST_RAD_S, Sequencer},
    spinner::Spinner,
};

/// Squares and products of numbers up to this are finite.
const GREATEST: f64 = 1e100;
/// By which share of a turn times of one flight may be out of order.
const OUT_OF_ORDER: f64 = 1e-3;
/// How far the norm of a unit vector may be off 1.
const UNIT: f64 = 1e-6;

/// Whether a number and its square are finite; written so that a NaN is none.
pub(super) fn is_moderate(value: f64) -> bool {
    value.abs() <= GREATEST
}

fn are_moderate<'a>(values: impl IntoIterator<Item = &'a f64>) -> bool {
    values.into_iter().all(|&value| is_moderate(value))
}

fn is_unit(vector: &Vector3<f64>) -> bool {
    (vector.norm() - 1.0).abs() <= UNIT
}

impl Plant {
    /// Whether a decoded state can be flown on: its thrusters exist, its numbers are finite and belong together.
    pub fn fits(&self, spinner: &Spinner) -> bool {
        let burn = self.sequencer().map(Sequencer::burn);
        let known = (1_u64 << spinner.thrusters.len()) - 1;
        let masks =
            [self.mask, self.commands.fire, burn.map_or(0, |b| b.mask), burn.map_or(0, |b| b.opposite_mask)];
        masks.iter().all(|&mask| u64::from(mask) & !known == 0)
            && (LEAST_WORK..=MOST_WORK).contains(&self.work_limit)
            && self.start_is_sound()
            && self.motion_is_sound()
            && self.thrust_is_sound(spinner)
            && self.sensors_are_sound()
            && self.directions_are_sound()
            && self.sequencer().is_none_or(Sequencer::is_sound)
    }

    fn start_is_sound(&self) -> bool {
        let theory = self.theory;
        are_moderate(&self.initial_momentum_inertial)
            && is_unit(&self.initial_spin_axis_inertial)
            && (SLOWEST_RAD_S..=FASTEST_RAD_S).contains(&theory.rate_rad_s)
            && [theory.ratio, theory.inertia_kg_m2].iter().all(|x| is_moderate(*x) && is_moderate(x.recip()))
            && theory.ratio > 0.0
            && theory.inertia_kg_m2 > 0.0
    }

    fn motion_is_sound(&self) -> bool {
        let (now_s, anchor_s, end_s) = (self.time_s, self.motion.anchor_s(), self.motion.segment_end_s());
        let slack_s = OUT_OF_ORDER * self.theory.period_s();
        now_s.is_finite()
            && self.motion.is_sound()
            && anchor_s <= now_s + slack_s
            && now_s <= end_s + slack_s
            && self.motion.check_at(now_s).is_ok()
    }

    fn thrust_is_sound(&self, spinner: &Spinner) -> bool {
        let slack_s = OUT_OF_ORDER * self.theory.period_s();
        let since_s = [self.mask_since_s, self.delta_v_until_s];
        let pulse = |pulse: &PulseCommand| pulse.delay_s >= 0.0 && pulse.on_s >= 0.0;
        // A tank that is never empty and has nothing left would be emptied without end.
        (0.0..=spinner.mass_properties.most_propellant_kg()).contains(&self.initial_propellant_kg)
            && (0.0..=self.initial_propellant_kg).contains(&self.used_kg)
            && since_s.iter().all(|at_s| at_s.is_finite() && *at_s <= self.time_s + slack_s)
            && are_moderate(&self.delta_v_inertial_m_s)
            && self.predicted.is_sound()
            && self.commands.pulses.iter().all(pulse)
            && self.commands.torque.is_sound()
    }

    fn sensors_are_sound(&self) -> bool {
        let tick_s = self.clock_start_s + self.clock_count as f64 * self.clock_period_s;
        let times = [self.clock_start_s, self.sample.time_s, self.estimator_since_s];
        self.sun.is_sound()
            && self.star.is_sound()
            && are_moderate(&times)
            && is_moderate(self.clock_period_s)
            && self.clock_period_s > 0.0
            && (self.sampling == Sampling::Spins || tick_s > self.time_s - self.clock_period_s)
            && self.every > 0
            && are_moderate([&self.sun_sample_rad, &self.sample.declination_rad])
            && self.estimator.is_sound()
            && is_unit(&self.sensor_azimuths.sun)
            && is_unit(&self.sensor_azimuths.star)
    }

    fn directions_are_sound(&self) -> bool {
        let refreshes = match &self.l1 {
            None => self.refresh_s == f64::INFINITY,
            Some(l1) => {
                orbit_is_sound(l1)
                    && self.refresh_s == self.refresh_count as f64 * DIRECTION_INTERVAL_S
                    && (self.refresh_s - self.time_s).abs() <= 2.0 * DIRECTION_INTERVAL_S
            }
        };
        self.directions.are_directions() && refreshes
    }
}

/// Whether Sun and Earth of an L1 orbit have a direction at any time.
pub(super) fn orbit_is_sound(L1Ephemeris { orbit, phases }: &L1Ephemeris) -> bool {
    let angles = [phases.longitude_rad, phases.in_plane_rad, phases.out_of_plane_rad, orbit.obliquity_deg];
    let rates = [orbit.line_rate_deg_day, orbit.in_plane_frequency, orbit.out_of_plane_frequency];
    let distances = [orbit.sun_earth_distance_m, orbit.earth_l1_distance_m];
    angles.iter().chain(&rates).chain(&distances).chain(&orbit.amplitude_m).all(|&x| is_moderate(x))
        && orbit.amplitude_m[0].abs() < orbit.earth_l1_distance_m
}
