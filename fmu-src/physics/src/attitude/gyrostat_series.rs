//! Coefficients of a gyrostat's motion over a segment, and how long they are exact to rounding: [`super::gyrostat_motion`] has
//! equations, method, order, error measure and reference.

use nalgebra::{Matrix3, Vector3};

use super::body_load::BodyLoad;
use super::dipole_in_field::FieldSeries;
use super::gyrostat::Gyrostat;
use super::imbalance::ImbalanceMotion;
use super::oscillator::OscillatorMotion;
use super::rotor_motion::RotorMotion;
use super::series::{ORDER, ROUNDING, RotationSeries, TERMS, exact_length_s};
use super::wheel::{Motor, Rotor};
use crate::numerics::chebyshev::largest_magnitude;

/// [`ROUNDING`] of cosine and sine of a rotor's phase, which act on the body through a small imbalance alone.
const PHASE_ROUNDING: f64 = 1e-14;

/// Coefficients of all that moves over a segment, the first ones given, and what they follow from.
pub(super) struct GyrostatSeries<'a> {
    pub gyrostat: &'a Gyrostat,
    pub series: &'a mut RotationSeries<TERMS>,
    pub rotors: &'a mut [RotorMotion],
    pub oscillators: &'a mut [OscillatorMotion],
    pub imbalances: &'a mut [ImbalanceMotion],
    /// Inverse inertia of body and held rotors at the start, in 1/(kg m2).
    pub inverse_inertia: &'a Matrix3<f64>,
    pub load: &'a BodyLoad,
}

impl GyrostatSeries<'_> {
    /// Computes them, as many as count within `longest_s`.
    pub(super) fn build(&mut self, motors: &[Motor], longest_s: f64) {
        let scale = self.momentum_scale_n_m_s();
        let (mut power, mut small) = (1.0, 0);
        self.series.order = 0;
        let attitude = self.series.attitude_after(0.0);
        let mut magnetic = self.load.dipole.map(|it| (it.dipole_body_a_m2, FieldSeries::new(&it, &attitude)));
        loop {
            let j = self.series.order;
            self.series.rate[j] = self.rate_term(j);
            if j == ORDER || small == 2 {
                break;
            }
            power *= longest_s;
            let rates = &self.series.rate;
            let mut torque = self.load.torque_body_n_m.get(j).copied().unwrap_or_default();
            if let Some(flow) = &self.load.mass_flow {
                torque += flow.jet_damping.term(rates, j);
            }
            if let Some((dipole_body_a_m2, field)) = &mut magnetic {
                torque += field.extend(dipole_body_a_m2, rates, j);
            }
            for (it, imbalance) in self.imbalances.iter_mut().zip(&self.gyrostat.appendages().imbalances) {
                let wheel = &self.gyrostat.wheels()[imbalance.wheel];
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
            for ((it, wheel), motor) in self.rotors.iter_mut().zip(self.gyrostat.wheels()).zip(motors) {
                let Rotor::Turning { direction } = it.rotor else { continue };
                let relative = it.axial[j] - wheel.carried_n_m_s(&rates[j]);
                let constant =
                    if j == 0 { motor.torque_n_m - wheel.coulomb_friction_n_m * direction } else { 0.0 };
                it.axial[j + 1] = (constant - wheel.viscous_rate_1_s() * relative) / (j + 1) as f64;
            }
            self.series.extend(torque);
            small = if self.size(scale, j + 1) * power < ROUNDING { small + 1 } else { 0 };
        }
    }

    /// Coefficient of the rate from those of momentum and rotors.
    fn rate_term(&self, j: usize) -> Vector3<f64> {
        let wheels = self.gyrostat.wheels().iter().zip(self.rotors.iter());
        let rest = wheels.fold(self.series.momentum[j], |rest, (wheel, it)| match it.rotor {
            Rotor::Turning { .. } => rest - wheel.axis_body * it.axial[j],
            Rotor::Held { momentum_n_m_s } if j == 0 => rest - wheel.axis_body * momentum_n_m_s,
            Rotor::Held { .. } => rest,
        });
        let rest = self.oscillators.iter().fold(rest, |rest, it| rest - it.carried_term(j));
        let rest = match &self.load.mass_flow {
            Some(flow) if j > 0 => rest - flow.inertia_rate_kg_m2_s * self.series.rate[j - 1],
            _ => rest,
        };
        let rest =
            self.load.internal.iter().fold(rest, |rest, it| rest - it.carried_term(&self.series.rate, j));
        self.inverse_inertia * rest
    }

    /// Greatest coefficient `j` of what swings, as a momentum: no coupling exceeds the root of the inertia.
    fn swing_n_m_s(&self, j: usize) -> f64 {
        if self.oscillators.is_empty() {
            return 0.0;
        }
        let most = self.oscillators.iter().map(|it| it.size(j)).fold(0.0, f64::max);
        most * self.gyrostat.inertia_body_kg_m2().trace().sqrt()
    }

    /// Greatest coefficient `j` relative to the whole.
    fn size(&self, scale_n_m_s: f64, j: usize) -> f64 {
        let turning = self.rotors.iter().filter(|it| matches!(it.rotor, Rotor::Turning { .. }));
        let momenta = turning.map(|it| &it.axial[j]).chain(&self.series.momentum[j]);
        let momentum = largest_magnitude(momenta).max(self.swing_n_m_s(j));
        let phase = self.imbalances.iter().map(|it| it.size(j)).fold(0.0, f64::max);
        largest_magnitude(&self.series.attitude[j])
            .max(momentum / scale_n_m_s)
            .max(phase * (ROUNDING / PHASE_ROUNDING))
    }

    /// Scale of momenta, in N m s, that terms are compared with.
    fn momentum_scale_n_m_s(&self) -> f64 {
        let rotors = self.rotors.iter().map(|it| it.axial[0].abs()).fold(0.0, f64::max);
        // Of a body at rest every change counts.
        self.series.momentum[0].amax().max(rotors).max(self.swing_n_m_s(0)).max(1e-6)
    }

    /// How long the series is exact to rounding, at most `longest_s`, in s.
    pub(super) fn converged_s(&self, longest_s: f64) -> f64 {
        if self.series.order < ORDER {
            return longest_s;
        }
        let scale_n_m_s = self.momentum_scale_n_m_s();
        exact_length_s(longest_s, [ORDER - 1, ORDER].map(|j| (j, self.size(scale_n_m_s, j))).into_iter())
    }
}
