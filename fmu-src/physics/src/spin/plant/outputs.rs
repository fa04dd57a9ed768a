//! Outputs of a spinner in flight: values and flags at the last communication point.

use core::f64::consts::PI;

use nalgebra::Vector3;

use super::predictions::finite;
use super::state::Plant;
use crate::attitude::{Inertia, RigidBodyState, angle_between_rad};
use crate::math;
use crate::spin::{
    nutation::period_variation_s, sequencer::Phase, spinner::Spinner, tracker::NutationEstimate,
};

/// Limits in SI units, as the master may have set them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// In rad.
    pub sun_angle_rad: f64,
    /// In rad.
    pub earth_angle_rad: f64,
    /// In rad/s.
    pub spin_rate_rad_s: f64,
    /// In rad/s.
    pub spin_rate_tolerance_rad_s: f64,
    /// In s.
    pub period_variation_s: f64,
}

/// Violated limits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Violations {
    /// Limit on the Sun angle.
    pub sun_angle: bool,
    /// Limit on the Earth angle.
    pub earth_angle: bool,
    /// Limit on the spin rate.
    pub spin_rate: bool,
    /// Limit on the variation of the spin period.
    pub period_variation: bool,
}

impl Violations {
    /// Tells whether any is violated.
    pub fn any(&self) -> bool {
        self.sun_angle || self.earth_angle || self.spin_rate || self.period_variation
    }
}

/// Values that follow from the trajectory at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs {
    /// Attitude and momentum.
    pub state: RigidBodyState,
    /// Body components, in rad/s.
    pub rate_rad_s: Vector3<f64>,
    /// About the third principal axis, in rad/s.
    pub spin_rate_rad_s: f64,
    /// From the third principal axis, in rad.
    pub nutation_rad: f64,
    /// Azimuth of the transverse momentum about that axis, from body X toward Y, in rad.
    pub nutation_phase_rad: f64,
    /// Linear theory (eq 8 generalised), in rad.
    pub predicted_nutation_rad: f64,
    /// Kinetic energy of rotation, in J.
    pub energy_j: f64,
    /// Spin axis, inertial.
    pub spin_axis_inertial: Vector3<f64>,
    /// From where it was at the start, in rad.
    pub spin_axis_displacement_rad: f64,
    /// Momentum, from where it pointed at the start, in rad.
    pub momentum_displacement_rad: f64,
    /// Time between the last two Sun crossings (of the present spin rate before there are two), in s.
    pub period_s: f64,
    /// Change of that time over one turn, in s.
    pub period_change_s: f64,
    /// Sectors by which data at the end of the last turn were misplaced.
    pub sector_error: f64,
    /// Eq 1, at most one period, in s.
    pub period_variation_s: f64,
    /// From the spin axis, in rad.
    pub sun_angle_rad: f64,
    /// From the antenna (-Z), in rad.
    pub earth_angle_rad: f64,
    /// True declination of the star in the tracker, in rad.
    pub declination_rad: f64,
    /// From the samples since the last pulse.
    pub estimate: NutationEstimate,
    /// Pulses of the burn that ended.
    pub pulses_fired: u32,
    /// Whether the burn runs.
    pub burn_active: bool,
    /// Whether the burn's last pulse ended.
    pub burn_done: bool,
    /// Next edge of the burn, in s; -1 without one.
    pub next_edge_s: f64,
    /// Moments of inertia and principal axes.
    pub inertia: Inertia,
    /// EME2000, in m/s.
    pub delta_v_inertial_m_s: Vector3<f64>,
    /// In kg.
    pub propellant_used_kg: f64,
    /// In kg.
    pub propellant_remaining_kg: f64,
}

impl Outputs {
    /// Returns the outputs at the present time of the flight.
    pub fn from_plant(plant: &Plant, spinner: &Spinner) -> Self {
        let time_s = plant.time_s;
        let state = plant.state();
        let inertia = &plant.motion.inertia;
        let rate_rad_s = state.rate_rad_s(inertia);
        let nutation_rad = state.nutation_rad(inertia);
        let spin_rate_rad_s = inertia.principal_from_body(&rate_rad_s).z;
        let spin_momentum = inertia.spin_frame_from_body(&state.momentum_body);
        let spin_axis_inertial = state.attitude.spin_axis_inertial();
        let directions = plant.directions_at(time_s);
        let sun_angle_rad = angle_to_rad(&spin_axis_inertial, &directions.sun_inertial);
        let nominal_period_s = finite(2.0 * PI / spin_rate_rad_s.abs());
        let sun = &plant.sensors.sun;
        let period_change =
            sun.period_s.zip(sun.period_before_s).map(|(last, before)| (last - before, before));
        let sectors = f64::from(spinner.sun_sensor.sectors);
        // Without a Sun there is no period of its crossings.
        let variation_s = match directions.sun_inertial == Vector3::zeros() {
            true => 0.0,
            false => period_variation_s(nutation_rad, spin_rate_rad_s, sun_angle_rad).abs(),
        };
        let sequencer = plant.sequencer.as_ref();
        let next_edge_s = match sequencer.map(|it| it.phase) {
            Some(Phase::Waiting { on_s, .. }) => on_s,
            Some(Phase::Firing { off_s }) => off_s,
            _ => -1.0,
        };
        Self {
            state,
            rate_rad_s,
            spin_rate_rad_s,
            nutation_rad,
            nutation_phase_rad: math::atan2(spin_momentum.y, spin_momentum.x),
            predicted_nutation_rad: plant.propulsion.predicted_nutation_rad(),
            energy_j: 0.5 * rate_rad_s.dot(&state.momentum_body),
            spin_axis_inertial,
            spin_axis_displacement_rad: angle_between_rad(
                &spin_axis_inertial,
                &plant.initial.spin_axis_inertial,
            ),
            momentum_displacement_rad: angle_between_rad(
                &state.momentum_inertial,
                &plant.initial.momentum_inertial,
            ),
            period_s: sun.period_s.unwrap_or(nominal_period_s),
            period_change_s: period_change.map_or(0.0, |(change_s, _)| change_s),
            sector_error: sectors * period_change.map_or(0.0, |(change_s, before_s)| change_s / before_s),
            // A NaN (no nutation, Sun on the axis) counts as no variation.
            period_variation_s: if variation_s.is_nan() { 0.0 } else { variation_s.min(nominal_period_s) },
            sun_angle_rad,
            earth_angle_rad: angle_to_rad(&-spin_axis_inertial, &directions.earth_inertial),
            declination_rad: math::asin(spin_axis_inertial.dot(&directions.star_inertial).clamp(-1.0, 1.0)),
            estimate: plant.sensors.estimator.estimate(spinner.star_tracker.noise_deg.to_radians()),
            pulses_fired: sequencer.map_or(0, |s| s.fired),
            burn_active: !plant.propulsion.is_dry() && sequencer.is_some_and(|s| s.is_active()),
            burn_done: sequencer.is_some_and(|s| s.phase == Phase::Done),
            next_edge_s,
            inertia: *inertia,
            delta_v_inertial_m_s: plant.propulsion.delta_v_at(spinner, &plant.motion, time_s),
            propellant_used_kg: plant.propulsion.used_at(time_s),
            propellant_remaining_kg: plant.propulsion.remaining_at(time_s),
        }
    }

    /// Returns the limits that are violated.
    pub fn violations(&self, bounds: &Bounds) -> Violations {
        let off_rad_s = (self.spin_rate_rad_s - bounds.spin_rate_rad_s).abs();
        Violations {
            sun_angle: self.sun_angle_rad > bounds.sun_angle_rad,
            earth_angle: self.earth_angle_rad > bounds.earth_angle_rad,
            spin_rate: off_rad_s > bounds.spin_rate_tolerance_rad_s,
            period_variation: self.period_variation_s > bounds.period_variation_s,
        }
    }
}

/// Angle from an axis to a direction in rad; 0 where the direction is 0, for lack of one.
fn angle_to_rad(axis: &Vector3<f64>, direction: &Vector3<f64>) -> f64 {
    if *direction == Vector3::zeros() { 0.0 } else { angle_between_rad(axis, direction) }
}
