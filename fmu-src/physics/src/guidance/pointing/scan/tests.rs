//! Against a stepped integration of the motion, and what each frame says.
use super::*;
use crate::guidance::geometry::lvlh::AzimuthReference;
use crate::guidance::geometry::moving::{fixed, value};
use crate::guidance::tests::orbit::TestOrbit;
use approx::assert_relative_eq;
use core::f64::consts::FRAC_PI_2;

fn exact(elapsed_s: f64) -> ScanTime {
    ScanTime { elapsed_s, tolerance_s: 0.0 }
}

fn pattern(duration_s: f64, pause_s: f64, segments: u32, reverse: bool) -> ScanCommand {
    ScanCommand {
        duration_s: [duration_s; 3],
        pause_s: [pause_s; 3],
        segments: [segments; 3],
        reverse: [reverse; 3],
        ..ScanCommand::default()
    }
}

/// Offset by steps of 1/8 s, the rate by counting the state from corner to corner.
fn stepped(command: &ScanCommand, speed: f64, until_s: f64) -> (f64, f64) {
    let (mut moving, mut left_s, mut sign, mut done) = (true, command.duration_s[0], 1.0, 0);
    let (mut offset, step_s) = (0.0, 0.125);
    let mut steps = (until_s / step_s) as u32;
    loop {
        // Corners: what begins counts.
        while left_s <= 0.0 {
            if moving {
                done += 1;
                if command.reverse[0] {
                    sign = -sign;
                }
                left_s += command.pause_s[0];
            } else {
                left_s += command.duration_s[0];
            }
            moving = !moving;
        }
        let finished = command.segments[0] > 0 && done >= command.segments[0];
        let rate = if moving && !finished { sign * speed } else { 0.0 };
        if steps == 0 {
            return (offset, rate);
        }
        steps -= 1;
        offset += rate * step_s;
        left_s -= step_s;
    }
}

#[test]
fn the_offset_is_the_stepped_integral_of_the_rate() {
    for (duration_s, pause_s) in [(5.0, 2.0), (3.5, 0.0), (0.125, 0.25), (1000.0, 1.0)] {
        for segments in [0, 1, 2, 5] {
            for reverse in [false, true] {
                let command = pattern(duration_s, pause_s, segments, reverse);
                for eighth in 0..600 {
                    let at_s = f64::from(eighth) * 0.125;
                    let found = axis_offset(&command, 0, 0.25, exact(at_s));
                    let (offset, rate) = stepped(&command, 0.25, at_s);
                    assert_eq!((found.re, found.eps), (offset, rate), "{command:?} at {at_s} s");
                }
            }
        }
    }
}

#[test]
fn corners_that_are_no_binary_fractions_are_right_continuous() {
    let command = pattern(0.1, 0.2, 0, true);
    for cycle in 1..10_000 {
        let at_s = f64::from(cycle) * (0.1 + 0.2);
        let found = axis_offset(&command, 0, 1.0, exact(at_s));
        let odd = cycle % 2 == 1;
        assert_eq!(found.eps, if odd { -1.0 } else { 1.0 }, "{cycle}");
        assert_eq!(found.re, if odd { 0.1 } else { 0.0 });
    }
}

#[test]
fn a_corner_counts_as_reached_where_the_times_cannot_tell() {
    // A scan begun at a late time that is no binary fraction, and samples at whole seconds of its pattern.
    let (since_s, command) = (700_000_000.1, pattern(7.0, 3.0, 0, true));
    let tolerance_s = 4.0 * spacing(since_s);
    for second in 0..400 {
        let time_s = since_s + f64::from(second);
        let elapsed_s = time_s - since_s;
        // As if each of both times were rounded the other way.
        for elapsed_s in [elapsed_s - spacing(since_s), elapsed_s, elapsed_s + spacing(since_s)] {
            let found = axis_offset(&command, 0, 0.5, ScanTime { elapsed_s, tolerance_s });
            let within = second % 20;
            let expected = match within {
                0..7 => [0.5 * f64::from(within), 0.5],
                7..10 => [3.5, 0.0],
                10..17 => [3.5 - 0.5 * f64::from(within - 10), -0.5],
                _ => [0.0, 0.0],
            };
            assert!((found.re - expected[0]).abs() < 1e-6, "{second}: {found:?} {expected:?}");
            assert_eq!(found.eps, expected[1], "{second}");
        }
    }
}

#[test]
fn no_duration_no_speed_or_an_endless_one_is_no_error() {
    let still = Moving::from_re(0.0);
    assert_eq!(axis_offset(&ScanCommand::default(), 0, 1.0, exact(10.0)), still);
    assert_eq!(axis_offset(&pattern(0.0, 5.0, 0, true), 1, 1.0, exact(10.0)), still);
    assert_eq!(axis_offset(&pattern(5.0, 5.0, 0, true), 1, 1.0, exact(-10.0)), still);
    let endless = axis_offset(&pattern(f64::INFINITY, 0.0, 0, false), 2, 2.0, exact(10.0));
    assert_eq!((endless.re, endless.eps), (20.0, 2.0));
    let once = axis_offset(&pattern(4.0, f64::INFINITY, 0, true), 2, 2.0, exact(10.0));
    assert_eq!((once.re, once.eps), (8.0, 0.0));
}

fn moved(
    frame: ScanFrame,
    axis: usize,
    amount: f64,
    aimpoint: &Aimpoint,
    ephemeris: &EphemerisAtTime,
) -> Option<Scanned> {
    let mut command = ScanCommand { frame: Some(frame), ..pattern(1.0, 0.0, 1, false) };
    command.reference = Some(AzimuthReference::Sun);
    command.rate_rad_s[axis] = amount;
    command.speed_m_s[axis] = amount;
    let basic = Scanned { boresight_body: fixed(Vector3::z()), toward: aimpoint.toward };
    ScanCompatibility::default().scanned(&basic, aimpoint.kind, &command, ephemeris, exact(5.0))
}

#[test]
fn each_frame_moves_what_it_says() {
    let s = TestOrbit::new(12.0).ephemeris(900.0);
    let down = Aimpoint::new(s.to_planet(), AimpointKind::PlanetPoint).unwrap();
    let body = moved(ScanFrame::Body, 0, FRAC_PI_2, &down, &s).unwrap();
    assert_relative_eq!(value(&body.boresight_body), -Vector3::y(), epsilon = 1e-15);
    assert_eq!(body.toward, down.toward);
    let x = Aimpoint::new(fixed(Vector3::x()), AimpointKind::Direction).unwrap();
    let turned = moved(ScanFrame::InertialRotation, 2, FRAC_PI_2, &x, &s).unwrap();
    assert_relative_eq!(value(&turned.toward), Vector3::y(), epsilon = 1e-15);
    let shifted = moved(ScanFrame::InertialTranslation, 1, 1e4, &down, &s).unwrap();
    assert_relative_eq!(value(&(shifted.toward - down.toward)), Vector3::y() * 1e4, epsilon = 1e-8);
    let shifted = moved(ScanFrame::PlanetTranslation, 2, 1e4, &down, &s).unwrap();
    let pole = crate::bodies::Body::Mercury.data().pole();
    assert_relative_eq!(value(&(shifted.toward - down.toward)), pole * 1e4, epsilon = 1e-8);
    // About the reference by 90 deg: down goes to up x reference.
    let turned = moved(ScanFrame::LvlhRotation, 0, FRAC_PI_2, &down, &s).unwrap();
    let left = value(&s.position).cross(&value(&s.sun)).normalize();
    assert_relative_eq!(value(&turned.toward).normalize(), left, epsilon = 1e-13);
    // About up a vertical aimpoint stays.
    let turned = moved(ScanFrame::LvlhRotation, 2, 1.0, &down, &s).unwrap();
    let apart_m = (value(&turned.toward) - value(&down.toward)).norm();
    assert!(apart_m <= 1e-15 * value(&down.toward).norm(), "{apart_m}");
}

#[test]
fn rotations_follow_each_other_about_fixed_axes() {
    let s = TestOrbit::new(12.0).ephemeris(900.0);
    let y = Scanned { boresight_body: fixed(Vector3::z()), toward: fixed(Vector3::y()) };
    let command = ScanCommand {
        frame: Some(ScanFrame::InertialRotation),
        rate_rad_s: [FRAC_PI_2, FRAC_PI_2, 0.0],
        ..pattern(1.0, 0.0, 1, false)
    };
    // Y about X is Z; Z about the fixed Y is X. About turned axes it would be Z.
    let scans = ScanCompatibility::default();
    let turned = scans.scanned(&y, AimpointKind::Direction, &command, &s, exact(2.0)).unwrap();
    assert_relative_eq!(value(&turned.toward), Vector3::x(), epsilon = 1e-15);
}

#[test]
fn incompatible_scans_are_not_done() {
    let s = TestOrbit::new(12.0).ephemeris(900.0);
    let star = Aimpoint::new(fixed(Vector3::x()), AimpointKind::Direction).unwrap();
    let sun = Aimpoint::new(s.to_sun(), AimpointKind::Point).unwrap();
    for frame in [ScanFrame::InertialTranslation, ScanFrame::PlanetTranslation, ScanFrame::LvlhRotation] {
        assert!(moved(frame, 0, 1.0, &star, &s).is_none());
    }
    assert!(moved(ScanFrame::PlanetTranslation, 0, 1.0, &sun, &s).is_none());
    assert!(moved(ScanFrame::InertialTranslation, 0, 1.0, &sun, &s).is_some());
    // The Sun overhead leaves its local frame without a reference.
    let noon = EphemerisAtTime { sun: s.position * Moving::from_re(1e4), ..s };
    let down = Aimpoint::new(s.to_planet(), AimpointKind::PlanetPoint).unwrap();
    assert!(moved(ScanFrame::LvlhRotation, 0, 1.0, &down, &noon).is_none());
}
