//! Sums over the rings: moments of the planet's radiance over directions.
//!
//! Equation: sums over the rings of weight times the integrals of L s and L s s^T over the common arcs, from which both
//! members of [`crate::radiation::flat_plate::ReceivedLight`] follow by a product with the plate's normal.
//! Error measure and reference: see [`super`].

use core::f64::consts::PI;

use nalgebra::Vector3;

use super::arcs::{EvenMoments, Moments};
use crate::constants::SPEED_OF_LIGHT_M_S;
use crate::numerics::scalar::Scalar;
use crate::radiation::flat_plate::ReceivedLight;

/// First and second moments of a radiance over directions s in the local frame.
#[derive(Clone, Copy)]
pub(super) struct Tensors<T: Scalar> {
    /// Integral of s.
    first: Vector3<T>,
    /// Integrals of s s^T: xx, xy, yy, xz, yz, zz.
    second: [T; 6],
}
impl<T: Scalar> Tensors<T> {
    pub(super) fn zero() -> Self {
        let zero = T::constant(0.0);
        Self { first: Vector3::repeat(zero), second: [zero; 6] }
    }

    /// Adds a ring's azimuth integrals.
    #[inline]
    pub(super) fn add(&mut self, sin_eta: T, cos_eta: T, w: &Weighted<T>) {
        let Weighted([one, c, s, cc, cs, ss]) = *w;
        let (c, s, one) = (sin_eta * c, sin_eta * s, cos_eta * one);
        let sin_squared = sin_eta * sin_eta;
        self.first.x += c;
        self.first.y += s;
        self.first.z += one;
        self.second[0] += sin_squared * cc;
        self.second[1] += sin_squared * cs;
        self.second[2] += sin_squared * ss;
        self.second[3] += cos_eta * c;
        self.second[4] += cos_eta * s;
        self.second[5] += cos_eta * one;
    }

    /// Returns the light that a plate of this normal receives, all in one frame: E = n.V / pi, I = M n / pi, over the speed of light.
    pub(super) fn on(&self, n: &Vector3<T>) -> ReceivedLight<T> {
        const PER_LAMBERT_S_M: f64 = 1.0 / (PI * SPEED_OF_LIGHT_M_S);
        let [xx, xy, yy, xz, yz, zz] = self.second;
        let moment = Vector3::new(
            xx * n.x + xy * n.y + xz * n.z,
            xy * n.x + yy * n.y + yz * n.z,
            xz * n.x + yz * n.y + zz * n.z,
        );
        ReceivedLight {
            pressure_pa: self.first.dot(n) * PER_LAMBERT_S_M,
            vector_pa: moment * T::constant(PER_LAMBERT_S_M),
        }
    }
}

/// Azimuth integrals of 1, cos, sin, cos2, cos sin, sin2 under one weight.
pub(super) struct Weighted<T>([T; 6]);

impl<T: Scalar> Weighted<T> {
    /// Weight 1.
    #[inline]
    pub(super) fn flat(m: &Moments<T>) -> Self {
        Self([m.angle, m.c1, m.s1, m.c2, m.c1s1, m.s2])
    }

    /// Weight 1 over an arc about azimuth 0.
    #[inline]
    pub(super) fn flat_even(m: &EvenMoments<T>) -> Self {
        let zero = T::constant(0.0);
        Self([m.angle, m.c1, zero, m.c2, zero, m.s2])
    }

    /// Weight `level + x cos + y sin` over an arc about azimuth 0.
    #[inline]
    pub(super) fn slanted_even(m: &EvenMoments<T>, (level, x, y): (T, T, T)) -> Self {
        Self([
            level * m.angle + x * m.c1,
            level * m.c1 + x * m.c2,
            y * m.s2,
            level * m.c2 + x * m.c3,
            y * m.c1s2,
            level * m.s2 + x * m.c1s2,
        ])
    }

    /// Weight `level + x cos + y sin`.
    #[inline]
    pub(super) fn slanted(m: &Moments<T>, (level, x, y): (T, T, T)) -> Self {
        Self([
            level * m.angle + x * m.c1 + y * m.s1,
            level * m.c1 + x * m.c2 + y * m.c1s1,
            level * m.s1 + x * m.c1s1 + y * m.s2,
            level * m.c2 + x * m.c3 + y * m.c2s1,
            level * m.c1s1 + x * m.c2s1 + y * m.c1s2,
            level * m.s2 + x * m.c1s2 + y * m.s3,
        ])
    }

    /// Times a factor.
    #[inline]
    pub(super) fn scaled(&self, by: T) -> Self {
        Self(self.0.map(|it| by * it))
    }

    /// Plus another times a factor.
    #[inline]
    pub(super) fn plus(self, factor: T, other: &Self) -> Self {
        Self(core::array::from_fn(|i| self.0[i] + factor * other.0[i]))
    }
}
