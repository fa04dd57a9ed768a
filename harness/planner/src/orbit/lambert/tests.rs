//! Arcs against orbits in closed form, against universal variables solved by bisection, and against a printed example.
use approx::assert_relative_eq;
use proptest::prelude::*;

use super::*;
use physics::constants::GM_SUN_M3_S2;
use physics::environment::CartesianState;
use physics::environment::orbit::{Elements, TwoBodyOrbit};

const BRANCHES: [ArcBranch; 2] = [ArcBranch::Left, ArcBranch::Right];

fn arc_of(orbit: &TwoBodyOrbit, [from_s, to_s]: [f64; 2]) -> (LambertArc, [CartesianState; 2]) {
    let states = [from_s, to_s].map(|at_s| orbit.state_at(at_s));
    let arc = LambertArc {
        from_m: states[0].position_m,
        to_m: states[1].position_m,
        time_s: to_s - from_s,
        north: states[0].position_m.cross(&states[0].velocity_m_s),
        mu_m3_s2: orbit.mu_m3_s2(),
    };
    (arc, states)
}

fn difference(found: &LambertVelocities, states: &[CartesianState; 2]) -> f64 {
    let of = |found: Vector3<f64>, state: &CartesianState| {
        (found - state.velocity_m_s).norm() / state.velocity_m_s.norm()
    };
    of(found.from_m_s, &states[0]).max(of(found.to_m_s, &states[1]))
}

/// Stumpff's C and S by z.
fn stumpff(z: f64) -> [f64; 2] {
    if z.abs() < 1e-2 {
        let series = |first: f64, from: f64| {
            let (mut term, mut sum) = (first, first);
            for k in 1..12 {
                let k = 2.0 * f64::from(k) + from;
                term *= -z / (k * (k - 1.0));
                sum += term;
            }
            sum
        };
        return [series(0.5, 2.0), series(1.0 / 6.0, 3.0)];
    }
    let root = z.abs().sqrt();
    if z > 0.0 {
        [(1.0 - root.cos()) / z, (root - root.sin()) / root.powi(3)]
    } else {
        [(root.cosh() - 1.0) / -z, (root.sinh() - root) / root.powi(3)]
    }
}

/// Time and velocities of the arc of a universal variable z, the square of the change of eccentric anomaly.
fn of_universal(arc: &LambertArc, z: f64) -> Option<(f64, LambertVelocities)> {
    let (r1, r2) = (arc.from_m.norm(), arc.to_m.norm());
    let side = arc.from_m.cross(&arc.to_m).dot(&arc.north).signum();
    let a = side * (r1 * r2 + arc.from_m.dot(&arc.to_m)).sqrt();
    let [c, s] = stumpff(z);
    let y = r1 + r2 + a * (z * s - 1.0) / c.sqrt();
    if y <= 0.0 {
        return None;
    }
    let time_s = ((y / c).powf(1.5) * s + a * y.sqrt()) / arc.mu_m3_s2.sqrt();
    let (f, g, g_dot) = (1.0 - y / r1, a * (y / arc.mu_m3_s2).sqrt(), 1.0 - y / r2);
    let from_m_s = (arc.to_m - arc.from_m * f) / g;
    let to_m_s = (arc.to_m * g_dot - arc.from_m) / g;
    Some((time_s, LambertVelocities { from_m_s, to_m_s }))
}

/// The z in a bracket whose time is that of the arc, by bisection; the time grows from `low` to `high`.
fn by_bisection(arc: &LambertArc, [mut low, mut high]: [f64; 2]) -> LambertVelocities {
    for _ in 0..200 {
        let z = 0.5 * (low + high);
        if of_universal(arc, z).is_none_or(|(time_s, _)| time_s < arc.time_s) {
            low = z;
        } else {
            high = z;
        }
    }
    of_universal(arc, high).unwrap().1
}

/// The z of least time among arcs of so many revolutions, by golden section.
fn least(arc: &LambertArc, [mut low, mut high]: [f64; 2]) -> (f64, f64) {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let time = |z: f64| of_universal(arc, z).map_or(f64::INFINITY, |(time_s, _)| time_s);
    for _ in 0..100 {
        let [a, b] = [high - golden * (high - low), low + golden * (high - low)];
        if time(a) < time(b) {
            high = b;
        } else {
            low = a;
        }
    }
    (0.5 * (low + high), time(0.5 * (low + high)))
}

proptest! {
    #[test]
    fn the_arc_of_an_orbit_is_that_orbit(
        eccentricity in prop_oneof![0.0_f64..0.95, 1.05_f64..4.0],
        inclination_rad in 0.0_f64..3.1,
        angles in prop::array::uniform2(0.0_f64..6.2),
        anomaly_rad in -1.7_f64..1.7,
        share in 0.02_f64..0.98,
        revolutions in 0_u32..5,
    ) {
        let size_m = 7e10;
        let elements = Elements {
            semi_major_axis_m: if eccentricity < 1.0 { size_m } else { -size_m },
            eccentricity,
            inclination_rad,
            ascending_node_rad: angles[0],
            periapsis_argument_rad: angles[1],
            true_anomaly_rad: anomaly_rad,
        };
        prop_assume!(elements.check().is_ok());
        let orbit = TwoBodyOrbit::from_elements(elements, GM_SUN_M3_S2, 1e7).unwrap();
        let period_s = if eccentricity < 1.0 { orbit.period_s() } else { 2e7 };
        let revolutions = if eccentricity < 1.0 { revolutions } else { 0 };
        let to_s = 1e7 + (share + f64::from(revolutions)) * period_s;
        let (arc, states) = arc_of(&orbit, [1e7, to_s]);
        let sine = arc.from_m.normalize().cross(&arc.to_m.normalize()).norm();
        prop_assume!(sine > 1e-2);
        if revolutions == 0 {
            let found = arc.direct().unwrap();
            prop_assert!(difference(&found, &states) < 1e-10, "{:e}", difference(&found, &states));
            return Ok(());
        }
        let found = BRANCHES.map(|branch| arc.revolving(revolutions, branch).unwrap());
        let nearest = found.iter().map(|it| difference(it, &states)).fold(f64::INFINITY, f64::min);
        // Near the least time velocities are known to the root of the rounding of time.
        prop_assert!(nearest < 1e-6, "{nearest:e}");
        // The other one ends at the place as well.
        for velocities in found {
            let start = CartesianState { position_m: arc.from_m, velocity_m_s: velocities.from_m_s };
            let other = TwoBodyOrbit::from_state(&start, GM_SUN_M3_S2, 0.0).unwrap();
            let end = other.state_at(arc.time_s);
            prop_assert!((end.position_m - arc.to_m).norm() < 1e-8 * arc.to_m.norm());
            prop_assert!((end.velocity_m_s - velocities.to_m_s).norm() < 1e-6 * velocities.to_m_s.norm());
            prop_assert!(other.period_s() * f64::from(revolutions) < arc.time_s);
            prop_assert!(other.period_s() * f64::from(revolutions + 1) > arc.time_s);
        }
    }
}

#[test]
fn both_branches_agree_with_universal_variables_by_bisection() {
    let day_s = 86_400.0;
    let (from_m, north) = (Vector3::new(1.05e11, 2e9, -1e9), Vector3::new(0.1, -0.05, 1.0));
    for (angle_rad, days, revolutions) in
        [(2.0_f64, 201.0, 1_u32), (2.0, 420.0, 2), (5.1, 201.0, 1), (4.0, 420.0, 2), (0.4, 700.0, 4)]
    {
        let to_m = Vector3::new(angle_rad.cos(), angle_rad.sin(), 0.07) * 4.7e10;
        for sign in [1.0, -1.0] {
            let time_s = days * day_s;
            let arc = LambertArc { from_m, to_m, time_s, north: north * sign, mu_m3_s2: GM_SUN_M3_S2 };
            let turn = |k: u32| (core::f64::consts::TAU * f64::from(k)).powi(2);
            let [low, high] = [turn(revolutions) * (1.0 + 1e-9), turn(revolutions + 1) * (1.0 - 1e-9)];
            let (least_z, least_s) = least(&arc, [low, high]);
            assert!(least_s < time_s, "{angle_rad} {sign}: {} d", least_s / day_s);
            let expected = [by_bisection(&arc, [least_z, low]), by_bisection(&arc, [least_z, high])];
            let found = BRANCHES.map(|branch| arc.revolving(revolutions, branch).unwrap());
            // More eccentric anomaly is less x.
            for (found, expected) in found.iter().zip(expected.iter().rev()) {
                assert_relative_eq!(found.from_m_s, expected.from_m_s, max_relative = 1e-9);
                assert_relative_eq!(found.to_m_s, expected.to_m_s, max_relative = 1e-9);
            }
            let direct = by_bisection(&arc, [-400.0, turn(1) * (1.0 - 1e-9)]);
            assert_relative_eq!(arc.direct().unwrap().from_m_s, direct.from_m_s, max_relative = 1e-9);
            let least = |share: f64| LambertArc { time_s: share * least_s, ..arc };
            assert!(least(1.0 + 1e-6).revolving(revolutions, ArcBranch::Left).is_ok());
            let refused = least(1.0 - 1e-6).revolving(revolutions, ArcBranch::Right);
            let Err(LambertError::TooShort { least_s: named_s, .. }) = refused else { panic!("{refused:?}") };
            assert_relative_eq!(named_s, least_s, max_relative = 1e-9);
        }
    }
}

#[test]
fn vallados_example_comes_out_as_printed() {
    // Fundamentals of Astrodynamics and Applications, example 7-5.
    let arc = LambertArc {
        from_m: Vector3::new(15_945.34e3, 0.0, 0.0),
        to_m: Vector3::new(12_214.838_99e3, 10_249.467_31e3, 0.0),
        time_s: 76.0 * 60.0,
        north: Vector3::z(),
        mu_m3_s2: 398_600.441_5e9,
    };
    let found = arc.direct().unwrap();
    assert!((found.from_m_s - Vector3::new(2058.913, 2915.965, 0.0)).norm() < 2e-3, "{}", found.from_m_s);
    assert!((found.to_m_s - Vector3::new(-3451.565, 910.315, 0.0)).norm() < 2e-3, "{}", found.to_m_s);
}

#[test]
fn places_in_line_have_no_plane() {
    let arc = LambertArc {
        from_m: Vector3::new(1e11, 2e10, -3e9),
        to_m: -0.4 * Vector3::new(1e11, 2e10, -3e9),
        time_s: 1e7,
        north: Vector3::z(),
        mu_m3_s2: GM_SUN_M3_S2,
    };
    let refused = arc.direct().unwrap_err();
    assert!(refused.to_string().starts_with("found places 180.000 deg apart"), "{refused}");
    assert_eq!(arc.revolving(1, ArcBranch::Left), Err(refused));
    let near = LambertArc { to_m: arc.to_m + Vector3::new(0.0, 0.0, 1e5), ..arc };
    assert!(near.direct().is_ok());
    for bad in [0.0, -1.0, f64::NAN] {
        assert!(matches!(LambertArc { time_s: bad, ..near }.direct(), Err(LambertError::Orbit(_))));
        assert!(matches!(LambertArc { mu_m3_s2: bad, ..near }.direct(), Err(LambertError::Orbit(_))));
        assert!(LambertArc { to_m: near.to_m * (bad + bad.abs()), ..near }.direct().is_err());
    }
}
