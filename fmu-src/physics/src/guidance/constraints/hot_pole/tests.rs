//! Against trial turns about the Sun line and differences of the attitude.
use std::f64::consts::PI;

use super::*;
use crate::bodies::Body;
use crate::guidance::geometry::moving::{MovingMatrix, MovingVector, moving};
use crate::guidance::pointing::law::PointingVectors;
use crate::guidance::tests::geometry::{Motion, Random, difference_rad_s};
use crate::guidance::tests::orbit::about_mercury;
use crate::tests::short_or_long;

fn ephemeris(position: MovingVector, sun: MovingVector) -> EphemerisAtTime {
    let far = Moving::constant(1e7);
    EphemerisAtTime {
        position: position * far,
        sun: sun * far * Moving::constant(1e4),
        ..about_mercury(Vector3::x(), Vector3::x(), Vector3::y())
    }
}

const EVERYWHERE: HotPole = HotPole { altitude_m: 1e12, angle_rad: 4.0, cone_rad: 0.0 };

#[test]
fn rounding_does_not_choose_the_sense_of_the_turn() {
    let mut random = Random(12);
    let pole = HotPole { cone_rad: 2.0, ..EVERYWHERE };
    // -Y at the Sun, -Z rolled to the planet: Sun, deck and planet in one plane.
    let at = |noise: Vector3<f64>| {
        let up = Vector3::new(0.9, 0.3, 0.1).normalize();
        let s = ephemeris(fixed(up), fixed(Vector3::x()));
        let vectors = PointingVectors {
            boresight_body: fixed(-Vector3::y()),
            aimpoint: fixed(Vector3::x() + noise),
            body_roll: fixed(-Vector3::z()),
            external_roll: fixed(-up),
        };
        let kept = pole.constrained(&vectors.pointing().unwrap(), &s, None);
        assert!(kept.side.is_some());
        kept.pointing.frame().inertial_from_body
    };
    let exact = at(Vector3::zeros());
    for _ in 0..200 {
        let found = at(random.direction() * 1e-16);
        assert!((found.matrix() - exact.matrix()).norm() < 1e-9);
    }
}

#[test]
fn the_cone_is_kept_or_the_best_turn_flagged() {
    let mut random = Random(11);
    let mut seen = [0; 3];
    let worst = [(); 2].map(|()| core::cell::Cell::new(0.0_f64));
    let count = short_or_long(60_000, 200_000);
    for _ in 0..count {
        let mut vector = || moving(random.direction(), random.direction() * 1e-4);
        let vectors = PointingVectors {
            boresight_body: vector(),
            aimpoint: vector(),
            body_roll: vector(),
            external_roll: vector(),
        };
        let around = ephemeris(vector(), vector());
        let cone = HotPole { cone_rad: random.within(0.1, 3.0), ..EVERYWHERE };
        let free = vectors.pointing().unwrap();
        let kept = cone.constrained(&free, &around, None);
        let body = |pointing: &Pointing, v: MovingVector| value(&pointing.to_body(&unit(&v).unwrap()));
        let shift = body(&kept.pointing, around.to_sun()) - body(&free, around.to_sun());
        worst[0].set(worst[0].get().max(shift.norm()));
        let off_rad =
            |pointing: &Pointing| angle_between_rad(&-Vector3::z(), &body(pointing, around.to_planet()));
        if kept.side.is_none() {
            assert!(off_rad(&free) >= cone.cone_rad && kept.pointing == free && kept.reached);
            seen[0] += 1;
            continue;
        }
        assert!(off_rad(&free) < cone.cone_rad);
        // The turn that was made, and shorter ones either way.
        let made_rad = {
            let from = free.frame().inertial_from_body;
            (from.inverse() * kept.pointing.frame().inertial_from_body).angle()
        };
        let sun_body = unit(&free.to_body(&around.to_sun())).unwrap();
        let trials = (-20..=20).map(|k| f64::from(k) / 20.0);
        let turned = |angle_rad: f64| free.turned(&sun_body, Moving::constant(angle_rad));
        if kept.reached {
            worst[1].set(worst[1].get().max((off_rad(&kept.pointing) - cone.cone_rad).abs()));
            for share in trials.filter(|share| share.abs() < 0.99) {
                assert!(off_rad(&turned(share * made_rad)) < cone.cone_rad + 1e-12);
            }
            seen[1] += 1;
        } else {
            let best_rad = off_rad(&kept.pointing);
            assert!(best_rad < cone.cone_rad);
            assert!(trials.map(|share| off_rad(&turned(share * PI))).all(|other| other <= best_rad + 1e-12));
            seen[2] += 1;
        }
    }
    assert!(worst[0].get() < 1e-14 && worst[1].get() < 1e-12, "{worst:?}");
    assert!(seen.iter().all(|found| *found > count / 20), "{seen:?}");
}

#[test]
fn the_rate_is_the_difference_of_the_attitude() {
    let mut random = Random(12);
    let (mut compared, mut switching) = (0, 0);
    for _ in 0..5000 {
        let cone = HotPole { cone_rad: random.within(0.1, 3.0), ..EVERYWHERE };
        let motions = [(); 6].map(|()| Motion::random(&mut random));
        let at = |time_s: f64| {
            let [boresight_body, aimpoint, body_roll, external_roll, position, sun] =
                motions.map(|motion| motion.at(time_s));
            let vectors = PointingVectors { boresight_body, aimpoint, body_roll, external_roll };
            let kept = cone.constrained(&vectors.pointing()?, &ephemeris(position, sun), None);
            kept.side.map(|_| kept)
        };
        let Some(kept) = at(0.0) else { continue };
        let found = kept.pointing.frame().rate_body_rad_s;
        let step_s = (3e-4 / found.norm()).min(0.1);
        let same = |t: f64| at(t).filter(|other| other.reached == kept.reached).map(|other| other.pointing);
        let jump = |t: f64| {
            same(t).is_none_or(|other| {
                let rate = other.frame().rate_body_rad_s;
                (rate - found).norm() > 5e-3 * found.norm().max(1e-5)
            })
        };
        // Left out: switching, and where the boundary is met at a tangent and the rate grows without bound.
        if jump(2.0 * step_s) || jump(-2.0 * step_s) {
            switching += 1;
            continue;
        }
        let Some(expected) = difference_rad_s(same, step_s) else { continue };
        let error = (found - expected).norm() / expected.norm().max(1e-5);
        assert!(error < 1e-7, "{error:e} {cone:?} {kept:?}");
        compared += 1;
    }
    assert!(compared > 1500 && switching < 200, "{compared} {switching}");
}

#[test]
fn a_turn_that_lasts_keeps_its_side_and_moves_steadily() {
    // The planet passes the plane of Sun and deck, and far from it: the smaller turn changes its sense twice.
    let cone = HotPole { cone_rad: 1.9, ..EVERYWHERE };
    let pointing = Pointing { inertial_from_body: MovingMatrix::identity(), degenerate: false };
    let kept_at = |step: i32, last: Option<TurnSide>| {
        let angle_rad = 0.7 * (f64::from(step) * 1e-3 * PI).sin();
        let planet = Vector3::new(angle_rad.sin(), 0.3, -angle_rad.cos());
        let around = ephemeris(fixed(-planet), fixed(-Vector3::y()));
        cone.constrained(&pointing, &around, last)
    };
    let axes = |kept: &KeptOut| kept.pointing.frame().inertial_from_body;
    let (mut last, mut greatest_rad, mut memoryless_rad) = (kept_at(0, None), 0.0_f64, 0.0_f64);
    let mut fresh = last;
    for step in 1..4000 {
        let next = kept_at(step, last.side);
        assert!(next.side == last.side && next.side.is_some() && next.reached);
        greatest_rad = greatest_rad.max((axes(&last).inverse() * axes(&next)).angle());
        let next_fresh = kept_at(step, None);
        memoryless_rad = memoryless_rad.max((axes(&fresh).inverse() * axes(&next_fresh)).angle());
        (last, fresh) = (next, next_fresh);
    }
    assert!(greatest_rad < 4e-3, "{greatest_rad}");
    assert!(memoryless_rad > 2.0, "{memoryless_rad}");
}

#[test]
fn it_ends_with_its_condition() {
    let sun = fixed(Vector3::x());
    let around = |height_m: f64, angle_rad: f64| {
        let radius_m = Body::Mercury.data().radius_m + height_m;
        let position = Vector3::new(angle_rad.cos(), angle_rad.sin(), 0.0) * radius_m;
        EphemerisAtTime { position: fixed(position), ..ephemeris(sun, sun) }
    };
    let cone = HotPole { altitude_m: 1e6, angle_rad: 0.5, cone_rad: 1.0 };
    // -Z at the planet, -Y toward the Sun as far as possible.
    let pointing = |around: &EphemerisAtTime| {
        PointingVectors {
            boresight_body: fixed(-Vector3::z()),
            aimpoint: around.to_planet(),
            body_roll: fixed(-Vector3::y()),
            external_roll: around.to_sun(),
        }
        .pointing()
        .unwrap()
    };
    for (height_m, angle_rad, expected) in [
        (0.99e6, 0.49, true),
        (1.01e6, 0.49, false),
        (0.99e6, 0.51, false),
        (0.5e6, -0.2, true),
        (0.5e6, 3.0, false),
    ] {
        let around = around(height_m, angle_rad);
        assert_eq!(cone.in_region(&around), expected);
        assert_eq!(cone.constrained(&pointing(&around), &around, None).side.is_some(), expected);
    }
}
