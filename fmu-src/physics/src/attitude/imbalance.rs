//! Static imbalance of a rotor: the force of a mass off the axis, and its torque about the centre of mass.
//!
//! Equations: F = U W^2 (cos f e1 + sin f e2), f' = W, T = r x F, with U the static imbalance, W the rotor's speed relative to
//! the body, f its phase from e1 across the axis, r the rotor's place from the centre of mass. The force acts from outside: the
//! simplified model of the reference, whose imbalance takes nothing from the rotor and moves no centre of mass.
//! Method: W from the rotors' series; cos f and sin f are a pair whose series follow by Cauchy products.
//! Reference: Alcorn, Allard, Schaub, Fully Coupled Reaction Wheel Static and Dynamic Imbalance for Spacecraft Jitter
//! Modeling, J. Guidance, Control, and Dynamics 41 (6), 2018.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::series::{TERMS, polynomial, product};
use super::slosh::across;

use crate::math;

/// Static imbalance of one rotor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotorImbalance {
    /// Index of the wheel, from 0.
    pub wheel: usize,
    /// Mass times its distance from the axis, in kg m.
    pub static_imbalance_kg_m: f64,
    /// Place of the rotor, body frame, in m.
    pub position_body_m: Vector3<f64>,
}

/// The force of one rotor over a segment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct ImbalanceMotion {
    /// U e1, U e2, body frame, in kg m.
    across_body_kg_m: [Vector3<f64>; 2],
    from_center_body_m: Vector3<f64>,
    cosine: [f64; TERMS],
    sine: [f64; TERMS],
    /// In rad/s.
    speed: [f64; TERMS],
    squared: [f64; TERMS],
    /// W^2 cos f and W^2 sin f, in 1/s2.
    force: [[f64; TERMS]; 2],
}

impl ImbalanceMotion {
    /// At the phase 0, the rotor's axis a unit vector.
    pub(super) fn new(
        imbalance: &RotorImbalance,
        axis_body: &Vector3<f64>,
        center_of_mass_body_m: &Vector3<f64>,
    ) -> Self {
        let mut motion = Self {
            across_body_kg_m: across(axis_body).map(|it| it * imbalance.static_imbalance_kg_m),
            from_center_body_m: imbalance.position_body_m - center_of_mass_body_m,
            ..Self::default()
        };
        motion.cosine[0] = 1.0;
        motion
    }

    /// Begins a segment at the phase that the last one has after `elapsed_s`.
    pub(super) fn begin(
        &mut self,
        imbalance: &RotorImbalance,
        center_of_mass_body_m: &Vector3<f64>,
        order: usize,
        elapsed_s: f64,
    ) {
        [self.cosine[0], self.sine[0]] = self.phase_after(order, elapsed_s);
        self.from_center_body_m = imbalance.position_body_m - center_of_mass_body_m;
    }

    /// Coefficient `j` of the torque, and of cosine and sine the next, from the speed's coefficient `j` in rad/s.
    pub(super) fn extend(&mut self, j: usize, speed: f64) -> Vector3<f64> {
        self.speed[j] = speed;
        self.squared[j] = product(&self.speed, &self.speed, j);
        self.force[0][j] = product(&self.squared, &self.cosine, j);
        self.force[1][j] = product(&self.squared, &self.sine, j);
        let divisor = (j + 1) as f64;
        self.cosine[j + 1] = -product(&self.speed, &self.sine, j) / divisor;
        self.sine[j + 1] = product(&self.speed, &self.cosine, j) / divisor;
        self.torque_and_force(self.force.map(|terms| terms[j]))[0]
    }

    /// Greatest coefficient `j` of cosine and sine.
    pub(super) fn size(&self, j: usize) -> f64 {
        self.cosine[j].abs().max(self.sine[j].abs())
    }

    /// Torque about the centre of mass in N m and force in N, body frame, `elapsed_s` after the segment's start, as the series
    /// of the motion has them.
    pub(super) fn after(&self, order: usize, elapsed_s: f64) -> [Vector3<f64>; 2] {
        let shares = self.force.map(|terms| polynomial(&terms[..order], elapsed_s));
        self.torque_and_force(shares)
    }

    /// The same at the rotor's speed, in rad/s.
    pub(super) fn at_speed(&self, order: usize, elapsed_s: f64, speed_rad_s: f64) -> [Vector3<f64>; 2] {
        self.torque_and_force(self.phase_after(order, elapsed_s).map(|it| it * speed_rad_s * speed_rad_s))
    }

    pub(super) fn is_valid(&self) -> bool {
        (math::hypot(self.cosine[0], self.sine[0]) - 1.0).abs() < 1e-9
    }

    /// Cosine and sine.
    fn phase_after(&self, order: usize, elapsed_s: f64) -> [f64; 2] {
        let [cosine, sine] = [&self.cosine, &self.sine].map(|terms| polynomial(&terms[..=order], elapsed_s));
        let norm = math::hypot(cosine, sine);
        [cosine / norm, sine / norm]
    }

    fn torque_and_force(&self, [cosine, sine]: [f64; 2]) -> [Vector3<f64>; 2] {
        let force_body_n = self.across_body_kg_m[0] * cosine + self.across_body_kg_m[1] * sine;
        [self.from_center_body_m.cross(&force_body_n), force_body_n]
    }
}
