//! Eqs 20 to 22 themselves, the sphere's closed form, and the number of solutions.
use super::super::moving::rate;
use super::*;
use crate::guidance::tests::orbit::TestOrbit;
use approx::assert_relative_eq;
use core::f64::consts::TAU;

/// Relative residuals of eqs 20, 21 and of the plane normal to `normal`.
fn residuals(s: &EphemerisAtTime, point: &MovingVector, normal: &Vector3<f64>) -> [f64; 3] {
    let to_planet = s.planet.planet_from_inertial(s.epoch_s).map(|x| x.re);
    let (x, r) = (to_planet * value(point), to_planet * value(&s.position));
    let squares = s.planet.radii_m.component_mul(&s.planet.radii_m);
    let on = x.component_mul(&x).component_div(&squares).sum() - 1.0;
    let cone = x.component_mul(&r).component_div(&squares).sum() - 1.0;
    [on, cone, value(point).normalize().dot(&normal.normalize())]
}

fn assert_solves(s: &EphemerisAtTime, point: &LimbPoint, normal: &Vector3<f64>) {
    assert!(point.exists);
    let residuals = residuals(s, &point.position, normal);
    assert!(residuals.iter().all(|x| x.abs() < 1e-12), "{residuals:?}");
}

/// A height that stays.
fn still(height_m: f64) -> Moving {
    Moving::from_re(height_m)
}

#[test]
fn the_generic_point_solves_the_equations_on_the_azimuths_side() {
    let orbit = TestOrbit::new(12.0);
    for time_s in orbit.times_s() {
        let s = orbit.ephemeris(time_s);
        for step in 0..16 {
            let azimuth = TAU * f64::from(step) / 16.0;
            for reference in [AzimuthReference::Downtrack, AzimuthReference::Sun] {
                let point = generic_limb(&s, reference, azimuth, still(0.0)).unwrap();
                let side = value(&lvlh_direction(&s, reference, azimuth, 0.0).unwrap());
                assert_solves(&s, &point, &value(&s.position).cross(&side));
                assert!(value(&point.position).dot(&side) > 0.0);
            }
        }
    }
}

#[test]
fn random_ellipsoids_seen_from_anywhere_have_two_points_or_none() {
    let mut some = TestOrbit::new(12.0).ephemeris(0.0);
    // Fractions of multiples of irrational numbers fill the cube evenly.
    let within =
        |k: u32, root: f64, low: f64, high: f64| low + (high - low) * (f64::from(k) * root.sqrt()).fract();
    let mut none = 0;
    for k in 1..100_000 {
        some.planet.radii_m =
            Vector3::new(within(k, 2.0, 1e6, 3e6), within(k, 3.0, 1e6, 3e6), within(k, 5.0, 1e6, 3e6));
        let direction = |a: f64, b: f64| {
            let (z, turn) = (within(k, a, -1.0, 1.0), within(k, b, 0.0, TAU));
            let across = (1.0 - z * z).sqrt();
            Vector3::new(across * turn.cos(), across * turn.sin(), z)
        };
        some.position = fixed(direction(7.0, 11.0) * within(k, 13.0, 3.01e6, 2e7));
        let normal = direction(17.0, 19.0);
        let Some(both) = limb_points(&some, &fixed(normal)) else {
            none += 1;
            continue;
        };
        for point in both {
            let residuals = residuals(&some, &point, &normal);
            assert!(residuals.iter().all(|x| x.abs() < 1e-12), "{residuals:?}");
        }
    }
    assert!(none > 1000 && none < 50_000, "{none}");
}

#[test]
fn on_a_sphere_the_limb_is_at_the_known_angle_from_nadir() {
    let mut s = TestOrbit::new(12.0).ephemeris(3000.0);
    s.planet.radii_m = Vector3::repeat(2.44e6);
    let (up, distance_m) = (value(&s.position).normalize(), value(&s.position).norm());
    let side = value(&lvlh_direction(&s, AzimuthReference::Sun, 0.4, 0.0).unwrap());
    let point = generic_limb(&s, AzimuthReference::Sun, 0.4, still(0.0)).unwrap();
    let angle: f64 = (2.44e6 / distance_m).acos();
    let expected = (up * angle.cos() + side * angle.sin()) * 2.44e6;
    assert_relative_eq!(value(&point.position), expected, epsilon = 1e-8);
}

#[test]
fn the_terminator_point_solves_the_equations_and_is_the_one_ahead() {
    let orbit = TestOrbit::new(12.0);
    let mut found = 0;
    for step in 0..400 {
        let s = orbit.ephemeris(f64::from(step) * 108.0 + 3.0);
        let point = terminator_limb(&s, still(0.0)).unwrap();
        let sun = value(&s.sun);
        // On a sphere the limb meets the terminator where the Sun's angle from up is within limb angle of 90 deg.
        let above = value(&s.position).dot(&sun.normalize()).abs();
        let across = (value(&s.position).norm_squared() - above * above).sqrt();
        let radii_m = s.planet.radii_m;
        if across > radii_m.max() * 1.001 {
            assert!(point.exists);
        } else if across < radii_m.min() * 0.999 {
            assert!(!point.exists);
        }
        if !point.exists {
            assert_eq!(value(&point.position), Vector3::zeros());
            continue;
        }
        found += 1;
        assert_solves(&s, &point, &sun);
        // The other solution is the first one mirrored on a sphere: both stand off the plane of spacecraft and Sun.
        let both = limb_points(&s, &unit(&s.sun).unwrap()).unwrap();
        let ahead = |p: &MovingVector| {
            let velocity = value(&s.velocity);
            let up = value(&s.position).normalize();
            let track = (velocity - up * up.dot(&velocity)).normalize();
            crate::attitude::angle_between_rad(&(value(p) - value(&s.position)), &track)
        };
        let nearest = ahead(&both[0]).min(ahead(&both[1]));
        assert_relative_eq!(ahead(&point.position), nearest, epsilon = 1e-14);
    }
    assert!(found > 50, "{found}");
}

#[test]
fn two_solutions_become_one_and_none_as_the_terminator_leaves_the_disc() {
    let at = |across: f64| {
        let mut s = TestOrbit::new(12.0).ephemeris(0.0);
        s.planet.radii_m = Vector3::repeat(2.0);
        s.position = fixed(Vector3::new(across, 0.0, 5.0));
        limb_points(&s, &fixed(Vector3::z()))
    };
    // Across the Sun's direction the points stand at +-sqrt(R^2 - R^4/d^2), so that they meet where d = R.
    for across in [4.0, 2.1, 2.0 + 1e-9] {
        let [a, b] = at(across).unwrap();
        let expected = 2.0 * (4.0 - 16.0 / (across * across)).sqrt();
        assert_relative_eq!(value(&(a - b)).norm(), expected, epsilon = 1e-12, max_relative = 1e-6);
    }
    assert!(at(2.0 - 1e-9).is_none());
    assert_eq!(root(Moving::new(0.0, 1.0)), Some(Moving::from_re(0.0)));
    assert_eq!(root(Moving::new(f64::NAN, 1.0)), None);
}

#[test]
fn height_grows_along_the_radius() {
    let s = TestOrbit::new(12.0).ephemeris(2000.0);
    let point = |height| generic_limb(&s, AzimuthReference::Downtrack, 1.0, height).unwrap();
    let ground = point(still(0.0));
    let raised = point(Moving::new(9000.0, -50.0));
    let at = value(&ground.position);
    assert_relative_eq!(value(&raised.position) - at, at.normalize() * 9000.0, epsilon = 1e-8);
    let growth = rate(&raised.position) - rate(&point(still(9000.0)).position);
    assert_relative_eq!(growth, at.normalize() * -50.0, epsilon = 1e-9);
}

#[test]
fn inside_the_planet_there_is_no_limb() {
    let s = TestOrbit::new(12.0).ephemeris(2000.0);
    let inside = EphemerisAtTime { position: s.position * Moving::from_re(0.01), ..s };
    assert!(!generic_limb(&inside, AzimuthReference::Downtrack, 0.0, still(0.0)).unwrap().exists);
    assert!(!terminator_limb(&inside, still(0.0)).unwrap().exists);
    assert!(terminator_limb(&EphemerisAtTime { sun: MovingVector::zeros(), ..s }, still(0.0)).is_none());
}
