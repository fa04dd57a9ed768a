//! The lit fraction is the area of the Sun's disc that no line of sight finds covered.

use core::f64::consts::PI;

use nalgebra::Vector3;
use proptest::prelude::*;

use super::*;
use crate::{
    constants::{ASTRONOMICAL_UNIT_M, RADIUS_MERCURY_M, RADIUS_SUN_M},
    numerics::{quadrature::Rule, roots::bracketed, scalar::Dual64},
};

/// Integrates over the Sun's disc ring by ring: of a ring at angle x from the Sun's centre the planet covers the arc
/// whose points are nearer to the planet's centre than its radius; the arc's end by bisection.
fn by_rings(discs: &Discs) -> f64 {
    let (a, b, c) = (discs.sun_radius_rad, discs.planet_radius_rad, discs.separation_rad);
    let lit_arc = |x: f64| {
        // Distance from the planet's centre to the ring's point at azimuth p (haversine).
        let distance = |p: f64| {
            let h = (0.5 * (c - x)).sin().powi(2) + c.sin() * x.sin() * (0.5 * p).sin().powi(2);
            2.0 * h.sqrt().min(1.0).asin()
        };
        if distance(0.0) >= b {
            return 1.0;
        }
        if distance(PI) <= b {
            return 0.0;
        }
        let (mut low, mut high) = (0.0, PI);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if distance(middle) < b { low = middle } else { high = middle }
        }
        1.0 - low / PI
    };
    // Rings where the arc is born or closes have square-root ends: substitute x = m - (m - l) cos on each piece.
    let mut edges = [0.0, (b - c).abs().min(a), (c - b).abs().min(a), (b + c).min(a), a];
    edges.sort_by(f64::total_cmp);
    let rule = Rule::<48>::gauss_legendre();
    let mut lit = 0.0;
    for edge in edges.windows(2).filter(|w| w[1] > w[0]) {
        let (middle, half) = (0.5 * (edge[0] + edge[1]), 0.5 * (edge[1] - edge[0]));
        lit += rule.integrate(0.0, PI, |p| {
            let x = middle - half * p.cos();
            lit_arc(x) * x.sin() * half * p.sin()
        });
    }
    lit / (2.0 * (0.5 * a).sin().powi(2))
}

fn lit_fraction<T: Scalar>(
    shadow: &Shadow,
    spacecraft_m: &Vector3<T>,
    sun_m: &Vector3<T>,
) -> Result<T, EclipseError> {
    shadow.lit_fraction_of([RADIUS_MERCURY_M, RADIUS_SUN_M].map(T::constant), spacecraft_m, sun_m)
}

fn discs(sun: f64, planet: f64, separation: f64) -> Discs {
    Discs {
        sun_radius_rad: sun,
        planet_radius_rad: planet,
        separation_rad: separation,
        planet_in_front: true,
    }
}

#[test]
fn hand_solved_discs() {
    assert_eq!(discs(0.01, 0.5, 0.52).lit_fraction(), 1.0);
    assert_eq!(discs(0.01, 0.5, 0.48).lit_fraction(), 0.0);
    // Annular: a planet of half the Sun's size covers a quarter (flat sky, 1e-5 off on the sphere).
    assert!((discs(0.01, 0.005, 0.001).lit_fraction() - 0.75).abs() < 1e-4);
    // Two equal discs, each centre on the other's rim, flat sky: 1 - (2/3 - sqrt 3 / (2 pi)).
    let vesica = 1.0 - (2.0 / 3.0 - 3.0_f64.sqrt() / (2.0 * PI));
    assert!((discs(1e-4, 1e-4, 1e-4).lit_fraction() - vesica).abs() < 1e-8);
    // A planet that fills half the sky cuts the Sun along a great circle: half through the centre.
    assert!((discs(0.01, 0.5 * PI, 0.5 * PI).lit_fraction() - 0.5).abs() < 1e-13);
    // Behind the Sun nothing is covered.
    let behind = Discs { planet_in_front: false, ..discs(0.01, 0.002, 0.0) };
    assert_eq!(behind.lit_fraction(), 1.0);
}

#[test]
fn known_geometry_at_mercury() {
    // Behind Mercury on the axis, at 0.3075 AU: the umbra ends R S / (Rs - R) behind the centre (paper 004 eq 24).
    let shadow = Shadow::new(ShadowModel::DiscOverlap, RADIUS_MERCURY_M).unwrap();
    let sun = Vector3::new(0.3075 * ASTRONOMICAL_UNIT_M, 0.0, 0.0);
    let tip_m = RADIUS_MERCURY_M * sun.x / (RADIUS_SUN_M - RADIUS_MERCURY_M);
    let behind = |d: f64| lit_fraction(&shadow, &Vector3::new(-d, 0.0, 0.0), &sun).unwrap();
    assert_eq!(behind(0.999_999 * tip_m), 0.0);
    let ring = behind(1.000_001 * tip_m);
    assert!(ring > 0.0 && ring < 1e-5, "{ring}");
    assert_eq!(lit_fraction(&shadow, &Vector3::new(3e6, 0.0, 0.0), &sun).unwrap(), 1.0);
}

#[test]
fn all_or_nothing_models() {
    let sun = Vector3::new(6e10, 0.0, 0.0);
    let cone = Shadow::new(ShadowModel::AllOrNothingCone, RADIUS_MERCURY_M).unwrap();
    let cylinder = Shadow::new(ShadowModel::AllOrNothingCylinder, RADIUS_MERCURY_M).unwrap();
    let at = |shadow: &Shadow, x: f64, y: f64| lit_fraction(shadow, &Vector3::new(x, y, 0.0), &sun).unwrap();
    // The cylinder's edge is the planet's radius, whatever the distance behind.
    for x in [-3e6, -3e7, -3e9] {
        assert_eq!(at(&cylinder, x, 0.999_999 * RADIUS_MERCURY_M), 0.0);
        assert_eq!(at(&cylinder, x, 1.000_001 * RADIUS_MERCURY_M), 1.0);
        assert_eq!(at(&cylinder, -x, 0.0), 1.0);
    }
    // The cone's edge is where the discs touch: a line tangent to both spheres on crossed sides.
    let widening = (RADIUS_SUN_M + RADIUS_MERCURY_M) / 6e10;
    let edge = |x: f64| (RADIUS_MERCURY_M - x * widening) / (1.0 - widening * widening).sqrt();
    for x in [-3e6, -3e7] {
        let y = edge(x);
        assert_eq!(at(&cone, x, y * (1.0 - 1e-9)), 0.0);
        assert_eq!(at(&cone, x, y * (1.0 + 1e-9)), 1.0);
    }
    let off = Shadow::new(ShadowModel::Off, RADIUS_MERCURY_M).unwrap();
    assert_eq!(at(&off, -3e6, 0.0), 1.0);
}

#[test]
fn impossible_geometries_are_named() {
    let shadow = Shadow::new(ShadowModel::DiscOverlap, RADIUS_MERCURY_M).unwrap();
    let sun = Vector3::new(6e10, 0.0, 0.0);
    let say = |position: Vector3<f64>, sun: Vector3<f64>| {
        lit_fraction(&shadow, &position, &sun).unwrap_err().to_string()
    };
    assert!(say(Vector3::new(1e6, 0.0, 0.0), sun).contains("inside the planet of radius 2439400 m"));
    assert!(say(Vector3::zeros(), sun).contains("inside the planet"));
    assert!(say(sun, sun).contains("0 m from the Sun's centre"));
    assert!(say(Vector3::new(f64::NAN, 0.0, 0.0), sun).contains("spacecraft is not finite"));
    assert!(say(Vector3::new(3e6, 0.0, 0.0), sun * f64::INFINITY).contains("not finite"));
    let surface = Vector3::new(0.0, RADIUS_MERCURY_M, 0.0);
    assert!((lit_fraction(&shadow, &surface, &sun).unwrap() - 0.5).abs() < 1e-2);
    assert!(Shadow::new(ShadowModel::DiscOverlap, -1.0).unwrap_err().to_string().contains("-1 m"));
}

#[test]
fn edges_on_an_orbit() {
    // A circular orbit in a plane with the Sun: edges where the discs touch, symmetric about the antisolar point.
    let (radius_m, rate_rad_s) = (4e6, 1e-3);
    let sun = Vector3::new(6e10, 0.0, 0.0);
    let geometry = |t: f64| {
        let (s, c) = (rate_rad_s * t).sin_cos();
        (Vector3::new(c, s, 0.0) * radius_m, sun)
    };
    let revolution_s = 2.0 * PI / rate_rad_s;
    let shadow = Shadow::new(ShadowModel::DiscOverlap, RADIUS_MERCURY_M).unwrap();
    let gap_rad = |shadow: &Shadow, edge: usize, t: f64| {
        let (spacecraft, sun) = geometry(t);
        shadow.fraction_and_gaps(&spacecraft, &sun).1[edge]
    };
    // Into the shadow in the second quarter of the revolution, out of it in the third.
    let edges_s = |edge: usize| {
        [[0.25, 0.5], [0.5, 0.75]].map(|quarter| {
            let [from_s, to_s] = quarter.map(|share| share * revolution_s);
            bracketed(from_s, to_s, |t| gap_rad(&shadow, edge, t)).unwrap()
        })
    };
    let [outer_s, inner_s] = [0, 1].map(edges_s);
    assert!(outer_s[0] < inner_s[0] && inner_s[1] < outer_s[1]);
    for (edge, [into_s, out_s]) in [outer_s, inner_s].into_iter().enumerate() {
        assert!((into_s + out_s - revolution_s).abs() < 1e-7);
        for (at_s, later) in [(into_s, 1e-5), (out_s, -1e-5)] {
            let lit = |dt: f64| {
                let (spacecraft, sun) = geometry(at_s + dt);
                lit_fraction(&shadow, &spacecraft, &sun).unwrap()
            };
            // A microsecond on the bright side shows light, on the dark side less.
            let (brighter, darker) = (lit(-later), lit(later));
            match edge {
                0 => assert!(brighter == 1.0 && darker < 1.0),
                _ => assert!(brighter > 0.0 && darker == 0.0),
            }
        }
    }
    // The cylinder's edges by hand: sin(angle) = R / r.
    let cylinder = Shadow::new(ShadowModel::AllOrNothingCylinder, RADIUS_MERCURY_M).unwrap();
    let expected_s = (PI - (RADIUS_MERCURY_M / radius_m).asin()) / rate_rad_s;
    assert!(gap_rad(&cylinder, 0, expected_s - 1e-8) > 0.0 && gap_rad(&cylinder, 0, expected_s + 1e-8) < 0.0);
    let off = Shadow::new(ShadowModel::Off, RADIUS_MERCURY_M).unwrap();
    assert_eq!([0, 1].map(|edge| gap_rad(&off, edge, expected_s)), [f64::INFINITY; 2]);
    let inside = geometry(0.0).0 * 0.1;
    assert!([&shadow, &off].iter().all(|shadow| shadow.fraction_and_gaps(&inside, &sun).0.is_nan()));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn agrees_with_integration_over_the_disc(
        sun in 1e-3..0.02f64, log_ratio in -1.0..2.2f64, share in -0.999..0.999f64,
    ) {
        let planet = (sun * 10.0_f64.powf(log_ratio)).min(1.5);
        // Anywhere in the penumbra.
        let separation = planet.max(sun) + share * sun.min(planet);
        let d = discs(sun, planet, separation);
        prop_assert!((d.lit_fraction() - by_rings(&d)).abs() < 1e-9, "{} {}", d.lit_fraction(), by_rings(&d));
    }

    /// On straight paths the change of the gaps is within the bound.
    #[test]
    fn the_bound_of_their_rates_bounds_the_gaps(
        start in prop::array::uniform3(-2e7..2e7f64), velocity in prop::array::uniform3(-1e4..1e4f64), span_s in 0.1..300.0f64,
    ) {
        let (start, velocity) = (Vector3::from(start), Vector3::from(velocity));
        let (sun, radius_m) = (Vector3::new(6e10, 1e9, -2e9), RADIUS_MERCURY_M);
        let path = |share: f64| start + velocity * (span_s * share);
        let nearest_m = (0..=100).map(|k| path(f64::from(k) / 100.0).norm()).fold(f64::INFINITY, f64::min);
        prop_assume!(nearest_m > 1.01 * radius_m);
        let speed_m_s = velocity.norm();
        let sun_m = (sun - start).norm() - speed_m_s * span_s;
        for model in [ShadowModel::DiscOverlap, ShadowModel::AllOrNothingCone, ShadowModel::AllOrNothingCylinder] {
            let shadow = Shadow::new(model, radius_m).unwrap();
            let most_rad = shadow.greatest_gap_rate_rad_s([0.99 * nearest_m, speed_m_s], [sun_m, speed_m_s]) * span_s;
            let [first, last] = [0.0, 1.0].map(|share| shadow.fraction_and_gaps(&path(share), &sun).1);
            for (first, last) in first.into_iter().zip(last).filter(|(first, _)| first.is_finite()) {
                prop_assert!((last - first).abs() <= most_rad, "{first} {last} {most_rad}");
            }
        }
    }

    #[test]
    fn thin_lenses_do_not_cancel(sun in 1e-3..0.02f64, planet in 1e-3..1.5f64, log_depth in -9.0..-3.0f64) {
        // The planet's limb dips by d into the Sun's: covered 4/3 d^1.5 sqrt(2 r) / (pi a^2), with the curvatures
        // adding to 1/r = cot(a) + cot(b); the next term is smaller by d / r.
        let depth = 10.0_f64.powf(log_depth) * sun;
        let covered = 1.0 - discs(sun, planet, sun + planet - depth).lit_fraction();
        let r = 1.0 / (1.0 / sun.tan() + 1.0 / planet.tan());
        let area = 4.0 / 3.0 * depth.powf(1.5) * (2.0 * r).sqrt();
        let expected = area / (4.0 * PI * (0.5 * sun).sin().powi(2));
        prop_assert!((covered - expected).abs() < 1e-12 + 2.0 * depth / r * expected, "{covered:e} {expected:e}");
    }

    #[test]
    fn covered_more_as_the_planet_moves_in(sun in 1e-3..0.02f64, planet in 1e-3..1.5f64) {
        let mut last = 1.0;
        for i in 0..=200 {
            let separation = (sun + planet) * (1.0 - f64::from(i) / 200.0);
            let lit = discs(sun, planet, separation).lit_fraction();
            prop_assert!(lit <= last + 1e-13);
            last = lit;
        }
    }

    /// In the penumbra the lit fraction has a slope in every direction, and dual numbers carry it.
    #[test]
    fn dual_numbers_carry_the_slope_of_the_lit_fraction(
        depth in 0.05..0.95_f64, altitude in 1.05..5.0_f64, by in prop::array::uniform3(-1.0..1.0_f64),
    ) {
        let sun = Vector3::new(5.8e10, 0.0, 0.0);
        let shadow = Shadow::new(ShadowModel::DiscOverlap, RADIUS_MERCURY_M).unwrap();
        let distance = altitude * RADIUS_MERCURY_M;
        let sun_radius = (RADIUS_SUN_M / (5.8e10 + distance)).asin();
        let edge = (1.0 / altitude).asin() + (2.0 * depth - 1.0) * sun_radius;
        let place = Vector3::new(-edge.cos(), edge.sin(), 0.0) * distance;
        let along = |seed: f64| place + Vector3::from(by) * seed;
        let at = |seed: f64| lit_fraction(&shadow, &along(seed), &sun).unwrap();
        let seeded = place.zip_map(&Vector3::from(by), Dual64::new);
        let exact = lit_fraction(&shadow, &seeded, &sun.map(Dual64::constant)).unwrap();
        let h = 1e-5 * distance * sun_radius;
        let slope = (at(h) - at(-h)) / (2.0 * h);
        prop_assert!(exact.re > 0.0 && exact.re < 1.0);
        prop_assert!((slope - exact.eps).abs() * distance * sun_radius < 1e-6, "{slope} {}", exact.eps);
    }
}
