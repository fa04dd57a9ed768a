//! Ends, places of the Sun and rates of random turns.
use nalgebra::{Rotation3, Unit};

use super::*;
use crate::attitude::{angle_between_rad, direction_from_angles};
use crate::guidance::constraints::keep_in::KeepInMethod;
use crate::guidance::tests::geometry::{Random, nearest_zone};
use crate::tests::short_or_long;

const RATE_RAD_S: f64 = 5e-3;

fn zone(random: &mut Random) -> KeepIn {
    let tilted = random.direction();
    KeepIn {
        axis_body: random.one_of(&[-Vector3::y(), tilted]),
        azimuth_rad: random.within(0.05, 0.6),
        elevation_rad: random.within(0.05, 0.6),
        method: KeepInMethod::Nearest,
        distance_m: f64::INFINITY,
    }
}

/// The frame that has the Sun in this body direction, its roll given by an angle.
fn frame(to_sun: &Vector3<f64>, sun_body: &Vector3<f64>, roll_rad: f64) -> Rotation3<f64> {
    let aligned = Rotation3::rotation_between(sun_body, to_sun).unwrap_or_else(Rotation3::identity);
    Rotation3::from_axis_angle(&Unit::new_normalize(*to_sun), roll_rad) * aligned
}

/// The Sun's direction in the body, typed anew: the zone's frame by the smallest rotation from -Y to its axis.
fn sun_body(zone: &KeepIn, random: &mut Random, at_bound: bool) -> Vector3<f64> {
    let share =
        |random: &mut Random| if at_bound { random.one_of(&[-1.0, 1.0]) } else { random.within(-1.0, 1.0) };
    let angles = SunAngles {
        azimuth_rad: zone.azimuth_rad * share(random),
        elevation_rad: zone.elevation_rad * random.within(-1.0, 1.0),
    };
    let turn = nalgebra::UnitQuaternion::rotation_between(&-Vector3::y(), &zone.axis_body);
    turn.map_or_else(|| direction_from_angles(angles), |turn| turn * direction_from_angles(angles))
}

/// A turn between two attitudes at rest, and how far the Sun comes out of the zone about the eigenaxis.
struct SlewCase {
    zone: KeepIn,
    from: MovingFrame,
    to: MovingFrame,
    to_sun: MovingUnit,
    eigenaxis_excess_rad: f64,
}

fn case(random: &mut Random) -> SlewCase {
    let zone = zone(random);
    let to_sun = random.direction();
    let [from, to] = [(); 2].map(|()| {
        let at_bound = random.within(0.0, 1.0) < 0.3;
        let sun_body = sun_body(&zone, random, at_bound);
        let inertial_from_body = frame(&to_sun, &sun_body, random.within(-3.1, 3.1));
        MovingFrame { inertial_from_body, rate_body_rad_s: Vector3::zeros() }
    });
    let back = rotation_vector(&to.inertial_from_body, &from.inertial_from_body);
    let excess = |share: f64| {
        let attitude = to.inertial_from_body * Rotation3::from_scaled_axis(back * share);
        zone.excess_rad(&(attitude.inverse() * to_sun)).unwrap()
    };
    let eigenaxis_excess_rad = (0..=2000).map(|k| excess(f64::from(k) / 2000.0)).fold(f64::MIN, f64::max);
    SlewCase {
        zone,
        from,
        to,
        to_sun: MovingUnit { direction: to_sun, rate_1_s: Vector3::zeros() },
        eigenaxis_excess_rad,
    }
}

fn slew(case: &SlewCase) -> Slew {
    let start =
        SlewStart { from: &case.from, to: &case.to, to_sun: case.to_sun.direction, sun_drift_rad_s: 0.0 };
    Slew::between(&start, Some(&case.zone), RATE_RAD_S)
}

#[test]
fn a_turn_leaves_the_eigenaxis_only_where_that_leaves_the_zone_and_stays_inside() {
    let mut random = Random(41);
    let mut seen = [0; 2];
    for _ in 0..short_or_long(1500, 4000) {
        let case = case(&mut random);
        let slew = slew(&case);
        let is_eigenaxis = matches!(slew, Slew::Eigenaxis { .. });
        seen[usize::from(is_eigenaxis)] += 1;
        // The samples of the search are as far apart as a 2000th of the turn.
        if case.eigenaxis_excess_rad > 1e-9 {
            assert!(!is_eigenaxis, "{}", case.eigenaxis_excess_rad);
        } else if case.eigenaxis_excess_rad < -1e-6 {
            assert!(is_eigenaxis, "{}", case.eigenaxis_excess_rad);
        }
        let duration_s = slew.length_rad() / RATE_RAD_S;
        let mut greatest_rad_s = 0.0_f64;
        for k in 0..=40 {
            let left = f64::from(k) / 40.0;
            let found = slew.frame(&case.to, &case.to_sun, Moving::new(left, -1.0 / duration_s));
            let sun_body = found.inertial_from_body.inverse() * case.to_sun.direction;
            let excess_rad = case.zone.excess_rad(&sun_body).unwrap();
            assert!(excess_rad < 1e-11, "{excess_rad:e}");
            greatest_rad_s = greatest_rad_s.max(found.rate_body_rad_s.norm());
        }
        assert!(greatest_rad_s < RATE_RAD_S * (1.0 + 1e-9) && greatest_rad_s > RATE_RAD_S * (1.0 - 1e-9));
        for (left, end) in [(1.0, &case.from), (0.0, &case.to)] {
            let found =
                slew.frame(&case.to, &case.to_sun, Moving::new(left, -1.0 / duration_s)).inertial_from_body;
            let off_rad = rotation_vector(&end.inertial_from_body, &found).norm();
            assert!(off_rad < 1e-12, "{off_rad:e}");
        }
    }
    assert!(seen.iter().all(|count| *count > 200), "{seen:?}");
}

#[test]
fn within_the_zone_both_angles_go_straight_and_the_roll_in_proportion() {
    let mut random = Random(42);
    let mut checked = 0;
    for _ in 0..400 {
        let case = case(&mut random);
        let slew = slew(&case);
        if matches!(slew, Slew::Eigenaxis { .. }) {
            continue;
        }
        checked += 1;
        let at = |left: f64| slew.frame(&case.to, &case.to_sun, Moving::new(left, -1.0));
        let angles = |left: f64| {
            let sun =
                case.zone.angles(&(at(left).inertial_from_body.inverse() * case.to_sun.direction)).unwrap();
            Vector3::new(sun.azimuth_rad, sun.elevation_rad, 0.0)
        };
        for left in [0.2, 0.5, 0.9] {
            let straight = angles(0.0) * (1.0 - left) + angles(1.0) * left;
            assert!((angles(left) - straight).norm() < 1e-11);
        }
        let step = 1e-4;
        for left in [0.1, 0.4, 0.7] {
            let turned =
                rotation_vector(&at(left + step).inertial_from_body, &at(left - step).inertial_from_body);
            let expected = turned / (2.0 * step);
            let found = at(left).rate_body_rad_s;
            assert!((found - expected).norm() < 1e-6 * (1.0 + found.norm()), "{found} {expected}");
        }
    }
    assert!(checked > 50, "{checked}");
}

#[test]
fn what_the_new_attitudes_sun_may_move_is_a_margin() {
    // A turn about the Sun line, the Sun standing 0.01 rad inside a corner's sides at its nearest.
    let zone = nearest_zone(0.3, 0.3);
    let to_sun = Vector3::x();
    let sun_body = direction_from_angles(SunAngles { azimuth_rad: 0.29, elevation_rad: 0.0 });
    let [from, to] = [0.0, 0.5].map(|roll_rad| MovingFrame {
        inertial_from_body: frame(&to_sun, &sun_body, roll_rad),
        rate_body_rad_s: Vector3::zeros(),
    });
    let turned = |sun_drift_rad_s: f64| {
        let start = SlewStart { from: &from, to: &to, to_sun, sun_drift_rad_s };
        Slew::between(&start, Some(&zone), RATE_RAD_S)
    };
    assert!(angle_between_rad(&(to.inertial_from_body.inverse() * to_sun), &sun_body) < 1e-12);
    // The turn takes 100 s.
    assert!(matches!(turned(0.9e-4), Slew::Eigenaxis { .. }));
    assert!(matches!(turned(1.1e-4), Slew::WithinZone { .. }));
}
