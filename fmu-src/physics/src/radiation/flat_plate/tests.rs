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
        fn z_force<T: Scalar>(angle: T, optics: &Optics<T>) -> T {
            let normal = Vector3::new(T::constant(0.0), T::constant(0.6), T::constant(0.8));
            let source_body = Vector3::new(angle.sin(), T::constant(0.0), angle.cos());
            let beam = Beam { source_body, pressure_pa: T::constant(1.0) };
            force_per_area_pa(optics, &normal, &beam.received(&normal)).z
        }
        let optics = Optics::from_reflectivities(s, (1.0 - s) / 2.0);
        let h = 1e-5;
        let slope = (z_force(a + h, &optics) - z_force(a - h, &optics)) / (2.0 * h);
        let exact = z_force(Dual64::new(a, 1.0), &optics.map(Dual64::from_re)).eps;
        prop_assert!((slope - exact).abs() < 1e-9, "{slope} {exact}");
    }
}
