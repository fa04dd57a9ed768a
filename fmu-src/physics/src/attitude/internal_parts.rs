//! Rotors, modal coordinates and imbalances that move in a body, over one segment of its motion.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::body_load::BodyLoad;
use super::gyrostat::Gyrostat;
use super::imbalance::ImbalanceMotion;
use super::oscillator::OscillatorMotion;
use super::rotor_motion::RotorMotion;
use super::series::TERMS;
use super::wheel::Rotor;

/// Motion of the parts, as series of the same order as that of the body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct InternalParts {
    pub rotors: Vec<RotorMotion>,
    pub oscillators: Vec<OscillatorMotion>,
    pub imbalances: Vec<ImbalanceMotion>,
}

impl InternalParts {
    /// Returns the parts of a body that turns at this rate, the rotors holding these momenta relative to it.
    pub(super) fn new(
        gyrostat: &Gyrostat,
        rate_body_rad_s: &Vector3<f64>,
        rotors_n_m_s: impl Fn(usize) -> f64,
    ) -> Self {
        let rotors = gyrostat.wheels().iter().enumerate().map(|(k, wheel)| {
            let held_n_m_s = rotors_n_m_s(k);
            let mut axial = [0.0; TERMS];
            axial[0] = held_n_m_s + wheel.carried_n_m_s(rate_body_rad_s);
            RotorMotion { rotor: Rotor::at_start(wheel, held_n_m_s), next: None, axial, known: None }
        });
        let imbalances = gyrostat.appendages().imbalances.iter().filter_map(|imbalance| {
            let wheel = gyrostat.wheels().get(imbalance.wheel)?;
            Some(ImbalanceMotion::new(imbalance, &wheel.axis_body, gyrostat.center_of_mass_body_m()))
        });
        Self {
            rotors: rotors.collect(),
            oscillators: vec![OscillatorMotion::at_rest(); gyrostat.oscillator_count()],
            imbalances: imbalances.collect(),
        }
    }

    /// Rejects decoded states that no simulation with these numbers of wheels and modal coordinates can produce.
    pub(super) fn is_valid(&self, wheels: usize, oscillators: usize) -> bool {
        self.rotors.len() == wheels
            && self.oscillators.len() == oscillators
            && self.imbalances.len() <= wheels
            && self.oscillators.iter().all(OscillatorMotion::is_valid)
            && self.imbalances.iter().all(ImbalanceMotion::is_valid)
            && self.rotors.iter().all(RotorMotion::is_valid)
    }

    /// Inverse inertia that gives the change of rate by an internal momentum, 1/(kg m2): rotors that turn and modal coordinates keep
    /// their own.
    pub(super) fn inverse_inertia(&self, gyrostat: &Gyrostat) -> Matrix3<f64> {
        let swinging = self.oscillators.iter().map(OscillatorMotion::inertia_body_kg_m2);
        gyrostat.inverse_inertia(self.rotors.iter().map(|it| &it.rotor), swinging)
    }

    /// Keeps the momenta along their axes `elapsed_s` after the start, where the body is set to another attitude.
    pub(super) fn reorient(&mut self, gyrostat: &Gyrostat, order: usize, elapsed_s: f64) {
        for it in &mut self.rotors {
            it.axial[0] = it.axial_after(order, elapsed_s);
        }
        for it in &mut self.oscillators {
            it.hold(order, elapsed_s);
        }
        self.begin_imbalances(gyrostat, order, elapsed_s);
    }

    /// Begins the next segment `elapsed_s` after the start of the present one, at this rate of the body.
    pub(super) fn begin(
        &mut self,
        gyrostat: &Gyrostat,
        load: &BodyLoad,
        order: usize,
        (elapsed_s, rate_body_rad_s): (f64, &Vector3<f64>),
    ) {
        self.begin_imbalances(gyrostat, order, elapsed_s);
        if self.oscillators.is_empty() {
            return;
        }
        let acceleration = load.acceleration_body_m_s2();
        let oscillators = gyrostat.oscillators(load.mass_kg, &acceleration);
        for (it, oscillator) in self.oscillators.iter_mut().zip(oscillators) {
            let state = it.after(order, elapsed_s, rate_body_rad_s);
            it.begin(oscillator, state, rate_body_rad_s);
        }
    }

    fn begin_imbalances(&mut self, gyrostat: &Gyrostat, order: usize, elapsed_s: f64) {
        for (it, imbalance) in self.imbalances.iter_mut().zip(&gyrostat.appendages().imbalances) {
            it.begin(imbalance, gyrostat.center_of_mass_body_m(), order, elapsed_s);
        }
    }

    /// Remainder of the body's momentum, body frame, N m s, `elapsed_s` after the start without that of rotors and modal coordinates.
    pub(super) fn rest_after(
        &self,
        gyrostat: &Gyrostat,
        momentum_body: Vector3<f64>,
        order: usize,
        elapsed_s: f64,
    ) -> Vector3<f64> {
        let rest = momentum_body
            - gyrostat.along_axes(|k| match self.rotors[k].rotor {
                Rotor::Turning { .. } => self.rotors[k].axial_after(order, elapsed_s),
                Rotor::Held { momentum_n_m_s } => momentum_n_m_s,
            });
        let swinging = self.oscillators.iter().map(|it| it.carried_after(order, elapsed_s));
        swinging.fold(rest, |rest, carried| rest - carried)
    }

    /// Torque and force by rotors out of balance, body frame.
    pub(super) fn imbalance_after(&self, order: usize, elapsed_s: f64) -> [Vector3<f64>; 2] {
        let loads = self.imbalances.iter().map(|it| it.after(order, elapsed_s));
        loads.fold([Vector3::zeros(); 2], |[torque, force], [own, push]| [torque + own, force + push])
    }

    /// Torque by modal coordinates that swing under the load, body frame.
    pub(super) fn swing_torque_after(&self, order: usize, elapsed_s: f64) -> Vector3<f64> {
        self.oscillators.iter().map(|it| it.torque_after(order, elapsed_s)).sum()
    }
}
