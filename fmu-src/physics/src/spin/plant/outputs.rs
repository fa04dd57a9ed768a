//! Outputs of a spinner in flight: values and flags at the last communication point, and time derivatives of the continuous ones.

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
        let (initial, inertia) = (&plant.initial, &plant.motion.inertia);
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
            spin_axis_displacement_rad: angle_between_rad(&spin_axis_inertial, &initial.spin_axis_inertial),
            momentum_displacement_rad: angle_between_rad(
                &state.momentum_inertial,
                &initial.momentum_inertial,
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

/// First time derivatives of the continuous outputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rates {
    /// Rate of the quaternion.
    pub attitude_1_s: [f64; 4],
    /// Rate of the angular rate, body components.
    pub rate_rad_s2: Vector3<f64>,
    /// Rate of the spin about the third principal axis.
    pub spin_rate_rad_s2: f64,
    /// Rate of the momentum, inertial.
    pub momentum_inertial_n_m: Vector3<f64>,
    /// Rate of the momentum, body components.
    pub momentum_body_n_m: Vector3<f64>,
    /// Rate of the spin axis, inertial.
    pub spin_axis_1_s: Vector3<f64>,
    /// Rate of the thrusters' delta-v, inertial.
    pub delta_v_m_s2: Vector3<f64>,
    /// Rate of the nutation angle.
    pub nutation_rad_s: f64,
    /// Rate of the azimuth of the transverse momentum.
    pub nutation_phase_rad_s: f64,
    /// Rate of the Sun angle, for a Sun that stands still.
    pub sun_angle_rad_s: f64,
    /// Rate of the Earth angle, for an Earth that stands still.
    pub earth_angle_rad_s: f64,
    /// Rate of the spin axis's angle from its start.
    pub spin_axis_displacement_rad_s: f64,
    /// Rate of the momentum's angle from its start.
    pub momentum_displacement_rad_s: f64,
    /// Rate of the star's declination.
    pub declination_rad_s: f64,
    /// Rate of the kinetic energy.
    pub power_w: f64,
    /// Rate of the propellant used.
    pub flow_kg_s: f64,
    /// Rate of the mass and of the remaining propellant.
    pub mass_kg_s: f64,
}

impl Rates {
    /// Returns the derivatives at the present time.
    pub fn from_plant(plant: &Plant, spinner: &Spinner) -> Self {
        let time_s = plant.time_s;
        let motion = &plant.motion;
        let state = plant.state();
        let inertia = &motion.inertia;
        let q = state.attitude;
        // Everything about the principal axes, and from there to the body's.
        let h = inertia.principal_from_body(&state.momentum_body);
        let moments_kg_m2 = Vector3::from(inertia.principal_kg_m2());
        let rate = h.component_div(&moments_kg_m2);
        let gain = motion.damper.gain(&h);
        // See `damper`: the body turns at J^-1 h and a little about the line of nodes.
        let turning_principal = rate + Vector3::new(-h.y, h.x, 0.0) * gain;
        let turning = inertia.body_from_principal(&turning_principal);
        let torque_body = motion.torque.at(time_s, &turning);
        let torque = inertia.principal_from_body(&torque_body);
        let h_dot = h.cross(&turning_principal) + torque;
        let rate_dot = h_dot.component_div(&moments_kg_m2);
        let [x, y, z, w] = q.0;
        let v_dot = turning * w + Vector3::new(x, y, z).cross(&turning);
        let w_dot = -(x * turning.x + y * turning.y + z * turning.z);
        let axis = q.spin_axis_inertial();
        let axis_dot = q.inertial_from_body(&turning.cross(&Vector3::z()));
        let momentum_dot = q.inertial_from_body(&torque_body);
        let pull = state.momentum_inertial;
        let across_square = h.x * h.x + h.y * h.y;
        let across = across_square.sqrt();
        let directions = plant.directions_at(time_s);
        let law = &plant.propulsion.valves.law;
        let flow_kg_s = law.flow_at_kg_s(time_s);
        let mass_kg = plant.propulsion.mass_at_kg(spinner, time_s);
        let ratio = |a: f64, b: f64| if b > 0.0 { a / b } else { 0.0 };
        let across_dot = ratio(h.x * h_dot.x + h.y * h_dot.y, across);
        Self {
            attitude_1_s: [0.5 * v_dot.x, 0.5 * v_dot.y, 0.5 * v_dot.z, 0.5 * w_dot],
            rate_rad_s2: inertia.body_from_principal(&rate_dot),
            spin_rate_rad_s2: rate_dot.z,
            momentum_inertial_n_m: momentum_dot,
            momentum_body_n_m: inertia.body_from_principal(&h_dot),
            spin_axis_1_s: axis_dot,
            delta_v_m_s2: q.inertial_from_body(&law.force_at_n(time_s)) / mass_kg,
            nutation_rad_s: ratio(across_dot * h.z - across * h_dot.z, h.norm_squared()),
            nutation_phase_rad_s: ratio(h.x * h_dot.y - h.y * h_dot.x, across_square),
            sun_angle_rad_s: angle_rate(&axis, &axis_dot, &directions.sun_inertial),
            earth_angle_rad_s: angle_rate(&-axis, &-axis_dot, &directions.earth_inertial),
            spin_axis_displacement_rad_s: angle_rate(&axis, &axis_dot, &plant.initial.spin_axis_inertial),
            momentum_displacement_rad_s: angle_rate(&pull, &momentum_dot, &plant.initial.momentum_inertial),
            declination_rad_s: {
                let sine = axis.dot(&directions.star_inertial);
                ratio(axis_dot.dot(&directions.star_inertial), (1.0 - sine * sine).max(0.0).sqrt())
            },
            power_w: 0.5 * (rate_dot.dot(&h) + rate.dot(&h_dot)),
            flow_kg_s,
            mass_kg_s: -flow_kg_s,
        }
    }
}

/// Rate of the angle between a moving vector of any length and a fixed one; 0 where they are parallel.
fn angle_rate(moving: &Vector3<f64>, moving_dot: &Vector3<f64>, fixed: &Vector3<f64>) -> f64 {
    let normal = moving.cross(fixed);
    let (sine, square) = (normal.norm(), moving.norm_squared());
    if sine == 0.0 || square == 0.0 {
        return 0.0;
    }
    // The part of the motion toward the fixed vector closes the angle.
    let toward = normal.cross(moving);
    -moving_dot.dot(&toward) / (sine * square)
}
