//! Optics of a surface: absorbed, mirrored and scattered fractions of light.

use serde::{Deserialize, Serialize};

use crate::numerics::scalar::Scalar;

/// Optical coefficients of a surface; the three fractions sum to 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Optics<T = f64> {
    /// Absorbed fraction (alpha).
    pub absorptivity: T,
    /// Mirrored fraction (gamma_S; paper 000's C_s).
    pub specular: T,
    /// Fraction scattered by Lambert's law (gamma_D; paper 000's C_d).
    pub diffuse: T,
}

impl Optics {
    /// Optics that absorb whatever they do not reflect.
    pub const fn from_reflectivities(specular: f64, diffuse: f64) -> Self {
        Self { absorptivity: 1.0 - specular - diffuse, specular, diffuse }
    }
}

impl<T: Scalar> Optics<T> {
    /// The same surface where it absorbs another fraction: what is reflected keeps its mix of mirror and scatter.
    pub fn with_absorptivity(&self, absorptivity: T) -> Self {
        let reflected = self.specular + self.diffuse;
        let specular_share =
            if reflected.value() > 0.0 { self.specular / reflected } else { T::constant(0.0) };
        let specular = (T::constant(1.0) - absorptivity) * specular_share;
        Self { absorptivity, specular, diffuse: T::constant(1.0) - absorptivity - specular }
    }
}

impl<T> Optics<T> {
    /// Applies `of` to every fraction.
    pub fn map<U>(self, of: impl Fn(T) -> U) -> Optics<U> {
        Optics { absorptivity: of(self.absorptivity), specular: of(self.specular), diffuse: of(self.diffuse) }
    }
}
