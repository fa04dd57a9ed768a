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
use super::gyrostat::Gyrostat;
use super::gyrostat_series::GyrostatSeries;
use super::internal_motion::InternalMotion;
use super::internal_parts::InternalParts;
use super::quaternion::Quaternion;
use super::rotor_motion;
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
    series: RotationSeries<TERMS>,
    parts: InternalParts,
    inverse_inertia: Matrix3<f64>,
    load: BodyLoad,
    momentum_inertial_n_m_s: Vector3<f64>,
    delta_v_inertial_m_s: Vector3<f64>,
    /// Last evaluation; a cache.
    #[serde(skip)]
    known: Option<Known>,
}

/// Body `elapsed_s` after the start of a segment, and its attitudes at the nodes of the quadrature up to there.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Known {
    elapsed_s: f64,
    attitudes: [Quaternion; 3],
    body: BodyMotion,
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
        let mut motion = Self {
            start_s: time_s,
            end_s: time_s,
            series: RotationSeries::new(attitude, *rate_body_rad_s, momentum_body),
            parts: InternalParts::new(gyrostat, rate_body_rad_s, rotors_n_m_s),
            inverse_inertia: Matrix3::zeros(),
            load: BodyLoad::none(1.0),
            momentum_inertial_n_m_s: attitude.inertial_from_body(&momentum_body),
            delta_v_inertial_m_s: Vector3::zeros(),
            known: None,
        };
        motion.inverse_inertia = motion.inverse_inertia_of(gyrostat);
        motion
    }

    /// Rejects decoded states that no simulation with these numbers of wheels and modal coordinates can produce.
    pub fn is_valid(&self, wheels: usize, oscillators: usize) -> bool {
        self.parts.is_valid(wheels, oscillators)
            && self.series.is_valid()
            && self.start_s <= self.end_s
            && self.load.is_valid()
    }

    /// Before the first segment, what turns on hinges adds to the momentum.
    pub fn add_hinges(&mut self, internal: Option<InternalMotion>) {
        if let Some(internal) = &internal {
            let added_body = internal.momentum_after(0.0);
            self.momentum_inertial_n_m_s += self.series.attitude_after(0.0).inertial_from_body(&added_body);
        }
        self.load.internal = internal;
        self.forget();
    }

    /// Sets the attitude at the end at once, with the present inertia, and the motion of what turns on hinges
    /// from there on: the momentum is kept, those of rotors and modal coordinates along their axes too, and the rate follows.
    pub fn reorient(&mut self, gyrostat: &Gyrostat, attitude: Quaternion, internal: Option<InternalMotion>) {
        let elapsed_s = self.end_s - self.start_s;
        [self.momentum_inertial_n_m_s, self.delta_v_inertial_m_s] = self.totals_after(elapsed_s);
        self.parts.reorient(gyrostat, self.series.order, elapsed_s);
        self.forget();
        self.load.mass_kg = self.load.mass_after_kg(elapsed_s);
        self.load.internal = internal;
        (self.start_s, self.series.order) = (self.end_s, 0);
        self.series.attitude[0] = attitude.0.into();
        self.inverse_inertia = self.inverse_inertia_of(gyrostat);
    }

    /// Inverse inertia that gives the change of rate by an internal momentum, in 1/(kg m2), with the inertia of `gyrostat`.
    pub fn inverse_inertia_of(&self, gyrostat: &Gyrostat) -> Matrix3<f64> {
        self.parts.inverse_inertia(gyrostat)
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
            self.parts.rotors.iter_mut().for_each(|it| it.next = None);
        }
    }

    /// Returns the body at `time_s` within the segment and keeps it for the next call at that time.
    pub fn remembered_at(&mut self, gyrostat: &Gyrostat, time_s: f64) -> BodyMotion {
        let elapsed_s = time_s - self.start_s;
        if let Some(known) = self.known.filter(|it| it.elapsed_s == elapsed_s) {
            return known.body;
        }
        let order = self.series.order;
        self.parts
            .rotors
            .iter_mut()
            .for_each(|it| it.known = Some((elapsed_s, it.axial_after(order, elapsed_s))));
        let body = self.at(gyrostat, time_s);
        let attitudes = self.attitudes_before(elapsed_s);
        self.known = Some(Known { elapsed_s, attitudes, body });
        body
    }

    /// Drops the cached evaluation; the segment changes.
    fn forget(&mut self) {
        self.known = None;
        self.parts.rotors.iter_mut().for_each(|it| it.known = None);
    }

    /// Attitudes at the nodes of the quadrature over the first `elapsed_s` of the segment.
    fn attitudes_before(&self, elapsed_s: f64) -> [Quaternion; 3] {
        match self.known {
            Some(known) if known.elapsed_s == elapsed_s => known.attitudes,
            _ => GAUSS_3.map(|(node, _)| self.series.attitude_after(node * elapsed_s)),
        }
    }

    /// The body at `time_s` within the segment.
    pub fn at(&self, gyrostat: &Gyrostat, time_s: f64) -> BodyMotion {
        let elapsed_s = time_s - self.start_s;
        let attitude = self.series.attitude_after(elapsed_s);
        let [momentum_inertial_n_m_s, delta_v_inertial_m_s] = self.totals_after(elapsed_s);
        let momentum_body = attitude.body_from_inertial(&momentum_inertial_n_m_s);
        let rest = self.parts.rest_after(gyrostat, momentum_body, self.series.order, elapsed_s);
        let rest = self.load.internal.iter().fold(rest, |rest, it| rest - it.momentum_after(elapsed_s));
        BodyMotion {
            attitude,
            rate_body_rad_s: self.load.inverse_inertia_after(&self.inverse_inertia, elapsed_s) * rest,
            momentum_inertial_n_m_s,
            delta_v_inertial_m_s,
        }
    }

    /// Change of the total momentum since the start of the segment by each of these torques, body frame in N m with slopes in
    /// N m/s, that act from there on: EME2000, in N m s. Those of the whole load add up to the change of all.
    pub fn impulses_inertial_n_m_s<const N: usize>(
        &self,
        torques: &[Option<[Vector3<f64>; 2]>; N],
        time_s: f64,
    ) -> [Vector3<f64>; N] {
        self.integrals_inertial(time_s - self.start_s, [Vector3::zeros(); N], |_, at_s| {
            torques.map(|it| it.map_or_else(Vector3::zeros, |[start, slope]| start + slope * at_s))
        })
    }

    /// Change of the total momentum since the start of the segment by the dipole in the field, EME2000, in N m s; `None` without one.
    pub fn magnetic_impulse_inertial_n_m_s(&self, time_s: f64) -> Option<Vector3<f64>> {
        let dipole = self.load.dipole?;
        Some(self.impulse_inertial_n_m_s(time_s, |attitude, at_s| dipole.torque_n_m(attitude, at_s)))
    }

    /// The same by rotors out of balance; `None` where all are in balance.
    pub fn imbalance_impulse_inertial_n_m_s(&self, time_s: f64) -> Option<Vector3<f64>> {
        let torque = |_: &Quaternion, at_s: f64| self.parts.imbalance_after(self.series.order, at_s)[0];
        (!self.parts.imbalances.is_empty()).then(|| self.impulse_inertial_n_m_s(time_s, torque))
    }

    /// The same by what swings under the load; `None` where nothing does.
    pub fn swing_impulse_inertial_n_m_s(&self, time_s: f64) -> Option<Vector3<f64>> {
        let swings = !self.parts.oscillators.is_empty() && !self.load.is_zero();
        let torque = |_: &Quaternion, at_s: f64| self.parts.swing_torque_after(self.series.order, at_s);
        swings.then(|| self.impulse_inertial_n_m_s(time_s, torque))
    }

    fn impulse_inertial_n_m_s(
        &self,
        time_s: f64,
        torque_body_n_m: impl Fn(&Quaternion, f64) -> Vector3<f64>,
    ) -> Vector3<f64> {
        let torque = |attitude: &Quaternion, at_s: f64| [torque_body_n_m(attitude, at_s)];
        self.integrals_inertial(time_s - self.start_s, [Vector3::zeros()], torque)[0]
    }

    /// Adds to `sums` the integrals over the first `elapsed_s` of the segment of vectors in the body frame, by attitude and s since the
    /// start: EME2000.
    fn integrals_inertial<const N: usize>(
        &self,
        elapsed_s: f64,
        mut sums: [Vector3<f64>; N],
        vectors_body: impl Fn(&Quaternion, f64) -> [Vector3<f64>; N],
    ) -> [Vector3<f64>; N] {
        let attitudes = self.attitudes_before(elapsed_s);
        for ((node, weight), attitude) in GAUSS_3.into_iter().zip(attitudes) {
            for (sum, vector) in sums.iter_mut().zip(vectors_body(&attitude, node * elapsed_s)) {
                *sum += attitude.inertial_from_body(&vector) * (weight * elapsed_s);
            }
        }
        sums
    }

    /// Momentum of rotor `k` (0-based) relative to the body at `time_s`, where the body moves like this, in N m s.
    pub fn rotor_n_m_s(&self, gyrostat: &Gyrostat, k: usize, time_s: f64, motion: &BodyMotion) -> f64 {
        let (wheel, it) = (&gyrostat.wheels()[k], &self.parts.rotors[k]);
        match it.rotor {
            Rotor::Held { momentum_n_m_s } => momentum_n_m_s,
            Rotor::Turning { .. } => {
                let axial = it.axial_after(self.series.order, time_s - self.start_s);
                axial - wheel.carried_n_m_s(&motion.rate_body_rad_s)
            }
        }
    }

    /// Torque of `motor` that acts on rotor `k` (0-based) at `time_s`, along its axis, in N m:
    /// none of one that is locked or has no motor; at its capacity what holds it there, d/dt (h + I a.w) + f = I a.w' + f.
    pub fn motor_n_m(&self, gyrostat: &Gyrostat, motor: &Motor, k: usize, time_s: f64) -> f64 {
        let wheel = &gyrostat.wheels()[k];
        match self.parts.rotors[k].rotor {
            _ if motor.failed || wheel.locked => 0.0,
            Rotor::Held { momentum_n_m_s } if wheel.is_saturated(momentum_n_m_s) => {
                let acceleration = slope(&self.series.rate[..=self.series.order], time_s - self.start_s);
                wheel.carried_n_m_s(&acceleration) + wheel.friction_n_m(momentum_n_m_s)
            }
            Rotor::Held { .. } | Rotor::Turning { .. } => motor.torque_n_m,
        }
    }

    /// Displacement in sqrt(kg) m and speed in sqrt(kg) m/s of modal coordinate `k` (0-based) at `time_s`, where the body moves
    /// like this.
    pub fn oscillator(&self, k: usize, time_s: f64, motion: &BodyMotion) -> [f64; 2] {
        self.parts.oscillators[k].after(self.series.order, time_s - self.start_s, &motion.rate_body_rad_s)
    }

    /// Torque about the centre of mass in N m and force in N by rotors out of balance, body frame, where the body moves like this.
    pub fn imbalance_load(&self, gyrostat: &Gyrostat, time_s: f64, motion: &BodyMotion) -> [Vector3<f64>; 2] {
        let elapsed_s = time_s - self.start_s;
        let unbalanced = self.parts.imbalances.iter().zip(&gyrostat.appendages().imbalances);
        let mut sum = [Vector3::zeros(); 2];
        for (it, imbalance) in unbalanced {
            let held_n_m_s = self.rotor_n_m_s(gyrostat, imbalance.wheel, time_s, motion);
            let speed_rad_s = gyrostat.wheels()[imbalance.wheel].speed_rad_s(held_n_m_s);
            let load = it.at_speed(self.series.order, elapsed_s, speed_rad_s);
            sum.iter_mut().zip(load).for_each(|(sum, it)| *sum += it);
        }
        sum
    }

    /// Torque by what swings under the load at `time_s`, body frame, in N m.
    pub fn swing_torque_n_m(&self, time_s: f64) -> Vector3<f64> {
        self.parts.swing_torque_after(self.series.order, time_s - self.start_s)
    }

    /// Continues from the end: the next segment, at most to `limit_s`, under these motor torques and loads (linear in time from
    /// the present end on).
    pub fn advance(&mut self, gyrostat: &Gyrostat, motors: &[Motor], load: &BodyLoad, limit_s: f64) {
        let start_s = self.end_s;
        let motion = self.remembered_at(gyrostat, start_s);
        for k in 0..self.parts.rotors.len() {
            let relative_n_m_s = self.rotor_n_m_s(gyrostat, k, start_s, &motion);
            let (wheel, it) = (&gyrostat.wheels()[k], &mut self.parts.rotors[k]);
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
        self.parts.begin(gyrostat, load, self.series.order, (elapsed_s, &motion.rate_body_rad_s));
        (self.start_s, self.load) = (start_s, *load);
        self.momentum_inertial_n_m_s = motion.momentum_inertial_n_m_s;
        self.delta_v_inertial_m_s = motion.delta_v_inertial_m_s;
        self.series.attitude[0] = motion.attitude.0.into();
        self.series.momentum[0] = motion.attitude.body_from_inertial(&motion.momentum_inertial_n_m_s);
        self.forget();
        let longest_s = limit_s - start_s;
        // One rotor after another, as each that is set free or held changes what drives the others.
        let rounds = ROUNDS_A_ROTOR * self.parts.rotors.len();
        for round in 0..=rounds {
            self.inverse_inertia = self.parts.inverse_inertia(gyrostat);
            self.coefficients(gyrostat).build(motors, longest_s);
            let rate = &self.series.rate[..=self.series.order];
            if round == rounds
                || !rotor_motion::change_one(&mut self.parts.rotors, gyrostat.wheels(), motors, rate)
            {
                break;
            }
        }
        let converged_s = self.coefficients(gyrostat).converged_s(longest_s);
        let rate = &self.series.rate[..=self.series.order];
        let event_s =
            rotor_motion::first_event_s(&mut self.parts.rotors, gyrostat.wheels(), motors, rate, converged_s);
        self.end_s = if event_s < longest_s { start_s + event_s } else { limit_s };
    }

    fn coefficients<'a>(&'a mut self, gyrostat: &'a Gyrostat) -> GyrostatSeries<'a> {
        GyrostatSeries {
            gyrostat,
            series: &mut self.series,
            rotors: &mut self.parts.rotors,
            oscillators: &mut self.parts.oscillators,
            imbalances: &mut self.parts.imbalances,
            inverse_inertia: &self.inverse_inertia,
            load: &self.load,
        }
    }

    /// EME2000 to body at `time_s` within the segment.
    pub fn attitude_at(&self, time_s: f64) -> Quaternion {
        self.series.attitude_after(time_s - self.start_s)
    }

    /// Angular rate at `time_s` within the segment, body frame, in rad/s.
    pub fn rate_at(&self, time_s: f64) -> Vector3<f64> {
        polynomial(&self.series.rate[..=self.series.order], time_s - self.start_s)
    }

    /// Torque and acceleration by the load, rotors out of balance and what swings under the acceleration, body frame.
    fn loads_after(&self, elapsed_s: f64) -> [Vector3<f64>; 2] {
        let [mut torque, mut acceleration] = self.load.after(elapsed_s);
        if let Some(flow) = &self.load.mass_flow {
            let rate = polynomial(&self.series.rate[..=self.series.order], elapsed_s);
            torque += flow.jet_damping.torque_n_m(elapsed_s, &rate);
        }
        if !self.parts.imbalances.is_empty() {
            let [imbalance, force] = self.parts.imbalance_after(self.series.order, elapsed_s);
            torque += imbalance;
            acceleration += force / self.load.mass_after_kg(elapsed_s);
        }
        if !self.parts.oscillators.is_empty() {
            torque += self.parts.swing_torque_after(self.series.order, elapsed_s);
        }
        [torque, acceleration]
    }

    /// Total momentum and velocity change, inertial.
    fn totals_after(&self, elapsed_s: f64) -> [Vector3<f64>; 2] {
        let totals = [self.momentum_inertial_n_m_s, self.delta_v_inertial_m_s];
        if self.load.is_zero() && self.parts.imbalances.is_empty() {
            return totals;
        }
        self.integrals_inertial(elapsed_s, totals, |attitude, at_s| {
            let [mut torque, acceleration] = self.loads_after(at_s);
            if let Some(dipole) = &self.load.dipole {
                torque += dipole.torque_n_m(attitude, at_s);
            }
            [torque, acceleration]
        })
    }
}

#[cfg(test)]
mod dipole_tests;
#[cfg(test)]
mod imbalance_tests;
#[cfg(test)]
mod mass_flow_tests;
#[cfg(test)]
mod slosh_tests;
#[cfg(test)]
mod swing_tests;
#[cfg(test)]
mod tests;
