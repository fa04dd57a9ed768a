//! Motion of a body with reaction wheels and modal coordinates, as a Taylor series in time that is exact to rounding within a segment.
//!
//! Equations: dH/dt = T in inertial components, T with jet damping ([`super::mass_flow`]); in the body those of
//! [`super::series`], with m = A(q) H and (J + J' t) w = m less the rotors' share; for every rotor
//! that turns dp/dt = u - f ([`super::wheel`]); flexible modes and propellant ([`super::oscillator`]); w from m and all p
//! ([`super::gyrostat`]). Rotors out of balance add force and torque ([`super::imbalance`]).
//! Method: all of it is quadratic, so the coefficients follow from one another by Cauchy products. The total momentum is a
//! state of its own, which torque alone changes (Gauss-Legendre quadrature over the segment), and the body's momentum is
//! taken from it at the start of every segment: without torque it stays the same number. A segment ends where the series
//! would no longer be exact to rounding, where a rotor comes to rest, to its capacity or breaks away, or at the given limit.
//! Order: up to 10 in time, as many as rounding asks for.
//! Error measure: the last two terms of attitude, momentum, rotors and modal coordinates relative to their size, 1e-17; of
//! the phases of rotors out of balance 1e-14.
//! Reference: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, I.8; Hughes, Spacecraft Attitude
//! Dynamics, ch. 6 (gyrostat).

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::body_load::{BodyLoad, BodyMotion};
use super::dipole_in_field::DipoleInField;
use super::gyrostat::Gyrostat;
use super::gyrostat_series::GyrostatSeries;
use super::imbalance::ImbalanceMotion;
use super::internal_motion::InternalMotion;
use super::motion_at::{KEPT_ROTORS, MotionAt, node_attitudes};
use super::oscillator::OscillatorMotion;
use super::quaternion::Quaternion;
use super::rotor_motion::{self, RotorMotion};
use super::series::{RotationSeries, TERMS, polynomial, slope};
use super::wheel::{Motor, Rotor};
use crate::numerics::quadrature::GAUSS_3;

/// How often each rotor may be set free or held at one time until all agree.
const ROUNDS_A_ROTOR: usize = 3;

/// Motion over one segment: its state and dense output.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GyrostatMotion {
    start_s: f64,
    end_s: f64,
    series: GyrostatSeries,
    momentum_inertial_n_m_s: Vector3<f64>,
    delta_v_inertial_m_s: Vector3<f64>,
}

impl GyrostatMotion {
    /// At `time_s`, in this attitude and at this rate, the rotors holding these momenta relative to the body.
    pub fn new(
        gyrostat: &Gyrostat,
        time_s: f64,
        attitude: Quaternion,
        rate_body_rad_s: &Vector3<f64>,
        rotors_n_m_s: impl Fn(usize) -> f64,
    ) -> Self {
        let momentum_body = gyrostat.momentum_body_n_m_s(rate_body_rad_s, &rotors_n_m_s);
        let rotors = gyrostat.wheels().iter().enumerate().map(|(k, wheel)| {
            let held_n_m_s = rotors_n_m_s(k);
            let mut axial = [0.0; TERMS];
            axial[0] = held_n_m_s + wheel.carried_n_m_s(rate_body_rad_s);
            RotorMotion { rotor: Rotor::at_start(wheel, held_n_m_s), next: None, axial }
        });
        let imbalances = gyrostat.appendages().imbalances.iter().filter_map(|imbalance| {
            let wheel = gyrostat.wheels().get(imbalance.wheel)?;
            Some(ImbalanceMotion::new(imbalance, &wheel.axis_body, gyrostat.center_of_mass_body_m()))
        });
        let mut series = GyrostatSeries {
            rotation: RotationSeries::new(attitude, *rate_body_rad_s, momentum_body),
            rotors: rotors.collect(),
            oscillators: vec![OscillatorMotion::at_rest(); gyrostat.oscillator_count()],
            imbalances: imbalances.collect(),
            inverse_inertia: Matrix3::zeros(),
            load: BodyLoad::none(1.0),
        };
        series.inverse_inertia = series.inverse_inertia_of(gyrostat);
        Self {
            start_s: time_s,
            end_s: time_s,
            series,
            momentum_inertial_n_m_s: attitude.inertial_from_body(&momentum_body),
            delta_v_inertial_m_s: Vector3::zeros(),
        }
    }

    /// Rejects decoded states that no simulation with these numbers of wheels and modal coordinates can produce.
    pub fn is_valid(&self, wheels: usize, oscillators: usize) -> bool {
        let series = &self.series;
        self.start_s <= self.end_s
            && series.rotors.len() == wheels
            && series.oscillators.len() == oscillators
            && series.imbalances.len() <= wheels
            && series.is_valid()
    }

    /// Before the first segment, what turns on hinges adds to the momentum.
    pub fn add_hinges(&mut self, internal: Option<InternalMotion>) {
        if let Some(internal) = &internal {
            let attitude = self.series.rotation.attitude_after(0.0);
            self.momentum_inertial_n_m_s += attitude.inertial_from_body(&internal.momentum_after(0.0));
        }
        self.series.load.internal = internal;
    }

    /// Sets the attitude at the end at once, with the present inertia, and the motion of what turns on hinges
    /// from there on: the momentum is kept, those of rotors and modal coordinates along their axes too, and the rate follows.
    pub fn reorient(&mut self, gyrostat: &Gyrostat, attitude: Quaternion, internal: Option<InternalMotion>) {
        let elapsed_s = self.end_s - self.start_s;
        let attitudes = node_attitudes(&self.series.rotation, elapsed_s);
        [self.momentum_inertial_n_m_s, self.delta_v_inertial_m_s] = self.totals_after(elapsed_s, &attitudes);
        self.start_s = self.end_s;
        let series = &mut self.series;
        let order = series.rotation.order;
        series.rotors.iter_mut().for_each(|it| it.axial[0] = it.axial_after(order, elapsed_s));
        series.oscillators.iter_mut().for_each(|it| it.hold(order, elapsed_s));
        series.begin_imbalances(gyrostat, elapsed_s);
        series.load.mass_kg = series.load.mass_after_kg(elapsed_s);
        series.load.internal = internal;
        series.rotation.order = 0;
        series.rotation.attitude[0] = attitude.0.into();
        series.inverse_inertia = series.inverse_inertia_of(gyrostat);
    }

    /// Inverse inertia that gives the change of rate by an internal momentum, in 1/(kg m2), with the inertia of `gyrostat`: rotors that turn
    /// and modal coordinates keep their own.
    pub fn inverse_inertia_of(&self, gyrostat: &Gyrostat) -> Matrix3<f64> {
        self.series.inverse_inertia_of(gyrostat)
    }

    /// End of the present segment, in s.
    pub fn end_s(&self) -> f64 {
        self.end_s
    }

    /// Start of the present segment, in s.
    pub fn start_s(&self) -> f64 {
        self.start_s
    }

    /// Forgets the motion beyond `time_s`: what acts changes there.
    pub fn cut(&mut self, time_s: f64) {
        if time_s < self.end_s {
            self.end_s = time_s.max(self.start_s);
            self.series.rotors.iter_mut().for_each(|it| it.next = None);
        }
    }

    /// The body at `time_s` within the segment.
    pub fn at(&self, gyrostat: &Gyrostat, time_s: f64) -> BodyMotion {
        self.evaluated_at(gyrostat, time_s).body
    }

    /// The body at `time_s` within the segment, and what impulses up to there are integrated with.
    pub fn evaluated_at(&self, gyrostat: &Gyrostat, time_s: f64) -> MotionAt {
        let elapsed_s = time_s - self.start_s;
        let GyrostatSeries { rotation, rotors, oscillators, load, .. } = &self.series;
        let attitude = rotation.attitude_after(elapsed_s);
        let attitudes = node_attitudes(rotation, elapsed_s);
        let [momentum_inertial_n_m_s, delta_v_inertial_m_s] = self.totals_after(elapsed_s, &attitudes);
        let momentum_body = attitude.body_from_inertial(&momentum_inertial_n_m_s);
        let axial = |it: &RotorMotion| match it.rotor {
            Rotor::Turning { .. } => it.axial_after(rotation.order, elapsed_s),
            Rotor::Held { momentum_n_m_s } => momentum_n_m_s,
        };
        let mut rotors_n_m_s = [0.0; KEPT_ROTORS];
        rotors_n_m_s.iter_mut().zip(rotors).for_each(|(kept, it)| *kept = axial(it));
        let along = |k: usize| rotors_n_m_s.get(k).copied().unwrap_or_else(|| axial(&rotors[k]));
        let rest = momentum_body - gyrostat.along_axes(along);
        let swinging = oscillators.iter().map(|it| it.carried_after(rotation.order, elapsed_s));
        let rest = swinging.fold(rest, |rest, carried| rest - carried);
        let rest = load.internal.iter().fold(rest, |rest, it| rest - it.momentum_after(elapsed_s));
        let rate_body_rad_s = load.inverse_inertia_after(&self.series.inverse_inertia, elapsed_s) * rest;
        for ((kept, it), wheel) in rotors_n_m_s.iter_mut().zip(rotors).zip(gyrostat.wheels()) {
            if let Rotor::Turning { .. } = it.rotor {
                *kept -= wheel.carried_n_m_s(&rate_body_rad_s);
            }
        }
        let body = BodyMotion { attitude, rate_body_rad_s, momentum_inertial_n_m_s, delta_v_inertial_m_s };
        MotionAt { time_s, elapsed_s, body, attitudes, rotors_n_m_s }
    }

    /// Change of the total momentum since the start of the segment by a part of the load's dipole in the field, at the start in A m2 with
    /// its rate in A m2/s, body frame: EME2000, in N m s; `None` without a dipole in the load. Those of all parts add up.
    pub fn dipole_impulse_inertial_n_m_s(
        &self,
        dipole_body_a_m2: &[Vector3<f64>; 2],
        until: &MotionAt,
    ) -> Option<Vector3<f64>> {
        let part = DipoleInField { dipole_body_a_m2: *dipole_body_a_m2, ..self.series.load.dipole? };
        Some(until.impulse_inertial_n_m_s(|attitude, at_s| part.torque_n_m(attitude, at_s)))
    }

    /// The same by rotors out of balance; `None` where all are in balance.
    pub fn imbalance_impulse_inertial_n_m_s(&self, until: &MotionAt) -> Option<Vector3<f64>> {
        let torque = |_: &Quaternion, at_s: f64| self.series.imbalance_after(at_s)[0];
        (!self.series.imbalances.is_empty()).then(|| until.impulse_inertial_n_m_s(torque))
    }

    /// The same by what swings under the load; `None` where nothing does.
    pub fn swing_impulse_inertial_n_m_s(&self, until: &MotionAt) -> Option<Vector3<f64>> {
        let swings = !self.series.oscillators.is_empty() && !self.series.load.is_zero();
        swings.then(|| until.impulse_inertial_n_m_s(|_, at_s| self.series.swing_torque_after(at_s)))
    }

    /// Momentum of rotor `k` (0-based) relative to the body at the time of `at`, in N m s.
    pub fn rotor_at_n_m_s(&self, gyrostat: &Gyrostat, k: usize, at: &MotionAt) -> f64 {
        let kept = at.rotors_n_m_s.get(k).copied();
        kept.unwrap_or_else(|| self.rotor_n_m_s(gyrostat, k, at.time_s, &at.body))
    }

    /// Momentum of rotor `k` (0-based) relative to the body at `time_s`, where the body moves like this, in N m s.
    pub fn rotor_n_m_s(&self, gyrostat: &Gyrostat, k: usize, time_s: f64, motion: &BodyMotion) -> f64 {
        let (wheel, it) = (&gyrostat.wheels()[k], &self.series.rotors[k]);
        match it.rotor {
            Rotor::Held { momentum_n_m_s } => momentum_n_m_s,
            Rotor::Turning { .. } => {
                let axial = it.axial_after(self.series.rotation.order, time_s - self.start_s);
                axial - wheel.carried_n_m_s(&motion.rate_body_rad_s)
            }
        }
    }

    /// Torque of `motor` that acts on rotor `k` (0-based) at `time_s`, along its axis, in N m:
    /// none of one that is locked or has no motor; at its capacity what holds it there, d/dt (h + I a.w) + f = I a.w' + f.
    pub fn motor_n_m(&self, gyrostat: &Gyrostat, motor: &Motor, k: usize, time_s: f64) -> f64 {
        let wheel = &gyrostat.wheels()[k];
        match self.series.rotors[k].rotor {
            _ if motor.failed || wheel.locked => 0.0,
            Rotor::Held { momentum_n_m_s } if wheel.is_saturated(momentum_n_m_s) => {
                let acceleration = slope(self.series.rotation.rates(), time_s - self.start_s);
                wheel.carried_n_m_s(&acceleration) + wheel.friction_n_m(momentum_n_m_s)
            }
            Rotor::Held { .. } | Rotor::Turning { .. } => motor.torque_n_m,
        }
    }

    /// Displacement in sqrt(kg) m and speed in sqrt(kg) m/s of modal coordinate `k` (0-based) at `time_s`, where the body moves
    /// like this.
    pub fn oscillator(&self, k: usize, time_s: f64, motion: &BodyMotion) -> [f64; 2] {
        let order = self.series.rotation.order;
        self.series.oscillators[k].after(order, time_s - self.start_s, &motion.rate_body_rad_s)
    }

    /// Torque about the centre of mass in N m and force in N by rotors out of balance, body frame, where the body moves like this.
    pub fn imbalance_load(&self, gyrostat: &Gyrostat, time_s: f64, motion: &BodyMotion) -> [Vector3<f64>; 2] {
        let elapsed_s = time_s - self.start_s;
        let unbalanced = self.series.imbalances.iter().zip(&gyrostat.appendages().imbalances);
        unbalanced.fold([Vector3::zeros(); 2], |[torque, force], (it, imbalance)| {
            let held_n_m_s = self.rotor_n_m_s(gyrostat, imbalance.wheel, time_s, motion);
            let speed_rad_s = gyrostat.wheels()[imbalance.wheel].speed_rad_s(held_n_m_s);
            let [own, push] = it.at_speed(self.series.rotation.order, elapsed_s, speed_rad_s);
            [torque + own, force + push]
        })
    }

    /// Torque by what swings under the load at `time_s`, body frame, in N m.
    pub fn swing_torque_n_m(&self, time_s: f64) -> Vector3<f64> {
        self.series.swing_torque_after(time_s - self.start_s)
    }

    /// Continues from the end, where the body moves like this: the next segment, at most to `limit_s`, under these motor torques and
    /// loads (linear in time from the present end on).
    pub fn advance_from(
        &mut self,
        end: &MotionAt,
        gyrostat: &Gyrostat,
        motors: &[Motor],
        load: &BodyLoad,
        limit_s: f64,
    ) {
        let (start_s, motion) = (self.end_s, &end.body);
        for k in 0..self.series.rotors.len() {
            let relative_n_m_s = self.rotor_at_n_m_s(gyrostat, k, end);
            let (wheel, it) = (&gyrostat.wheels()[k], &mut self.series.rotors[k]);
            let carried = wheel.carried_n_m_s(&motion.rate_body_rad_s);
            let (rotor, relative_n_m_s) = match it.next.take() {
                Some(Rotor::Held { momentum_n_m_s }) => (Rotor::Held { momentum_n_m_s }, momentum_n_m_s),
                Some(turning) => (turning, relative_n_m_s),
                None => (it.rotor, relative_n_m_s),
            };
            it.rotor = rotor;
            it.axial[0] = relative_n_m_s + carried;
        }
        let elapsed_s = start_s - self.start_s;
        self.start_s = start_s;
        self.momentum_inertial_n_m_s = motion.momentum_inertial_n_m_s;
        self.delta_v_inertial_m_s = motion.delta_v_inertial_m_s;
        let (series, wheels) = (&mut self.series, gyrostat.wheels());
        series.begin_imbalances(gyrostat, elapsed_s);
        if !series.oscillators.is_empty() {
            let acceleration = load.acceleration_body_m_s2();
            let order = series.rotation.order;
            let oscillators = gyrostat.oscillators(load.mass_kg, &acceleration);
            for (it, oscillator) in series.oscillators.iter_mut().zip(oscillators) {
                let state = it.after(order, elapsed_s, &motion.rate_body_rad_s);
                it.begin(oscillator, state, &motion.rate_body_rad_s);
            }
        }
        series.load.copy_from(load);
        series.rotation.attitude[0] = motion.attitude.0.into();
        series.rotation.momentum[0] = motion.attitude.body_from_inertial(&motion.momentum_inertial_n_m_s);
        let longest_s = limit_s - start_s;
        series.build(gyrostat, motors, longest_s);
        // One rotor after another, as each that is set free or held changes what drives the others.
        for _ in 0..ROUNDS_A_ROTOR * series.rotors.len() {
            if !rotor_motion::change_one(&mut series.rotors, wheels, motors, series.rotation.rates()) {
                break;
            }
            series.build(gyrostat, motors, longest_s);
        }
        let converged_s = series.converged_s(gyrostat, longest_s);
        let rate = series.rotation.rates();
        let event_s = rotor_motion::first_event_s(&mut series.rotors, wheels, motors, rate, converged_s);
        self.end_s = if event_s < longest_s { start_s + event_s } else { limit_s };
    }

    /// EME2000 to body at `time_s` within the segment.
    pub fn attitude_at(&self, time_s: f64) -> Quaternion {
        self.series.rotation.attitude_after(time_s - self.start_s)
    }

    /// Angular rate at `time_s` within the segment, body frame, in rad/s.
    pub fn rate_at(&self, time_s: f64) -> Vector3<f64> {
        polynomial(self.series.rotation.rates(), time_s - self.start_s)
    }

    /// Total momentum and velocity change, inertial.
    fn totals_after(&self, elapsed_s: f64, attitudes: &[Quaternion; 3]) -> [Vector3<f64>; 2] {
        let mut totals = [self.momentum_inertial_n_m_s, self.delta_v_inertial_m_s];
        let is_free = self.series.load.is_zero() && self.series.imbalances.is_empty();
        if !is_free {
            for ((node, weight), attitude) in GAUSS_3.into_iter().zip(attitudes) {
                let at_s = node * elapsed_s;
                let [mut torque, acceleration] = self.series.loads_after(at_s);
                if let Some(dipole) = &self.series.load.dipole {
                    torque += dipole.torque_n_m(attitude, at_s);
                }
                for (total, load) in totals.iter_mut().zip([torque, acceleration]) {
                    *total += attitude.inertial_from_body(&load) * (weight * elapsed_s);
                }
            }
        }
        totals
    }
}

#[cfg(test)]
mod tests;
