//! The flat-plate law: force per area of light on a surface that absorbs, mirrors and scatters.

use nalgebra::Vector3;

use crate::numerics::scalar::Scalar;
use crate::spacecraft::Optics;

/// Parallel light that arrives: sunlight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam<T: Scalar> {
    /// Unit vector toward the source.
    pub source_body: Vector3<T>,
    /// Radiation pressure on a black surface square to the beam (irradiance / speed of light), in Pa.
    pub pressure_pa: T,
}

impl<T: Scalar> Beam<T> {
    /// Returns the light that a face with this outward unit normal receives from the beam; none from behind.
    pub fn received(&self, normal_body: &Vector3<T>) -> ReceivedLight<T> {
        let cos = normal_body.dot(&self.source_body);
        if cos.value() <= 0.0 {
            return ReceivedLight::dark();
        }
        let pressure_pa = self.pressure_pa * cos;
        ReceivedLight { pressure_pa, vector_pa: self.source_body * pressure_pa }
    }
}

/// Light from any directions as one face receives it: two integrals of the radiance L over the directions s in front
/// of the face, divided by the speed of light c.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReceivedLight<T: Scalar> {
    /// (1/c) int L (n.s) dOmega: received irradiance over c, in Pa.
    pub pressure_pa: T,
    /// (1/c) int L (n.s) s dOmega: the same, weighed with the direction it comes from, in Pa.
    pub vector_pa: Vector3<T>,
}

impl<T: Scalar> ReceivedLight<T> {
    /// No light.
    pub fn dark() -> Self {
        Self { pressure_pa: T::constant(0.0), vector_pa: Vector3::zeros() }
    }
}

/// Force per area on a face (paper 000, eq 1; paper 004, eqs 23, 36, 41 with their signs and brackets corrected), in Pa:
///
/// F/A = - { (alpha + gD) I + 2 [ gD/3 E + gS (n.I) ] n }, with E and I the two members of [`ReceivedLight`].
///
/// For parallel light that is -P cos { (alpha + gD) s + 2 [ gD/3 + gS cos ] n }. Absorbed light is stopped, mirrored
/// light turned about the normal, scattered light stopped and sent out by Lambert's law, whose mean momentum is 2/3
/// along the normal. Light absorbed is *not* re-emitted here: that is thermal recoil.
pub fn force_per_area_pa<T: Scalar>(
    optics: &Optics<T>,
    normal_body: &Vector3<T>,
    light: &ReceivedLight<T>,
) -> Vector3<T> {
    let along_light = light.vector_pa * (optics.absorptivity + optics.diffuse);
    let scattered = light.pressure_pa * (optics.diffuse / 3.0);
    let mirrored = normal_body.dot(&light.vector_pa) * optics.specular;
    -(along_light + *normal_body * ((scattered + mirrored) * 2.0))
}

#[cfg(test)]
mod tests;
