//! A dumb-bell is pulled into line with the planet by the difference of the two pulls on its ends.

use super::*;
use crate::environment::orbit::{Flattening, Gravity};
use crate::numerics::scalar::Dual64;

const GM: f64 = 2.2e13;

fn pulls(half_m: &Vector3<f64>, mass_kg: f64, planet_m: &Vector3<f64>) -> Vector3<f64> {
    [half_m, &-half_m]
        .iter()
        .map(|end| {
            let away = planet_m - *end;
            end.cross(&(away * (GM * mass_kg / away.norm().powi(3))))
        })
        .sum()
}

#[test]
fn the_torque_on_a_dumb_bell_is_that_of_its_ends() {
    let (half_m, mass_kg) = (Vector3::new(30.0, -10.0, 20.0), 50.0);
    let planet_m = Vector3::new(1.0e6, 2.0e6, -1.5e6);
    let inertia =
        (Matrix3::identity() * half_m.norm_squared() - half_m * half_m.transpose()) * (2.0 * mass_kg);
    let found = gravity_gradient_n_m(GM, &inertia, &planet_m);
    let expected = pulls(&half_m, mass_kg, &planet_m);
    // The next term of the expansion is smaller by (size / distance)^2.
    assert!((found - expected).norm() < 1e-8 * found.norm(), "{found} {expected}");
}

#[test]
fn the_derivative_is_the_slope() {
    let inertia = Matrix3::new(200.0, 5.0, -3.0, 5.0, 450.0, 8.0, -3.0, 8.0, 430.0);
    let at = |x: f64| gravity_gradient_n_m(GM, &inertia, &Vector3::new(1e6 + x, 2e6, -1.5e6));
    let seeded = Vector3::new(Dual64::new(1e6, 1.0), Dual64::new(2e6, 0.0), Dual64::new(-1.5e6, 0.0));
    let exact =
        gravity_gradient_n_m(Dual64::constant(GM), &inertia.map(Dual64::constant), &seeded).map(|t| t.eps);
    let slope = (at(10.0) - at(-10.0)) / 20.0;
    assert!((slope - exact).norm() < 1e-8 * exact.norm());
}

/// Six point masses about their common centre, in kg and m, with their inertia.
fn cluster() -> (Vec<(f64, Vector3<f64>)>, Matrix3<f64>) {
    let arms = [[9.0, -4.0, 2.0], [-3.0, 7.0, 5.0], [1.0, 2.0, -8.0]].map(|arm| Vector3::from(arm) * 10.0);
    let masses: Vec<_> = arms.iter().flat_map(|arm| [(40.0, *arm), (40.0, -arm)]).collect();
    let about =
        |(m, p): &(f64, Vector3<f64>)| (Matrix3::identity() * p.norm_squared() - p * p.transpose()) * *m;
    let inertia = masses.iter().map(about).sum();
    (masses, inertia)
}

#[test]
fn the_torque_of_an_oblate_planet_is_that_of_point_masses() {
    let (masses, inertia) = cluster();
    let pole = Vector3::new(0.36, -0.48, 0.8);
    // The Earth, then one so flat that the second harmonic counts as much as the first.
    for j2 in [1.08263e-3, 0.3] {
        let flattening = Flattening { j2, reference_radius_m: 6.378_137e6, pole };
        let planet = OblatePlanet {
            gm_m3_s2: 3.986e14,
            j2,
            j2_radius_m: flattening.reference_radius_m,
            pole_body: pole * 3.0,
        };
        let gravity = Gravity { flattening: Some(flattening), ..Gravity::point_mass(planet.gm_m3_s2) };
        for position in [[6.9e6, 1e5, -2e5], [-1e6, 4e6, 5.5e6], [2.5e6, -3.4e6, 5.6e6]] {
            let position_m = Vector3::from(position);
            let pull = |(mass_kg, arm_m): &(f64, Vector3<f64>)| {
                let place_m = position_m + arm_m;
                arm_m.cross(&(gravity.acceleration_m_s2(&place_m) * *mass_kg))
            };
            let expected: Vector3<f64> = masses.iter().map(pull).sum();
            let found = oblate_gravity_gradient_n_m(&planet, &inertia, &-position_m);
            assert!((found - expected).norm() < 1e-8 * expected.norm(), "{j2}: {found} {expected}");
        }
    }
}

#[test]
fn derivatives_of_the_oblate_torque_are_its_slopes() {
    let (_, inertia) = cluster();
    let torque = |seed: usize, x: Dual64| {
        let mut numbers =
            [3.986e14, 0.1, 6.378e6, 0.36, -0.48, 0.8, 2.5e6, -3.4e6, 5.6e6].map(Dual64::constant);
        numbers[seed] *= x;
        let [gm_m3_s2, j2, j2_radius_m, a, b, c, to_planet @ ..] = numbers;
        let planet = OblatePlanet { gm_m3_s2, j2, j2_radius_m, pole_body: Vector3::new(a, b, c) };
        oblate_gravity_gradient_n_m(&planet, &inertia.map(Dual64::constant), &Vector3::from(to_planet))
    };
    for seed in 0..9 {
        let exact = torque(seed, Dual64::new(1.0, 1.0)).map(|t| t.eps);
        let at = |x: f64| torque(seed, Dual64::constant(x)).map(Dual64::value);
        let slope = (at(1.0 + 1e-5) - at(1.0 - 1e-5)) / 2e-5;
        assert!((slope - exact).norm() < 1e-8 * exact.norm(), "{seed}: {slope} {exact}");
    }
}
