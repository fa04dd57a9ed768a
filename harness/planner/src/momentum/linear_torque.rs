//! Force and torque of sunlight with their derivatives by the controls, and their means over a share of the alternate attitude.
//!
//! With a fraction a of the time in the alternate attitude the mean torque is (1 - a) T + a T'; T' = 2 s (s.T) - T about the Sun line s,
//! with a Sun direction of its own where a window gives it one. The derivative by the share is exact.

use nalgebra::{Matrix3, Vector3};

use super::controls::CONTROLS;

/// Force and torque in one attitude at a time, with their derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearLoad {
    /// Torque, in N m.
    pub torque: Vector3<f64>,
    /// Derivatives of the torque by offset, windmill, azimuth, elevation, in N m/rad.
    pub by_angle: [Vector3<f64>; 4],
    /// Force with it, EME2000, in N.
    pub force_n: Vector3<f64>,
    /// Derivatives of the force by the same angles, in N/rad.
    pub force_by_angle: [Vector3<f64>; 4],
    /// Torque by the centre of mass, body frame, in N.
    pub by_center: Matrix3<f64>,
}

/// Torque at a time, in N m, with its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearTorque {
    /// Load in the normal attitude.
    pub normal: LinearLoad,
    /// Load with the alternate attitude's Sun direction, before its half turn; `None` where it is the normal one.
    pub alternate: Option<LinearLoad>,
    /// Takes a vector to that turned by 180 deg about the Sun line.
    pub half_turn: Matrix3<f64>,
}

impl LinearTorque {
    /// Mean torque of a share of the alternate attitude, and its derivatives by the controls.
    pub fn mean(&self, alternate: f64) -> (Vector3<f64>, [Vector3<f64>; CONTROLS]) {
        self.mean_of(|load| (load.torque, load.by_angle), alternate)
    }

    /// Mean of torques of the normal and the alternate attitude, the latter given before its half turn, by its share, in N m.
    pub(super) fn mixed_n_m(
        &self,
        normal_n_m: Vector3<f64>,
        other_n_m: Vector3<f64>,
        alternate: f64,
    ) -> Vector3<f64> {
        normal_n_m * (1.0 - alternate) + self.half_turn * other_n_m * alternate
    }

    /// Mean force, EME2000, in N, and its derivatives by the controls.
    pub fn mean_force_n(&self, alternate: f64) -> (Vector3<f64>, [Vector3<f64>; CONTROLS]) {
        self.mean_of(|load| (load.force_n, load.force_by_angle), alternate)
    }

    /// Mean torque by the centre of mass, body frame, in N.
    pub fn mean_by_center(&self, alternate: f64) -> Matrix3<f64> {
        let turned = self.alternate.unwrap_or(self.normal);
        self.normal.by_center * (1.0 - alternate) + self.half_turn * turned.by_center * alternate
    }

    fn mean_of(
        &self,
        of: impl Fn(&LinearLoad) -> (Vector3<f64>, [Vector3<f64>; 4]),
        alternate: f64,
    ) -> (Vector3<f64>, [Vector3<f64>; CONTROLS]) {
        let (vector, by_angle) = of(&self.normal);
        let (other, other_by_angle) = of(self.alternate.as_ref().unwrap_or(&self.normal));
        let turned = self.half_turn * other;
        let own = by_angle.map(|it| it * (1.0 - alternate));
        let others = other_by_angle.map(|it| self.half_turn * it * alternate);
        let [offset, windmill, mut azimuth, mut elevation] = own;
        let [by_offset, by_windmill, mut own_azimuth, mut own_elevation] = others;
        if self.alternate.is_none() {
            (azimuth, elevation) = (azimuth + own_azimuth, elevation + own_elevation);
            (own_azimuth, own_elevation) = (Vector3::zeros(), Vector3::zeros());
        }
        let by_share = turned - vector;
        let [offset, windmill] = [offset + by_offset, windmill + by_windmill];
        let mean = vector * (1.0 - alternate) + turned * alternate;
        (mean, [offset, windmill, azimuth, elevation, by_share, own_azimuth, own_elevation])
    }
}
