//! Where arcs, azimuths or horizons degenerate, light stays finite and its derivatives are slopes.

use core::f64::consts::PI;

use nalgebra::{Rotation3, Vector3};
use proptest::prelude::*;

use super::*;
use crate::bodies::surface::{MERCURY, PlanetSurface};
use crate::constants::SPEED_OF_LIGHT_M_S;
use crate::numerics::scalar::{Dual64, Scalar};

const FLUX_W_M2: f64 = 9126.0;

/// Directions with the given components along z, due east, north, between, and their opposites.
fn around(z: f64) -> Vec<Vector3<f64>> {
    let rho = ((1.0 - z) * (1.0 + z)).sqrt();
    let half = 0.5_f64.sqrt();
    let horizontal = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0), (half, half), (-half, half)];
    horizontal.iter().map(|(x, y)| Vector3::new(rho * x, rho * y, z)).collect()
}

/// Directions special to a planet `distance` radii away along z: overhead, opposite, terminator below, terminator or
/// plate touching the limb, and a few of no distinction.
fn special(distance: f64) -> Vec<Vector3<f64>> {
    let tangent = 1.0 / distance;
    let limb = ((1.0 - tangent) * (1.0 + tangent)).sqrt();
    let levels = [1.0, -1.0, 0.0, tangent, -tangent, limb, -limb, 0.31];
    let mut directions: Vec<Vector3<f64>> = levels.iter().flat_map(|z| around(*z)).collect();
    directions.push(Vector3::new(0.36, -0.48, 0.8));
    directions
}

/// Vector and pressure of albedo and infrared on a plate over those of full light, where one seed moves planet, Sun and
/// plate, in this order.
fn light<T: Scalar>(
    rule: &RingRule,
    geometry: &[Vector3<f64>; 3],
    by: &[Vector3<f64>; 3],
    seed: T,
) -> [T; 8] {
    let moved = |i: usize| geometry[i].map(T::constant) + by[i].map(|x| seed * x);
    let view = PlanetView::new(&moved(0), &moved(1), T::constant(1.0)).unwrap();
    let surface = PlanetSurface { radius_m: 1.0, ..MERCURY };
    let normal = moved(2);
    let exitance = surface.constant().exitance(T::constant(FLUX_W_M2));
    let light = rule.receive(&view, &exitance, &(normal / normal.dot(&normal).sqrt()));
    let unit = SPEED_OF_LIGHT_M_S / FLUX_W_M2;
    let (a, i) = (light.albedo, light.infrared);
    [
        a.vector_pa.x,
        a.vector_pa.y,
        a.vector_pa.z,
        a.pressure_pa,
        i.vector_pa.x,
        i.vector_pa.y,
        i.vector_pa.z,
        i.pressure_pa,
    ]
    .map(|x| x * unit)
}

/// Moves one component of one of the three.
fn along(component: usize) -> [Vector3<f64>; 3] {
    let mut by = [Vector3::zeros(); 3];
    by[component / 3][component % 3] = 1.0;
    by
}

/// At a kink any slope between those of its two sides will do; elsewhere the two are one.
#[test]
fn slopes_lie_between_those_of_both_sides() {
    let rule = RingRule::new(16).unwrap();
    let h = 1e-4;
    for (distance, closest) in [(1.2, 2e-6), (2_f64.sqrt(), 1e-6)] {
        for (sun, normal) in
            special(distance).iter().flat_map(|a| special(distance).into_iter().map(|b| (*a, b)))
        {
            let geometry = [Vector3::z() * distance, sun, normal];
            for by in (0..9).map(along) {
                let dual = light(&rule, &geometry, &by, Dual64::new(0.0, 1.0));
                let [m2, m, value, p, p2] =
                    [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| light(&rule, &geometry, &by, k * h));
                for i in 0..8 {
                    let right = (p[i] * 4.0 - p2[i] - value[i] * 3.0) / (2.0 * h);
                    let left = -(m[i] * 4.0 - m2[i] - value[i] * 3.0) / (2.0 * h);
                    let beyond = (dual[i].eps - 0.5 * (left + right)).abs() - 0.5 * (right - left).abs();
                    assert!(beyond < closest, "{sun} {normal} {by:?} {i}: {} of {left} {right}", dual[i].eps);
                    assert!((dual[i].re - value[i]).abs() < 1e-14);
                }
            }
        }
    }
}

/// Breaks that race must not turn the error of few nodes into a slope.
#[test]
fn six_nodes_give_the_slopes_that_many_nodes_give() {
    let (few, many) = (RingRule::new(6).unwrap(), RingRule::new(64).unwrap());
    let distance = 1.05;
    for size in [0.0, 1e-12, 1e-6] {
        let off = |v: Vector3<f64>, shift: f64| {
            v + Vector3::new(0.9, -0.5, 0.7).map(|x: f64| (x + shift).sin() * size)
        };
        for (sun, normal) in
            special(distance).iter().flat_map(|a| special(distance).into_iter().map(|b| (*a, b)))
        {
            let geometry = [off(Vector3::z() * distance, 0.0), off(sun, 2.0), off(normal, 5.0)];
            for by in [2, 5, 6].map(along) {
                let [few, many] =
                    [&few, &many].map(|rule| light(rule, &geometry, &by, Dual64::new(0.0, 1.0)));
                for i in 0..8 {
                    let error = (few[i].eps - many[i].eps).abs();
                    assert!(error < 3e-4, "{size} {sun} {normal} {by:?} {i}: {} {}", few[i].eps, many[i].eps);
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// Turned any way, so that rounding leaves the special place on either side.
    #[test]
    fn special_geometries_have_finite_light_and_slopes(
        distance in prop_oneof![Just(1.000_001), Just(2_f64.sqrt()), 1.001..8.0_f64],
        sun in 0..49_usize, normal in 0..49_usize, nodes in prop_oneof![Just(1_usize), Just(6), Just(16)],
        turn in prop_oneof![Just([0.0; 3]), prop::array::uniform3(-PI..PI)],
        by in prop::array::uniform9(-1.0..1.0_f64),
    ) {
        let rotation = Rotation3::from_euler_angles(turn[0], turn[1], turn[2]);
        let directions = special(distance);
        let geometry = [Vector3::z() * distance, directions[sun], directions[normal]].map(|v| rotation * v);
        let by = [0, 3, 6].map(|k| Vector3::new(by[k], by[k + 1], by[k + 2]));
        for x in light(&RingRule::new(nodes).unwrap(), &geometry, &by, Dual64::new(0.0, 1.0)) {
            prop_assert!(x.re.is_finite() && x.eps.is_finite(), "{x}");
        }
    }
}
