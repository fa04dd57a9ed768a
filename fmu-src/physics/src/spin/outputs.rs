//! What a spinner in flight shows: values and flags at the last communication point.

use core::f64::consts::PI;

use nalgebra::Vector3;

use super::{
    nutation::{exact_envelope_rad, period_variation_s},
    plant::{Plant, StarSample},
    sequencer::{Phase, Sequencer},
    spinner::Spinner,
    tracker::{NutationEstimate, observation_time_eq20_s, observation_time_s},
};
use crate::attitude::{RigidBodyState, angle_between_rad};

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

/// Which limits are violated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Violations {
    /// The Sun angle's.
    pub sun_angle: bool,
    /// The Earth angle's.
    pub earth_angle: bool,
    /// The spin rate's.
    pub spin_rate: bool,
    /// The variation of the spin period's.
    pub period_variation: bool,
}

impl Violations {
    /// Whether any is violated.
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
    /// In rad.
    pub nutation_rad: f64,
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
    /// Unit vectors, inertial.
    pub sun_inertial: Vector3<f64>,
    /// Unit vectors, inertial.
    pub earth_inertial: Vector3<f64>,
    /// From the spin axis, in rad.
    pub sun_angle_rad: f64,
    /// Sun sensor's last reading of it, in rad.
    pub sun_angle_measured_rad: f64,
    /// From the antenna (-Z), in rad.
    pub earth_angle_rad: f64,
    /// True declination of the star in the tracker, in rad.
    pub declination_rad: f64,
    /// Last sample.
    pub sample: StarSample,
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
    /// Principal moments, in kg m2.
    pub inertia_kg_m2: [f64; 3],
    /// I3/I_T.
    pub inertia_ratio: f64,
    /// Thrusters on, bit by bit.
    pub thrusters_on: u32,
    /// Body components, in N.
    pub force_body_n: Vector3<f64>,
    /// Body components, in N m.
    pub torque_body_n_m: Vector3<f64>,
    /// EME2000, in m/s.
    pub delta_v_inertial_m_s: Vector3<f64>,
    /// In kg.
    pub propellant_used_kg: f64,
    /// In kg.
    pub propellant_left_kg: f64,
    /// Mass with the propellant left, in kg.
    pub mass_kg: f64,
}

impl Outputs {
    /// Which of these limits are violated.
    pub fn violations(&self, bounds: &Bounds) -> Violations {
        let off_rad_s = (self.rate_rad_s.z - bounds.spin_rate_rad_s).abs();
        Violations {
            sun_angle: self.sun_angle_rad > bounds.sun_angle_rad,
            earth_angle: self.earth_angle_rad > bounds.earth_angle_rad,
            spin_rate: off_rad_s > bounds.spin_rate_tolerance_rad_s,
            period_variation: self.period_variation_s > bounds.period_variation_s,
        }
    }
}

/// Values that hold for a whole flight.
#[derive(Clone, Copy, Debug, PartialEq)]
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

impl Plant {
    /// What the flight shows at its present time.
    pub fn outputs(&self, spinner: &Spinner) -> Outputs {
        let time_s = self.time_s();
        let state = self.motion().at(time_s);
        let inertia = self.motion().inertia();
        let rate_rad_s = state.rate_rad_s(inertia);
        let nutation_rad = state.nutation_rad();
        let spin_axis_inertial = state.attitude.spin_axis_inertial();
        let directions = self.directions_at(time_s);
        let sun_angle_rad = angle_to_rad(&spin_axis_inertial, &directions.sun_inertial);
        let nominal_period_s = finite(2.0 * PI / rate_rad_s.z.abs());
        let sun = self.sun_watch();
        let period_s = sun.period_s().unwrap_or(nominal_period_s);
        let (period_change_s, share) = match (sun.period_s(), sun.period_before_s()) {
            (Some(last), Some(before)) => (last - before, (last - before) / before),
            _ => (0.0, 0.0),
        };
        let sectors = f64::from(spinner.sun_sensor.sectors);
        // Without a Sun there is no period of its crossings.
        let sun_known = directions.sun_inertial != Vector3::zeros();
        let variation_s =
            if sun_known { period_variation_s(nutation_rad, rate_rad_s.z, sun_angle_rad).abs() } else { 0.0 };
        let (mask, sequencer) = (self.thrusters_on(), self.sequencer());
        let thrust = spinner.thrust(mask);
        let next_edge_s = match sequencer.map(Sequencer::phase) {
            Some(Phase::Waiting { on_s, .. }) => on_s,
            Some(Phase::Firing { off_s }) => off_s,
            _ => -1.0,
        };
        let used_kg = self.propellant_used_kg(spinner);
        let left_kg = (self.initial_propellant_kg() - used_kg).max(0.0);
        Outputs {
            state,
            rate_rad_s,
            nutation_rad,
            predicted_nutation_rad: self.predicted_nutation_rad(),
            energy_j: 0.5 * rate_rad_s.dot(&state.momentum_body),
            spin_axis_inertial,
            spin_axis_displacement_rad: angle_between_rad(
                &spin_axis_inertial,
                &self.initial_spin_axis_inertial(),
            ),
            momentum_displacement_rad: angle_between_rad(
                &state.momentum_inertial,
                &self.initial_momentum_inertial(),
            ),
            period_s,
            period_change_s,
            sector_error: sectors * share,
            // A NaN (no nutation, Sun on the axis) counts as no variation.
            period_variation_s: if variation_s.is_nan() { 0.0 } else { variation_s.min(nominal_period_s) },
            sun_inertial: directions.sun_inertial,
            earth_inertial: directions.earth_inertial,
            sun_angle_rad,
            sun_angle_measured_rad: self.sun_sample_rad(),
            earth_angle_rad: angle_to_rad(&-spin_axis_inertial, &directions.earth_inertial),
            declination_rad: spin_axis_inertial.dot(&directions.star_inertial).clamp(-1.0, 1.0).asin(),
            sample: self.sample(),
            estimate: self.estimator().estimate(spinner.star_tracker.noise_deg.to_radians()),
            pulses_fired: sequencer.map_or(0, |s| s.fired()),
            burn_active: !self.is_dry() && sequencer.is_some_and(|s| s.is_active()),
            burn_done: sequencer.is_some_and(|s| s.phase() == Phase::Done),
            next_edge_s,
            inertia_kg_m2: inertia.principal_kg_m2(),
            inertia_ratio: inertia.ratio(),
            thrusters_on: mask,
            force_body_n: thrust.force_body_n,
            torque_body_n_m: thrust.torque_body_n_m,
            delta_v_inertial_m_s: self.delta_v_inertial_m_s(spinner),
            propellant_used_kg: used_kg,
            propellant_left_kg: left_kg,
            mass_kg: spinner.mass_properties.dry_mass_kg + left_kg,
        }
    }

    /// What theory says about the flight before it starts.
    pub fn predictions(&self) -> Predictions {
        let spin = self.theory();
        let nutation_rad_s = spin.ratio * spin.rate_rad_s;
        let mut seen = Predictions {
            nutation_ratio: spin.ratio,
            manoeuvre_per_pulse_rad: 0.0,
            kick_rad: 0.0,
            manoeuvre_rad: 0.0,
            envelope_rad: 0.0,
            duration_s: 0.0,
            count: 0,
            observation_time_eq20_s: finite(observation_time_eq20_s(spin.rate_rad_s, spin.ratio)),
            observation_time_s: finite(observation_time_s(self.sample_spacing_s(), nutation_rad_s)),
        };
        if let Some(sequencer) = self.sequencer() {
            let burn = sequencer.burn();
            let (train, torque) = (&burn.train, burn.torque_body_n_m.xy().norm());
            let widest_s = train.widest_s();
            let phase = spin.phase_advance_rad(train.turns_per_pulse());
            seen.manoeuvre_per_pulse_rad = spin.manoeuvre_rad(torque, widest_s);
            seen.kick_rad = spin.nutation_kick_rad(torque, widest_s);
            seen.manoeuvre_rad = train.manoeuvre_rad(&spin, torque);
            seen.envelope_rad = finite(exact_envelope_rad(seen.kick_rad, phase));
            seen.duration_s = train.duration_s(spin.period_s());
            seen.count = train.count();
        }
        seen
    }
}

/// Angle from an axis to a direction in rad; 0 where the direction is 0 and so not known.
fn angle_to_rad(axis: &Vector3<f64>, direction: &Vector3<f64>) -> f64 {
    if *direction == Vector3::zeros() { 0.0 } else { angle_between_rad(axis, direction) }
}

/// Infinity as the greatest number: masters and XML have no infinity.
fn finite(value: f64) -> f64 {
    if value.is_finite() { value } else { f64::MAX }
}

/// First time derivatives of the continuous outputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rates {
    /// Of the quaternion.
    pub attitude_1_s: [f64; 4],
    /// Of the angular rate, body components.
    pub rate_rad_s2: Vector3<f64>,
    /// Of the momentum, inertial.
    pub momentum_inertial_n_m: Vector3<f64>,
    /// Of the momentum, body components.
    pub momentum_body_n_m: Vector3<f64>,
    /// Of the spin axis, inertial.
    pub spin_axis_1_s: Vector3<f64>,
    /// Of the thrusters' delta-v, inertial.
    pub delta_v_m_s2: Vector3<f64>,
    /// Of the nutation angle.
    pub nutation_rad_s: f64,
    /// Of the azimuth of the transverse momentum.
    pub nutation_phase_rad_s: f64,
    /// Of the Sun angle, for a Sun that stands still.
    pub sun_angle_rad_s: f64,
    /// Of the Earth angle, for an Earth that stands still.
    pub earth_angle_rad_s: f64,
    /// Of the spin axis's angle from its start.
    pub spin_axis_displacement_rad_s: f64,
    /// Of the momentum's angle from its start.
    pub momentum_displacement_rad_s: f64,
    /// Of the star's declination.
    pub declination_rad_s: f64,
    /// Of the kinetic energy.
    pub power_w: f64,
    /// Of the propellant used.
    pub flow_kg_s: f64,
    /// Of the mass and of the propellant left.
    pub mass_kg_s: f64,
}

impl Plant {
    /// How fast the continuous outputs change at the present time.
    pub fn rates(&self, spinner: &Spinner) -> Rates {
        let time_s = self.time_s();
        let motion = self.motion();
        let state = motion.at(time_s);
        let (q, h) = (state.attitude, state.momentum_body);
        let inertia = motion.inertia();
        let rate = state.rate_rad_s(inertia);
        let gain = motion.damper().gain(&h);
        let torque = motion.torque().at(time_s);
        // See `damper`: the body turns at J^-1 h and a little about the line of nodes.
        let turning = rate + Vector3::new(-h.y, h.x, 0.0) * gain;
        let braking = Vector3::new(-h.x * h.z, -h.y * h.z, h.x * h.x + h.y * h.y) * gain;
        let h_dot = h.cross(&rate) + torque + braking;
        let [i1, i2, i3] = inertia.principal_kg_m2();
        let rate_dot = Vector3::new(h_dot.x / i1, h_dot.y / i2, h_dot.z / i3);
        let [x, y, z, w] = q.0;
        let v_dot = turning * w + Vector3::new(x, y, z).cross(&turning);
        let w_dot = -(x * turning.x + y * turning.y + z * turning.z);
        let axis = q.spin_axis_inertial();
        let axis_dot = q.inertial_from_body(&turning.cross(&Vector3::z()));
        let momentum_dot = q.inertial_from_body(&torque);
        let pull = state.momentum_inertial;
        let across_square = h.x * h.x + h.y * h.y;
        let across = across_square.sqrt();
        let directions = self.directions_at(time_s);
        let thrust = spinner.thrust(self.thrusters_on());
        let mass_kg = spinner.mass_properties.dry_mass_kg
            + (self.initial_propellant_kg() - self.propellant_used_kg(spinner)).max(0.0);
        let ratio = |a: f64, b: f64| if b > 0.0 { a / b } else { 0.0 };
        let across_dot = ratio(h.x * h_dot.x + h.y * h_dot.y, across);
        Rates {
            attitude_1_s: [0.5 * v_dot.x, 0.5 * v_dot.y, 0.5 * v_dot.z, 0.5 * w_dot],
            rate_rad_s2: rate_dot,
            momentum_inertial_n_m: momentum_dot,
            momentum_body_n_m: h_dot,
            spin_axis_1_s: axis_dot,
            delta_v_m_s2: q.inertial_from_body(&thrust.force_body_n) / mass_kg,
            nutation_rad_s: ratio(across_dot * h.z - across * h_dot.z, h.norm_squared()),
            nutation_phase_rad_s: ratio(h.x * h_dot.y - h.y * h_dot.x, across_square),
            sun_angle_rad_s: angle_rate(&axis, &axis_dot, &directions.sun_inertial),
            earth_angle_rad_s: angle_rate(&-axis, &-axis_dot, &directions.earth_inertial),
            spin_axis_displacement_rad_s: angle_rate(&axis, &axis_dot, &self.initial_spin_axis_inertial()),
            momentum_displacement_rad_s: angle_rate(&pull, &momentum_dot, &self.initial_momentum_inertial()),
            declination_rad_s: {
                let sine = axis.dot(&directions.star_inertial);
                ratio(axis_dot.dot(&directions.star_inertial), (1.0 - sine * sine).max(0.0).sqrt())
            },
            power_w: 0.5 * (rate_dot.dot(&h) + rate.dot(&h_dot)),
            flow_kg_s: thrust.flow_kg_s,
            mass_kg_s: -thrust.flow_kg_s,
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
