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
    /// What a face with this outward unit normal receives of the beam; nothing from behind.
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
    optics: &Optics,
    normal_body: &Vector3<T>,
    light: &ReceivedLight<T>,
) -> Vector3<T> {
    let along_light = light.vector_pa * T::constant(optics.absorptivity + optics.diffuse);
    let scattered = light.pressure_pa * (optics.diffuse / 3.0);
    let mirrored = normal_body.dot(&light.vector_pa) * optics.specular;
    -(along_light + *normal_body * ((scattered + mirrored) * 2.0))
}

#[cfg(test)]
mod tests {
    //! Plates solved by hand, from the momentum of the light that comes and goes.

    use approx::assert_relative_eq;
    use proptest::prelude::*;

    use super::*;
    use crate::numerics::scalar::Dual64;

    const BLACK: Optics = Optics::from_reflectivities(0.0, 0.0);
    const MIRROR: Optics = Optics::from_reflectivities(1.0, 0.0);
    const WHITE: Optics = Optics::from_reflectivities(0.0, 1.0);

    fn force(optics: &Optics, normal: [f64; 3], source: [f64; 3]) -> Vector3<f64> {
        let normal = Vector3::from(normal);
        let beam = Beam { source_body: Vector3::from(source).normalize(), pressure_pa: 2.0 };
        force_per_area_pa(optics, &normal, &beam.received(&normal))
    }

    #[test]
    fn square_light_pushes_a_black_plate_once_a_mirror_twice_a_white_plate_five_thirds() {
        let z = [0.0, 0.0, 1.0];
        assert_relative_eq!(force(&BLACK, z, z), Vector3::z() * -2.0);
        assert_relative_eq!(force(&MIRROR, z, z), Vector3::z() * -4.0);
        assert_relative_eq!(force(&WHITE, z, z), Vector3::z() * (-2.0 * 5.0 / 3.0));
    }

    #[test]
    fn a_mirror_is_pushed_against_its_normal_whatever_the_direction() {
        // At 45 deg: area seen cos 45, momentum change 2 cos 45 along the normal: P in all.
        assert_relative_eq!(
            force(&MIRROR, [0.0, 0.0, 1.0], [1.0, 0.0, 1.0]),
            Vector3::z() * -2.0,
            epsilon = 1e-15
        );
    }

    #[test]
    fn a_black_plate_is_pushed_along_the_light() {
        let cos = 0.5_f64.sqrt();
        let expected = -Vector3::new(1.0, 0.0, 1.0) * cos * cos * 2.0;
        assert_relative_eq!(force(&BLACK, [0.0, 0.0, 1.0], [1.0, 0.0, 1.0]), expected, epsilon = 1e-15);
    }

    #[test]
    fn light_from_behind_or_along_the_face_does_nothing() {
        assert_eq!(force(&WHITE, [0.0, 0.0, 1.0], [0.3, 0.0, -1.0]), Vector3::zeros());
        assert_eq!(force(&WHITE, [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]), Vector3::zeros());
    }

    /// Momentum of light scattered by Lambert's law, summed over the half-sphere ray by ray.
    #[test]
    fn scattered_light_carries_two_thirds_of_its_momentum_along_the_normal() {
        let n = 400_u32;
        let mut momentum = 0.0;
        let mut energy = 0.0;
        for i in 0..n {
            let cos = (f64::from(i) + 0.5) / f64::from(n);
            energy += cos;
            momentum += cos * cos;
        }
        let expected = -2.0 * (1.0 + momentum / energy);
        assert_relative_eq!(force(&WHITE, [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]).z, expected, max_relative = 1e-5);
    }

    proptest! {
        /// Momentum balance of the mirrored ray itself, reflected by geometry: in-going minus out-going.
        #[test]
        fn a_mirror_turns_the_light_about_its_normal(a in 0.01..1.5_f64, b in 0.0..6.2_f64) {
            let source = Vector3::new(a.sin() * b.cos(), a.sin() * b.sin(), a.cos());
            let incoming = -source;
            let outgoing = Vector3::new(incoming.x, incoming.y, -incoming.z);
            let expected = (incoming - outgoing) * 2.0 * source.z;
            let found = force(&MIRROR, [0.0, 0.0, 1.0], source.into());
            prop_assert!((found - expected).norm() < 1e-14);
        }

        /// Dual numbers give the slope of the plain law.
        #[test]
        fn the_derivative_is_the_slope(a in 0.05..1.4_f64, s in 0.0..1.0_f64) {
            fn z_force<T: Scalar>(angle: T, optics: &Optics) -> T {
                let normal = Vector3::new(T::constant(0.0), T::constant(0.6), T::constant(0.8));
                let source_body = Vector3::new(angle.sin(), T::constant(0.0), angle.cos());
                let beam = Beam { source_body, pressure_pa: T::constant(1.0) };
                force_per_area_pa(optics, &normal, &beam.received(&normal)).z
            }
            let optics = Optics::from_reflectivities(s, (1.0 - s) / 2.0);
            let h = 1e-5;
            let slope = (z_force(a + h, &optics) - z_force(a - h, &optics)) / (2.0 * h);
            let exact = z_force(Dual64::new(a, 1.0), &optics).eps;
            prop_assert!((slope - exact).abs() < 1e-9, "{slope} {exact}");
        }
    }
}
