//! The Sun as a disc: directions over it whose weighted mean replaces the point, and means of what they light.
//!
//! Equation: lit area and its centre are means over the disc, each direction counting by the light it brings to the surface: its
//! weight in the disc, which is evenly bright, times its cosine; directions below the surface's horizon bring none.
//! Method: Radon's rule of seven points, one in the middle and six on a ring at the root of 2/3 of the radius.
//! Order: exact for what is a polynomial of degree 5 in the place on the disc. A straight shadow edge wholly on a surface is one
//! of degree 1, but for terms of the radius squared.
//! Error measure: of the light on a surface that is smaller than a penumbra's width, at most an eighth for each edge.
//! Reference: Stroud, Approximate calculation of multiple integrals, 1971, rule S2: 5-1.

use nalgebra::Vector3;

use crate::math;
use crate::numerics::scalar::{Scalar, constant_vector};

/// How many directions stand for the disc.
pub const DIRECTIONS: usize = 7;

/// Right-handed axes from which those across the disc are turned; the first is a direction no spacecraft's axis has.
const AXES: [[f64; 3]; 3] = [[0.48, -0.64, 0.6], [0.8, 0.6, 0.0], [-0.36, 0.48, 0.8]];

/// The Sun's disc as seen from the spacecraft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunDisc<T: Scalar> {
    center: Vector3<T>,
    across: [Vector3<T>; 2],
    sine: T,
}

impl<T: Scalar> SunDisc<T> {
    /// About the unit vector `center_body`; `sine` is that of the angular radius, from 0 to 1, beyond which it counts as 1.
    pub fn new(center_body: &Vector3<T>, sine: T) -> Self {
        let [axis, first, second] = AXES.map(|axis| constant_vector::<T>(&Vector3::from(axis)));
        let along = axis.dot(center_body) + 1.0;
        // The turn that takes `axis` to the centre; at its opposite any axes across will do.
        let turned = |v: Vector3<T>| {
            if along.value() > 0.0 { v - (axis + center_body) * (v.dot(center_body) / along) } else { v }
        };
        let sine = if sine.value() < 1.0 { sine } else { T::constant(1.0) };
        Self { center: *center_body, across: [turned(first), turned(second)], sine }
    }

    /// A direction by number, as a unit vector, and its weight; the first is the centre. Weights add up to 1.
    pub fn direction(&self, number: usize) -> (Vector3<T>, f64) {
        if number == 0 {
            return (self.center, 0.25);
        }
        let (sin, cos) = math::sin_cos((number - 1) as f64 * core::f64::consts::FRAC_PI_3);
        let radius = self.sine * (2.0_f64 / 3.0).sqrt();
        let [first, second] = self.across;
        let outward = first * T::constant(cos) + second * T::constant(sin);
        let rest = (-(radius * radius) + 1.0).sqrt();
        (self.center * rest + outward * radius, 0.125)
    }
}

/// Mean of what the directions light of one surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct LitMean<T: Scalar> {
    weight: T,
    area_m2: T,
    moment_m3: Vector3<T>,
    /// Whether any direction finds a shadow.
    touched: bool,
}

impl<T: Scalar> LitMean<T> {
    pub(super) fn new() -> Self {
        let zero = T::constant(0.0);
        Self { weight: zero, area_m2: zero, moment_m3: Vector3::repeat(zero), touched: false }
    }

    /// Adds a direction that lights so much about such a centre; `touched` where something shadows it.
    pub(super) fn add(&mut self, weight: T, (area_m2, center_m): (T, Vector3<T>), touched: bool) {
        self.weight += weight;
        self.area_m2 += area_m2 * weight;
        self.moment_m3 += center_m * (area_m2 * weight);
        self.touched |= touched;
    }

    /// Mean area and its centre; `center_m` where nothing is lit, and `None` where nothing shadows it.
    pub(super) fn found(&self, center_m: &Vector3<T>) -> Option<(T, Vector3<T>)> {
        if !self.touched || self.weight.value() <= 0.0 {
            return None;
        }
        if self.area_m2.value() <= 0.0 {
            return Some((T::constant(0.0), *center_m));
        }
        Some((self.area_m2 / self.weight, self.moment_m3 / self.area_m2))
    }
}
