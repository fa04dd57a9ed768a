//! What the paper's figures 1 to 3 say in words.
use super::*;
use crate::constants::DEG_RAD;
use crate::guidance::geometry::moving::{Moving, value};
use crate::guidance::pointing::antenna::tests::quadrants;
use crate::guidance::scenario::scenario_tests::camera;
use crate::spacecraft::GimbalMount;
use approx::assert_relative_eq;

fn with(option: BoresightOption, degrees: f64) -> Boresight {
    let command = BoresightCommand {
        option: Some(option),
        vector: Vector3::new(0.0, 2.0, 0.0),
        azimuth_rad: degrees * DEG_RAD,
        angle_rad: degrees * DEG_RAD,
        ..BoresightCommand::default()
    };
    boresight(&command, Some(&camera()), &quadrants()).unwrap()
}

#[test]
fn without_an_option_there_is_no_boresight() {
    assert!(boresight(&BoresightCommand::default(), Some(&camera()), &quadrants()).is_none());
    let on_gimbal = BoresightCommand { option: Some(BoresightOption::Gimbal), ..BoresightCommand::default() };
    assert!(boresight(&on_gimbal, None, &quadrants()).is_none());
}

#[test]
fn the_camera_looks_sunward_at_positive_angles_and_stops_at_its_range() {
    let camera = |degrees| with(BoresightOption::Gimbal, degrees);
    assert_eq!(value(&camera(0.0).body), Vector3::z());
    let half = 0.5_f64.sqrt();
    assert_relative_eq!(value(&camera(-45.0).body), Vector3::new(0.0, half, half), epsilon = 1e-15);
    assert!(value(&camera(30.0).body).y < 0.0, "toward the sunshade");
    for (requested, taken, in_range) in [
        (39.0, 39.0, true),
        (41.0, 40.0, false),
        (-51.0, -50.0, false),
        (-50.0, -50.0, true),
        (180.0, -50.0, false),
    ] {
        let angle = camera(requested).gimbal.unwrap();
        assert_eq!(angle.in_range, in_range, "{requested}");
        assert_relative_eq!(angle.angle_rad, taken * DEG_RAD, epsilon = 1e-15);
    }
}

#[test]
fn the_camera_turns_nearest_to_a_direction() {
    let camera = camera();
    for i in 0..500 {
        let t = f64::from(i) * 0.7;
        let direction = Vector3::new(0.5 * t.sin(), (1.3 * t).cos(), (0.4 * t).sin());
        let found = camera.boresight(camera.toward(&direction).angle_rad).dot(&direction);
        let best = (0..=9000)
            .map(|k| camera.boresight((f64::from(k) * 0.01 - 50.0) * DEG_RAD).dot(&direction))
            .fold(f64::NEG_INFINITY, f64::max);
        assert!(found >= best - 1e-15, "{direction}");
    }
}

#[test]
fn the_antennas_cover_two_quadrants_and_stop_at_the_nearest_bound() {
    let antenna = |degrees| with(BoresightOption::PhasedArray, degrees);
    let front = value(&antenna(-33.0).body);
    assert!(front.x < 0.0 && front.y < 0.0, "the -X,-Y quadrant");
    let back = value(&antenna(147.0).body);
    assert!(back.x > 0.0 && back.y > 0.0, "the +X,+Y quadrant");
    for (requested, taken, in_range) in [
        (-33.0, -33.0, true),
        (0.0, 0.0, true),
        (30.0, 0.0, false),
        (60.0, 90.0, false),
        (120.0, 120.0, true),
        (180.0, 180.0, true),
        (-170.0, 180.0, false),
        (-100.0, -90.0, false),
        (240.0, -90.0, false),
        (-180.0, 180.0, true),
    ] {
        let antenna = antenna(requested).antenna.unwrap();
        let angle = DeviceAngle { angle_rad: antenna.azimuth_rad, in_range: antenna.is_in_range() };
        assert_eq!(angle.in_range, in_range, "{requested}");
        assert_relative_eq!(angle.angle_rad, taken * DEG_RAD, epsilon = 1e-14);
    }
}

#[test]
fn instrument_0_is_plus_z_and_the_rows_follow() {
    let tilted = Vector3::new(0.0, 0.6, 0.8);
    let table = [Instrument { name: "tilted".into(), boresight_body: tilted, gimbal: None }];
    assert_eq!(instrument_boresight(&table, 0), Some(Vector3::z()));
    assert_eq!(instrument_boresight(&table, 1), Some(tilted));
    assert_eq!(instrument_boresight(&table, 2), None);
}

#[test]
fn a_gimbal_turns_right_handed_about_its_axis() {
    let axis = Vector3::new(0.6, 0.8, 0.0);
    let boresight_body = Vector3::new(-0.8, 0.6, 0.0);
    let mount = GimbalMount { axis_body: axis, minimum_rad: -1.0, maximum_rad: 0.3 };
    let fixed = Instrument { name: "fixed".into(), boresight_body: Vector3::z(), gimbal: None };
    let turned = Instrument { name: "turned".into(), boresight_body, gimbal: Some(mount) };
    assert_eq!(Gimbal::from_instruments(core::slice::from_ref(&fixed)), None);
    let gimbal = Gimbal::from_instruments(&[fixed, turned]).unwrap();
    for k in -20..=20 {
        let angle_rad = 0.1 * f64::from(k);
        let expected = nalgebra::Rotation3::new(axis * angle_rad) * boresight_body;
        assert_relative_eq!(gimbal.boresight(angle_rad), expected, epsilon = 1e-15);
        let moving = gimbal.boresight(Moving::from_re(angle_rad));
        assert_relative_eq!(value(&moving), expected, epsilon = 1e-15);
        // What lies off the plane that it sweeps does not count.
        let found = gimbal.toward(&(expected + axis * 0.7));
        assert_eq!(found.in_range, (-10..=3).contains(&k));
        if found.in_range {
            assert_relative_eq!(found.angle_rad, angle_rad, epsilon = 1e-15);
        }
    }
}
