//! Unit quaternion of an attitude, scalar last, cheap to compose.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::math;

/// Attitude as a unit quaternion `[x, y, z, w]` from EME2000 to body (passive, the order of Wertz).
///
/// The same four numbers, read as Hamilton's quaternion, turn body components into inertial ones, so that
/// `a.after(b)` means: first turn the body by `b` about axes fixed in the body, seen from the frame of `a`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Quaternion(pub [f64; 4]);

impl Default for Quaternion {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl Quaternion {
    /// Body axes along the inertial axes.
    pub const IDENTITY: Self = Self([0.0, 0.0, 0.0, 1.0]);

    /// A turn of the body by `angle_rad` about the unit vector `axis`.
    pub fn turn(axis: &Vector3<f64>, angle_rad: f64) -> Self {
        let (sine, cosine) = math::sin_cos(0.5 * angle_rad);
        Self([axis.x * sine, axis.y * sine, axis.z * sine, cosine])
    }

    /// A turn of the body by the vector `angle_body_rad`.
    pub fn by_vector(angle_body_rad: &Vector3<f64>) -> Self {
        let angle_rad = angle_body_rad.norm();
        if angle_rad > 0.0 { Self::turn(&(angle_body_rad / angle_rad), angle_rad) } else { Self::IDENTITY }
    }

    /// Unit quaternion along `components`; `None` where they are not finite or their norm is off 1 by more than 1e-3.
    pub fn from_components(components: [f64; 4]) -> Option<Self> {
        let norm = components.iter().map(|c| c * c).sum::<f64>().sqrt();
        ((norm - 1.0).abs() <= 1e-3).then(|| Self(components.map(|c| c / norm)))
    }

    /// Hamilton's product `self * other`.
    #[inline]
    #[must_use]
    pub fn after(self, other: Self) -> Self {
        let [ax, ay, az, aw] = self.0;
        let [bx, by, bz, bw] = other.0;
        Self([
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by + ay * bw + az * bx - ax * bz,
            aw * bz + az * bw + ax * by - ay * bx,
            aw * bw - ax * bx - ay * by - az * bz,
        ])
    }

    /// The attitude in the middle of the shorter turn from this one to `other`.
    #[must_use]
    pub fn halfway(self, other: &Self) -> Self {
        let product: f64 = self.0.iter().zip(&other.0).map(|(a, b)| a * b).sum();
        let sign = 1.0_f64.copysign(product);
        Self(core::array::from_fn(|i| self.0[i] + sign * other.0[i])).normalized()
    }

    /// The same attitude with norm 1 to rounding.
    #[inline]
    #[must_use]
    pub fn normalized(self) -> Self {
        let scale = self.0.iter().map(|c| c * c).sum::<f64>().sqrt().recip();
        Self(self.0.map(|c| c * scale))
    }

    /// Inertial components of a vector given in body components.
    #[inline]
    pub fn inertial_from_body(self, v_body: &Vector3<f64>) -> Vector3<f64> {
        let [x, y, z, w] = self.0;
        let u = Vector3::new(x, y, z);
        let t = u.cross(v_body) * 2.0;
        v_body + t * w + u.cross(&t)
    }

    /// Body components of a vector given in inertial components.
    #[inline]
    pub fn body_from_inertial(self, v_inertial: &Vector3<f64>) -> Vector3<f64> {
        let [x, y, z, w] = self.0;
        Self([-x, -y, -z, w]).inertial_from_body(v_inertial)
    }

    /// The body's third axis (the spin axis) in inertial components.
    #[inline]
    pub fn spin_axis_inertial(self) -> Vector3<f64> {
        let [x, y, z, w] = self.0;
        Vector3::new(2.0 * (x * z + w * y), 2.0 * (y * z - w * x), w * w + z * z - x * x - y * y)
    }
}
