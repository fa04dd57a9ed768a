//! Coefficients of a gyrostat's motion over a segment, and how long they are exact to rounding: [`super::gyrostat_motion`] has
//! equations, method, order, error measure and reference.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::body_load::BodyLoad;
use super::dipole_in_field::FieldSeries;
use super::gyrostat::Gyrostat;
use super::imbalance::ImbalanceMotion;
use super::oscillator::OscillatorMotion;
use super::rotor_motion::RotorMotion;
use super::series::{ORDER, ROUNDING, RotationSeries, TERMS, exact_length_s, polynomial};
use super::wheel::{Motor, Rotor};
use crate::numerics::chebyshev::largest_magnitude;

/// [`ROUNDING`] of cosine and sine of a rotor's phase, which act on the body through a small imbalance alone.
const PHASE_ROUNDING: f64 = 1e-14;

/// Coefficients of all that moves over a segment, the first ones given, and what they follow from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct GyrostatSeries {
    pub rotation: RotationSeries<TERMS>,
    pub rotors: Vec<RotorMotion>,
    pub oscillators: Vec<OscillatorMotion>,
    pub imbalances: Vec<ImbalanceMotion>,
    /// Inverse inertia of body and held rotors at the start, in 1/(kg m2).
    pub inverse_inertia: Matrix3<f64>,
    pub load: BodyLoad,
}

impl GyrostatSeries {
    /// Computes them, as many as count within `longest_s`.
    pub(super) fn build(&mut self, gyrostat: &Gyrostat, motors: &[Motor], longest_s: f64) {
        self.inverse_inertia = self.inverse_inertia_of(gyrostat);
        let scale = self.momentum_scale_n_m_s(gyrostat);
        let (mut power, mut small) = (1.0, 0);
        self.rotation.order = 0;
        let attitude = self.rotation.attitude_after(0.0);
        let mut magnetic = self.load.dipole.map(|it| (it.dipole_body_a_m2, FieldSeries::new(&it, &attitude)));
        loop {
            let j = self.rotation.order;
            self.rotation.rate[j] = self.rate_term(gyrostat, j);
            if j == ORDER || small == 2 {
                break;
            }
            power *= longest_s;
            let rates = &self.rotation.rate;
            let mut torque = self.load.torque_body_n_m.get(j).copied().unwrap_or_default();
            if let Some(flow) = &self.load.mass_flow {
                torque += flow.jet_damping.term(rates, j);
            }
            if let Some((dipole_body_a_m2, field)) = &mut magnetic {
                torque += field.extend(dipole_body_a_m2, rates, j);
            }
            for (it, imbalance) in self.imbalances.iter_mut().zip(&gyrostat.appendages().imbalances) {
                let wheel = &gyrostat.wheels()[imbalance.wheel];
                let relative = match &self.rotors[imbalance.wheel] {
                    RotorMotion { rotor: Rotor::Held { momentum_n_m_s }, .. } if j == 0 => *momentum_n_m_s,
                    RotorMotion { rotor: Rotor::Held { .. }, .. } => 0.0,
                    RotorMotion { axial, .. } => axial[j] - wheel.carried_n_m_s(&rates[j]),
                };
                torque += it.extend(j, wheel.speed_rad_s(relative));
            }
            for it in self.oscillators.iter_mut() {
                torque += it.torque_term(j);
                it.extend(j, &rates[j]);
            }
            for ((it, wheel), motor) in self.rotors.iter_mut().zip(gyrostat.wheels()).zip(motors) {
                let Rotor::Turning { direction } = it.rotor else { continue };
                if j > 0 && wheel.viscous_friction_n_m_s == 0.0 {
                    it.axial[j + 1] = 0.0;
                    continue;
                }
                let relative = it.axial[j] - wheel.carried_n_m_s(&rates[j]);
                let constant =
                    if j == 0 { motor.torque_n_m - wheel.coulomb_friction_n_m * direction } else { 0.0 };
                it.axial[j + 1] = (constant - wheel.viscous_rate_1_s() * relative) / (j + 1) as f64;
            }
            self.rotation.extend(torque);
            // The attitude's terms are seldom smaller than the others.
            let is_small = largest_magnitude(&self.rotation.attitude[j + 1]) * power < ROUNDING
                && self.size(gyrostat, scale, j + 1) * power < ROUNDING;
            small = if is_small { small + 1 } else { 0 };
        }
    }

    /// Coefficient of the rate from those of momentum and rotors.
    fn rate_term(&self, gyrostat: &Gyrostat, j: usize) -> Vector3<f64> {
        let wheels = gyrostat.wheels().iter().zip(self.rotors.iter());
        let rest = wheels.fold(self.rotation.momentum[j], |rest, (wheel, it)| match it.rotor {
            // Without viscous friction the third term and those after it are zero.
            Rotor::Turning { .. } if it.axial[j] == 0.0 => rest,
            Rotor::Turning { .. } => rest - wheel.axis_body * it.axial[j],
            Rotor::Held { momentum_n_m_s } if j == 0 => rest - wheel.axis_body * momentum_n_m_s,
            Rotor::Held { .. } => rest,
        });
        let rest = self.oscillators.iter().fold(rest, |rest, it| rest - it.carried_term(j));
        let rest = match &self.load.mass_flow {
            Some(flow) if j > 0 => rest - flow.inertia_rate_kg_m2_s * self.rotation.rate[j - 1],
            _ => rest,
        };
        let rest =
            self.load.internal.iter().fold(rest, |rest, it| rest - it.carried_term(&self.rotation.rate, j));
        self.inverse_inertia * rest
    }

    /// Greatest coefficient `j` of what swings, as a momentum: no coupling exceeds the root of the inertia.
    fn swing_n_m_s(&self, gyrostat: &Gyrostat, j: usize) -> f64 {
        if self.oscillators.is_empty() {
            return 0.0;
        }
        let most = self.oscillators.iter().map(|it| it.size(j)).fold(0.0, f64::max);
        most * gyrostat.inertia_body_kg_m2().trace().sqrt()
    }

    /// Greatest coefficient `j` relative to the whole.
    fn size(&self, gyrostat: &Gyrostat, scale_n_m_s: f64, j: usize) -> f64 {
        let turning = self.rotors.iter().filter(|it| matches!(it.rotor, Rotor::Turning { .. }));
        let momenta = turning.map(|it| &it.axial[j]).chain(&self.rotation.momentum[j]);
        let momentum = largest_magnitude(momenta).max(self.swing_n_m_s(gyrostat, j));
        let phase = self.imbalances.iter().map(|it| it.size(j)).fold(0.0, f64::max);
        largest_magnitude(&self.rotation.attitude[j])
            .max(momentum / scale_n_m_s)
            .max(phase * (ROUNDING / PHASE_ROUNDING))
    }

    /// Scale of momenta, in N m s, that terms are compared with.
    fn momentum_scale_n_m_s(&self, gyrostat: &Gyrostat) -> f64 {
        let rotors = self.rotors.iter().map(|it| it.axial[0].abs()).fold(0.0, f64::max);
        // Of a body at rest every change counts.
        self.rotation.momentum[0].amax().max(rotors).max(self.swing_n_m_s(gyrostat, 0)).max(1e-6)
    }

    /// How long the series is exact to rounding, at most `longest_s`, in s.
    pub(super) fn converged_s(&self, gyrostat: &Gyrostat, longest_s: f64) -> f64 {
        if self.rotation.order < ORDER {
            return longest_s;
        }
        let scale_n_m_s = self.momentum_scale_n_m_s(gyrostat);
        let sizes = [ORDER - 1, ORDER].map(|j| (j, self.size(gyrostat, scale_n_m_s, j)));
        exact_length_s(longest_s, sizes.into_iter())
    }

    /// Rejects decoded states that no simulation can produce.
    pub(super) fn is_valid(&self) -> bool {
        self.oscillators.iter().all(OscillatorMotion::is_valid)
            && self.imbalances.iter().all(ImbalanceMotion::is_valid)
            && self.rotation.is_valid()
            && self.load.mass_kg > 0.0
            && self.rotors.iter().all(RotorMotion::is_valid)
    }

    /// Begins a segment of the rotors out of balance at the phases that the last one has after `elapsed_s`.
    pub(super) fn begin_imbalances(&mut self, gyrostat: &Gyrostat, elapsed_s: f64) {
        for (it, imbalance) in self.imbalances.iter_mut().zip(&gyrostat.appendages().imbalances) {
            it.begin(imbalance, gyrostat.center_of_mass_body_m(), self.rotation.order, elapsed_s);
        }
    }

    /// Inverse inertia that gives the change of rate by an internal momentum, in 1/(kg m2), with the inertia of `gyrostat`: rotors that turn
    /// and modal coordinates keep their own.
    pub(super) fn inverse_inertia_of(&self, gyrostat: &Gyrostat) -> Matrix3<f64> {
        let swinging = self.oscillators.iter().map(|it| it.oscillator.inertia_body_kg_m2());
        gyrostat.inverse_inertia(self.rotors.iter().map(|it| &it.rotor), swinging)
    }

    /// Torque and acceleration by the load, rotors out of balance and what swings under the acceleration, body frame.
    pub(super) fn loads_after(&self, elapsed_s: f64) -> [Vector3<f64>; 2] {
        let [mut torque, mut acceleration] = self.load.after(elapsed_s);
        if let Some(flow) = &self.load.mass_flow {
            let rate = polynomial(self.rotation.rates(), elapsed_s);
            torque += flow.jet_damping.torque_n_m(elapsed_s, &rate);
        }
        if !self.imbalances.is_empty() {
            let [imbalance, force] = self.imbalance_after(elapsed_s);
            torque += imbalance;
            acceleration += force / self.load.mass_after_kg(elapsed_s);
        }
        if !self.oscillators.is_empty() {
            torque += self.swing_torque_after(elapsed_s);
        }
        [torque, acceleration]
    }

    /// Torque and force by rotors out of balance, body frame, as the series of the motion has them.
    pub(super) fn imbalance_after(&self, elapsed_s: f64) -> [Vector3<f64>; 2] {
        let loads = self.imbalances.iter().map(|it| it.after(self.rotation.order, elapsed_s));
        loads.fold([Vector3::zeros(); 2], |[torque, force], [own, push]| [torque + own, force + push])
    }

    /// Torque by what swings under the load, body frame.
    pub(super) fn swing_torque_after(&self, elapsed_s: f64) -> Vector3<f64> {
        self.oscillators.iter().map(|it| it.torque_after(self.rotation.order, elapsed_s)).sum()
    }
}
