//! Optics of a surface: absorbed, mirrored and scattered fractions of light.

use serde::Serialize;

/// What a surface does with light; the three fractions sum to 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Optics {
    /// Absorbed fraction (alpha).
    pub absorptivity: f64,
    /// Mirrored fraction (gamma_S; paper 000's C_s).
    pub specular: f64,
    /// Fraction scattered by Lambert's law (gamma_D; paper 000's C_d).
    pub diffuse: f64,
}

impl Optics {
    /// Optics that absorb whatever they do not reflect.
    pub const fn from_reflectivities(specular: f64, diffuse: f64) -> Self {
        Self { absorptivity: 1.0 - specular - diffuse, specular, diffuse }
    }

    /// The same surface where it absorbs another fraction: what is reflected keeps its mix of mirror and scatter.
    pub fn with_absorptivity(&self, absorptivity: f64) -> Self {
        let reflected = self.specular + self.diffuse;
        let specular_share = if reflected > 0.0 { self.specular / reflected } else { 0.0 };
        let specular = (1.0 - absorptivity) * specular_share;
        Self { absorptivity, specular, diffuse: 1.0 - absorptivity - specular }
    }
}
