//! Light from the planet, by kind, as one face receives it.
//!
//! Two methods give it: [`super::ring`], fast and exact, and [`super::grid`], the paper's, for comparison and for
//! surfaces that differ from place to place. Planet light is never shadowed by other parts of the spacecraft.

use super::flat_plate::ReceivedLight;
use crate::numerics::scalar::Scalar;

/// Light from the planet on one face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanetLight<T: Scalar> {
    /// Sunlight the planet reflects.
    pub albedo: ReceivedLight<T>,
    /// The planet's own radiation.
    pub infrared: ReceivedLight<T>,
}

impl<T: Scalar> PlanetLight<T> {
    /// No light.
    pub fn dark() -> Self {
        Self { albedo: ReceivedLight::dark(), infrared: ReceivedLight::dark() }
    }
}
