//! Against a search over the whole sphere, the incidence, and differences over time.
use super::super::moving::{fixed, rate, value as now};
use super::*;
use crate::attitude::angle_between_rad;
use crate::guidance::tests::orbit::TestOrbit;
use approx::assert_relative_eq;
use core::f64::consts::{FRAC_PI_2, PI};
use nalgebra::Vector3;

fn above(distance: f64, alpha_rad: f64) -> EphemerisAtTime {
    static SOME: std::sync::OnceLock<EphemerisAtTime> = std::sync::OnceLock::new();
    let mut ephemeris = *SOME.get_or_init(|| TestOrbit::new(12.0).ephemeris(0.0));
    ephemeris.planet.radii_m = Vector3::repeat(2.44e6);
    ephemeris.position = fixed(Vector3::new(0.6, -0.48, 0.64) * (2.44e6 * distance));
    let side = Vector3::new(0.8, 0.36, -0.48);
    let up = now(&ephemeris.position).normalize();
    ephemeris.sun = fixed((up * alpha_rad.cos() + side * alpha_rad.sin()) * 5e10);
    ephemeris
}

/// F of a point by its normal: cosines of incidence and emission by dot products, nothing hidden below the horizon.
fn lighting(ephemeris: &EphemerisAtTime, normal: &Vector3<f64>) -> f64 {
    let to_spacecraft = now(&ephemeris.position) - normal * ephemeris.planet.radii_m.x;
    let emission = normal.dot(&to_spacecraft.normalize());
    let incidence = normal.dot(&now(&ephemeris.sun).normalize());
    if emission < 0.0 || incidence < 0.0 { 0.0 } else { emission * incidence }
}

/// The best normal over the whole sphere: a grid in two angles, refined about its best point again and again.
fn search(ephemeris: &EphemerisAtTime) -> Vector3<f64> {
    let normal = |a: f64, b: f64| Vector3::new(a.cos() * b.cos(), a.sin() * b.cos(), b.sin());
    let (mut centre, mut half) = ((0.0, 0.0), (PI, FRAC_PI_2));
    for round in 0..40 {
        let count = if round == 0 { 200 } else { 12 };
        let mut best = (-1.0, centre);
        for i in -count..=count {
            for j in -count..=count {
                let part = |k: i32, half: f64| f64::from(k) / f64::from(count) * half;
                let at = (centre.0 + part(i, half.0), centre.1 + part(j, half.1));
                let lit = lighting(ephemeris, &normal(at.0, at.1));
                if lit > best.0 {
                    best = (lit, at);
                }
            }
        }
        centre = best.1;
        half = if round == 0 { (0.04, 0.04) } else { (half.0 * 0.6, half.1 * 0.6) };
    }
    normal(centre.0, centre.1)
}

#[test]
fn optimal_lighting_is_the_best_point_of_the_sphere() {
    for distance in [1.05, 1.5, 3.0, 7.0] {
        for alpha_rad in [0.05, 0.6, 1.2, 1.7] {
            let limb_rad: f64 = (1.0_f64 / distance).acos();
            if alpha_rad > FRAC_PI_2 + limb_rad - 0.1 {
                continue;
            }
            let ephemeris = above(distance, alpha_rad);
            let point = now(&optimal_lighting_m(&ephemeris).unwrap());
            assert_relative_eq!(point.norm(), 2.44e6, max_relative = 1e-14);
            let found = point / point.norm();
            let best = search(&ephemeris);
            assert!(lighting(&ephemeris, &found) >= lighting(&ephemeris, &best) - 1e-15);
            // A maximum is found from values to the root of the rounding.
            assert!(angle_between_rad(&found, &best) < 1e-6, "{distance} {alpha_rad}");
        }
    }
}

#[test]
fn the_point_lies_between_nadir_and_subsolar_on_the_seen_and_lit_arc() {
    for distance in [1.0001, 1.01, 1.2, 2.0, 6.0, 100.0] {
        for step in 0..=300 {
            let alpha_rad = PI * f64::from(step) / 300.0;
            let ephemeris = above(distance, alpha_rad);
            let point = optimal_lighting_m(&ephemeris).unwrap();
            assert!(rate(&point).iter().all(|x| x.is_finite()), "{distance} {alpha_rad}");
            let (point, up) = (now(&point), now(&ephemeris.position));
            let sun = now(&ephemeris.sun);
            let from_nadir_rad = angle_between_rad(&point, &up);
            let limb_rad = (1.0_f64 / distance).acos();
            assert!(from_nadir_rad <= limb_rad + 1e-9, "{distance} {alpha_rad}");
            let sum = from_nadir_rad + angle_between_rad(&point, &sun);
            if step < 300 {
                assert_relative_eq!(sum, alpha_rad, epsilon = 1e-7);
            }
            if alpha_rad > FRAC_PI_2 + limb_rad {
                let at_limb = step == 300 || (from_nadir_rad - limb_rad).abs() < 1e-9;
                assert!(at_limb, "dark: {distance} {alpha_rad}");
            }
        }
    }
}

#[test]
fn the_normal_at_the_subsolar_point_has_incidence_zero_and_the_line_meets_the_sun() {
    let ephemeris = TestOrbit::new(12.0).ephemeris(500.0);
    let to_planet = ephemeris.planet.planet_from_inertial(ephemeris.epoch_s).map(|x| x.re);
    let sun = to_planet * now(&ephemeris.sun);
    let at = |method| to_planet * now(&subsolar_m(&ephemeris, method).unwrap());
    let radii_m = ephemeris.planet.radii_m;
    let (line, normal) = (at(SubsolarMethod::Line), at(SubsolarMethod::Normal));
    for point in [line, normal] {
        assert_relative_eq!(point.component_div(&radii_m).norm(), 1.0, epsilon = 1e-14);
    }
    let gradient = normal.component_div(&radii_m).component_div(&radii_m);
    assert!(gradient.normalize().cross(&sun.normalize()).norm() < 1e-14);
    assert!(gradient.dot(&sun) > 0.0);
    assert!(line.normalize().cross(&sun.normalize()).norm() < 1e-14 && line.dot(&sun) > 0.0);
    assert!((line - normal).norm() > 1.0, "the ellipsoid is triaxial enough to tell them apart");
}

#[test]
fn the_points_move_at_the_rate_of_their_differences() {
    let orbit = TestOrbit::new(12.0);
    type Law = fn(&EphemerisAtTime) -> Option<MovingVector>;
    let laws: [Law; 3] = [
        optimal_lighting_m,
        |s| subsolar_m(s, SubsolarMethod::Line),
        |s| subsolar_m(s, SubsolarMethod::Normal),
    ];
    for law in laws {
        for time_s in orbit.times_s() {
            let at = |t: f64| now(&law(&orbit.ephemeris(time_s + t)).unwrap());
            let slope = (at(-1.0) - at(1.0) + (at(0.5) - at(-0.5)) * 8.0) / 6.0;
            let found = rate(&law(&orbit.ephemeris(time_s)).unwrap());
            // m/s; positions of 2.4e6 m round to 5e-10 m.
            assert_relative_eq!(found, slope, epsilon = 2e-8, max_relative = 1e-8);
        }
    }
}

#[test]
fn inside_the_planet_or_without_a_sun_there_is_no_point() {
    assert!(optimal_lighting_m(&above(0.9, 1.0)).is_none());
    assert!(optimal_lighting_m(&EphemerisAtTime { sun: MovingVector::zeros(), ..above(2.0, 1.0) }).is_none());
    let dark = EphemerisAtTime { sun: MovingVector::zeros(), ..above(2.0, 1.0) };
    assert!(subsolar_m(&dark, SubsolarMethod::Line).is_none());
}
