//! Modal coordinate coupled to the body's rotation: one flexible mode, or one direction in which propellant swings.
//!
//! Equations, with displacement e and momentum p: p = m e' + d.w; p' = g - k e - c e'; the body's momentum holds d e', so that
//! with H the total momentum H - sum of d p / m = (J - sum of d d^T / m) w. A load that acts on what moves aside turns the
//! body by the torque l e. These are hybrid coordinates: linear in e, without the terms of the body's rate squared.
//! Reference: Likins, Dynamics and Control of Flexible Space Vehicles, JPL TR 32-1329, 1970; Hughes, Spacecraft Attitude
//! Dynamics, 4.4 and 8.3.

use core::f64::consts::TAU;

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::series::{TERMS, polynomial};

/// One flexible mode, its displacement normalised to a mass of 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FlexibleMode {
    /// Frequency with the body held, in Hz.
    pub frequency_hz: f64,
    /// Damping ratio with the body held.
    pub damping: f64,
    /// Angular momentum of the body by unit speed of the mode, body frame, in sqrt(kg) m.
    pub coupling_body_sqrt_kg_m: Vector3<f64>,
}

impl FlexibleMode {
    pub(super) fn oscillator(&self) -> Oscillator {
        let frequency_rad_s = self.frequency_hz * TAU;
        Oscillator {
            coupling_body_sqrt_kg_m: self.coupling_body_sqrt_kg_m,
            mass_share: 1.0,
            stiffness_1_s2: frequency_rad_s * frequency_rad_s,
            damping_1_s: 2.0 * self.damping * frequency_rad_s,
            ..Oscillator::default()
        }
    }
}

/// Coefficients of a modal coordinate over a segment; displacement in sqrt(kg) m.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Oscillator {
    /// d, body frame.
    pub(super) coupling_body_sqrt_kg_m: Vector3<f64>,
    /// m: fraction of the mass that moves when the rest of the body gives way.
    pub(super) mass_share: f64,
    /// k.
    pub(super) stiffness_1_s2: f64,
    /// c.
    pub(super) damping_1_s: f64,
    /// g in sqrt(kg) m/s2 and its slope.
    pub(super) drive_sqrt_kg_m_s2: [f64; 2],
    /// l, body frame, in sqrt(kg) m/s2, and its slope.
    pub(super) torque_body_sqrt_kg_m_s2: [Vector3<f64>; 2],
}

impl Oscillator {
    /// Part of the body's inertia that moves with it, d d^T / m, in kg m2.
    pub(super) fn inertia_body_kg_m2(&self) -> Matrix3<f64> {
        let d = &self.coupling_body_sqrt_kg_m;
        d * (d / self.mass_share).transpose()
    }
}

/// One modal coordinate over a segment.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct OscillatorMotion {
    pub(super) oscillator: Oscillator,
    /// Series of e, in sqrt(kg) m.
    displacement: [f64; TERMS],
    /// Series of p, in sqrt(kg) m/s.
    momentum: [f64; TERMS],
}

impl OscillatorMotion {
    /// Neither displaced nor moving against the body, before the first segment.
    pub(super) fn at_rest() -> Self {
        let oscillator = Oscillator { mass_share: 1.0, ..Oscillator::default() };
        Self { oscillator, displacement: [0.0; TERMS], momentum: [0.0; TERMS] }
    }

    /// Displacement in sqrt(kg) m and speed in sqrt(kg) m/s, `elapsed_s` after the segment's start.
    pub(super) fn after(&self, order: usize, elapsed_s: f64, rate_body_rad_s: &Vector3<f64>) -> [f64; 2] {
        let momentum = polynomial(&self.momentum[..=order], elapsed_s);
        [polynomial(&self.displacement[..=order], elapsed_s), self.speed(momentum, rate_body_rad_s)]
    }

    /// Part of the body's momentum that the reduced inertia does not hold, d p / m, body frame, in N m s.
    pub(super) fn carried_after(&self, order: usize, elapsed_s: f64) -> Vector3<f64> {
        self.carried(polynomial(&self.momentum[..=order], elapsed_s))
    }

    /// Torque by the load on what moves aside, body frame, in N m.
    pub(super) fn torque_after(&self, order: usize, elapsed_s: f64) -> Vector3<f64> {
        let [start, slope] = self.oscillator.torque_body_sqrt_kg_m_s2;
        (start + slope * elapsed_s) * polynomial(&self.displacement[..=order], elapsed_s)
    }

    /// Begins a segment with displacement and speed, the body turning at this rate.
    pub(super) fn begin(
        &mut self,
        oscillator: Oscillator,
        [displacement, speed]: [f64; 2],
        rate: &Vector3<f64>,
    ) {
        self.oscillator = oscillator;
        self.displacement[0] = displacement;
        self.momentum[0] = oscillator.mass_share * speed + oscillator.coupling_body_sqrt_kg_m.dot(rate);
    }

    /// Holds the values of `elapsed_s` as the start of a segment.
    pub(super) fn hold(&mut self, order: usize, elapsed_s: f64) {
        self.displacement[0] = polynomial(&self.displacement[..=order], elapsed_s);
        self.momentum[0] = polynomial(&self.momentum[..=order], elapsed_s);
    }

    /// Coefficient `j` of what the body's momentum holds of it.
    pub(super) fn carried_term(&self, j: usize) -> Vector3<f64> {
        self.carried(self.momentum[j])
    }

    /// Coefficient `j` of the torque by the load on what moves aside.
    pub(super) fn torque_term(&self, j: usize) -> Vector3<f64> {
        let [start, slope] = self.oscillator.torque_body_sqrt_kg_m_s2;
        let from_slope = j.checked_sub(1).map_or(Vector3::zeros(), |i| slope * self.displacement[i]);
        start * self.displacement[j] + from_slope
    }

    /// Coefficients `j + 1` from those before and the rate's coefficient `j`.
    pub(super) fn extend(&mut self, j: usize, rate: &Vector3<f64>) {
        let Oscillator { stiffness_1_s2, damping_1_s, drive_sqrt_kg_m_s2, .. } = self.oscillator;
        let speed = self.speed(self.momentum[j], rate);
        let drive = drive_sqrt_kg_m_s2.get(j).copied().unwrap_or_default();
        let divisor = (j + 1) as f64;
        self.displacement[j + 1] = speed / divisor;
        self.momentum[j + 1] =
            (drive - stiffness_1_s2 * self.displacement[j] - damping_1_s * speed) / divisor;
    }

    /// Size of coefficient `j`, in sqrt(kg) m/s.
    pub(super) fn size(&self, j: usize) -> f64 {
        let displacement = self.displacement[j].abs() * self.oscillator.stiffness_1_s2.sqrt();
        displacement.max(self.momentum[j].abs())
    }

    pub(super) fn is_valid(&self) -> bool {
        self.oscillator.mass_share > 0.0 && self.oscillator.stiffness_1_s2 >= 0.0
    }

    fn speed(&self, momentum: f64, rate: &Vector3<f64>) -> f64 {
        (momentum - self.oscillator.coupling_body_sqrt_kg_m.dot(rate)) / self.oscillator.mass_share
    }

    fn carried(&self, momentum: f64) -> Vector3<f64> {
        self.oscillator.coupling_body_sqrt_kg_m * (momentum / self.oscillator.mass_share)
    }
}
