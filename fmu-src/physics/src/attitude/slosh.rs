//! Propellant that swings in its tank, as a pendulum.
//!
//! Equations: a bob of mass m hangs by length L from a pivot and swings by u1, u2 along e1, e2 across its axis n, which points
//! from the pivot to the bob at rest. With M the mass of the whole, a = F/M the acceleration by forces other than gravity, r
//! the place of the bob at rest from the centre of mass and w0 the frequency that surface tension or a membrane gives without
//! acceleration, per direction e
//! m (1 - m/M) u'' + m (r x e).w' + 2 z sqrt(k) m u' + m k u = -m e.a, k = |a|/L + w0^2; torque on the body -m u (e x a).
//! It is linear in u: angles up to some tenths of a radian along an acceleration against n. The stiffness is that of the
//! acceleration where a segment of motion starts. Left out: the bob's stretch along n, fill levels and higher modes, the change
//! of the inertia with u, the effect on the centre of mass's own path (forces act on the whole).
//! Reference: Abramson (ed.), The Dynamic Behavior of Liquids in Moving Containers, NASA SP-106, ch. 6; Sidi, Spacecraft
//! Dynamics and Control, 10.3.

use core::f64::consts::TAU;

use nalgebra::Vector3;
use serde::Serialize;

use super::oscillator::Oscillator;

/// Propellant as a pendulum.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SloshPendulum {
    /// Mass that swings, part of the body's and at rest in its inertia, in kg.
    pub mass_kg: f64,
    /// Length, in m.
    pub length_m: f64,
    /// Pivot, body frame, in m.
    pub pivot_body_m: Vector3<f64>,
    /// Unit vector from the pivot to the bob at rest: against the acceleration.
    pub axis_body: Vector3<f64>,
    /// Frequency without acceleration, in Hz.
    pub coast_frequency_hz: f64,
    /// Damping ratio, the body held.
    pub damping: f64,
}

/// Two unit vectors across a unit vector, all three right-handed: the one after the other for the same vector.
pub(super) fn across(axis: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let least = axis.iamin();
    let mut along = Vector3::zeros();
    along[least] = 1.0;
    let first = axis.cross(&along).normalize();
    [first, axis.cross(&first)]
}

impl SloshPendulum {
    /// Angle of the pendulum by a displacement in sqrt(kg) m, in rad.
    pub fn angle_rad(&self, displacement_sqrt_kg_m: f64) -> f64 {
        displacement_sqrt_kg_m / (self.mass_kg.sqrt() * self.length_m)
    }

    /// Its two coordinates in a body of this mass about this centre, under this acceleration and its slope.
    pub(super) fn oscillators(
        &self,
        body_mass_kg: f64,
        center_of_mass_body_m: &Vector3<f64>,
        acceleration_body_m_s2: &[Vector3<f64>; 2],
    ) -> [Oscillator; 2] {
        let root = self.mass_kg.sqrt();
        let bob_from_center_m = self.pivot_body_m - center_of_mass_body_m + self.axis_body * self.length_m;
        let [start, slope] = acceleration_body_m_s2;
        let coast_rad_s = self.coast_frequency_hz * TAU;
        let stiffness_1_s2 = start.norm() / self.length_m + coast_rad_s * coast_rad_s;
        across(&self.axis_body).map(|direction| {
            let direction = direction * root;
            Oscillator {
                coupling_body_sqrt_kg_m: bob_from_center_m.cross(&direction),
                mass_share: 1.0 - self.mass_kg / body_mass_kg,
                stiffness_1_s2,
                damping_1_s: 2.0 * self.damping * stiffness_1_s2.sqrt(),
                drive_sqrt_kg_m_s2: [-direction.dot(start), -direction.dot(slope)],
                torque_body_sqrt_kg_m_s2: [start.cross(&direction), slope.cross(&direction)],
            }
        })
    }
}
