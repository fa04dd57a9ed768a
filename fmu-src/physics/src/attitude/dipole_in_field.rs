//! A magnetic dipole of a body, in a field that is known in inertial axes.
//!
//! Equations: T = m x b with the dipole m and the field b in the body; db/dt = c - w x b and dc/dt = -w x c, c the field's rate in inertial axes
//! seen from the body.
//! Method: dipole and field are linear in time over a segment of motion; all right-hand sides are products, so the coefficients follow
//! from one another by Cauchy products as those of the body's do ([`super::series`]).
//! Order: that of the body's series.
//! Reference: Wertz, Spacecraft Attitude Determination and Control, 17.2.3.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::quaternion::Quaternion;
use super::series::TERMS;

/// A dipole and the field about it over a segment of motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DipoleInField {
    /// Dipole at the start of the segment in A m2, and its rate in A m2/s, both in the body frame.
    pub dipole_body_a_m2: [Vector3<f64>; 2],
    /// Field at the start of the segment in T, and its rate in T/s, both EME2000.
    pub field_inertial_t: [Vector3<f64>; 2],
}

impl DipoleInField {
    /// The torque so long after the start, in this attitude, body frame, in N m.
    pub fn torque_n_m(&self, attitude: &Quaternion, elapsed_s: f64) -> Vector3<f64> {
        let [start, rate] = self.field_inertial_t;
        let field_body_t = attitude.body_from_inertial(&(start + rate * elapsed_s));
        let [dipole, slope] = self.dipole_body_a_m2;
        (dipole + slope * elapsed_s).cross(&field_body_t)
    }

    /// The torque at the start in this attitude and its slope at this rate in rad/s, body frame, in N m and N m/s.
    pub fn torque_with_slope_n_m(
        &self,
        attitude: &Quaternion,
        rate_body_rad_s: &Vector3<f64>,
    ) -> [Vector3<f64>; 2] {
        let [field, per_s] = self.field_inertial_t.map(|it| attitude.body_from_inertial(&it));
        let [dipole, slope] = self.dipole_body_a_m2;
        let turned = dipole.cross(&(per_s - rate_body_rad_s.cross(&field)));
        [dipole.cross(&field), turned + slope.cross(&field)]
    }
}

/// Series of the field and of its inertial rate, body frame, in T and T/s.
#[derive(Clone, Copy, Debug)]
pub(super) struct FieldSeries {
    field: [Vector3<f64>; TERMS],
    rate: [Vector3<f64>; TERMS],
}

impl FieldSeries {
    /// In the attitude at the start of the segment.
    pub(super) fn new(load: &DipoleInField, attitude: &Quaternion) -> Self {
        let mut series = Self { field: [Vector3::zeros(); TERMS], rate: [Vector3::zeros(); TERMS] };
        [series.field[0], series.rate[0]] = load.field_inertial_t.map(|it| attitude.body_from_inertial(&it));
        series
    }

    /// Coefficient `j` of the torque in N m, whose terms up to there are known; computes the next terms from those of the body's
    /// rate known so far.
    pub(super) fn extend(
        &mut self,
        [dipole, slope]: &[Vector3<f64>; 2],
        rates: &[Vector3<f64>],
        j: usize,
    ) -> Vector3<f64> {
        let mut torque = dipole.cross(&self.field[j]);
        if j > 0 && *slope != Vector3::zeros() {
            torque += slope.cross(&self.field[j - 1]);
        }
        if j + 1 < TERMS {
            let turned = |series: &[Vector3<f64>; TERMS]| -> Vector3<f64> {
                (0..=j).fold(Vector3::zeros(), |sum, i| sum + series[i].cross(&rates[j - i]))
            };
            let divisor = (j + 1) as f64;
            self.field[j + 1] = (self.rate[j] + turned(&self.field)) / divisor;
            self.rate[j + 1] = turned(&self.rate) / divisor;
        }
        torque
    }
}
