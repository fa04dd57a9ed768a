//! Directions come out as almanacs and spherical trigonometry have them, and what is left open is refused.

use core::f64::consts::{FRAC_PI_2, PI};

use nalgebra::Vector3;
use physics::attitude::angle_between_rad;

use super::tests::{ace, request};
use super::{ACE, PlanError, TurnGeometry, TurnRequest, right_ascension_declination};
use physics::spin::spinner::Spinner;

fn geometry(arguments: &str) -> TurnGeometry {
    TurnGeometry::new(&request(arguments), &ace()).unwrap()
}

fn refused(arguments: &str) -> String {
    TurnGeometry::new(&request(arguments), &ace()).unwrap_err().to_string()
}

fn dated(date: &str, arguments: &str) -> TurnRequest {
    request(&format!("--date {} {arguments}", date.replace(' ', "_")))
}

/// Equinox and solstices of 2026 (Astronomical Almanac); EME2000's longitudes are 26 years of precession behind.
#[test]
fn the_sun_stands_where_the_almanac_has_it() {
    let precession_deg = 50.29 / 3600.0 * 26.3;
    for (date, longitude_deg) in [
        ("2026-03-20T14:46:00 UTC", 0.0_f64),
        ("2026-06-21T08:24:00 UTC", 90.0),
        ("2026-09-23T00:05:00 UTC", 180.0),
        ("2026-12-21T20:50:00 UTC", 270.0),
    ] {
        let geometry =
            TurnGeometry::new(&dated(date, "--from 0deg,90deg --target 0deg,80deg"), &ace()).unwrap();
        let longitude_rad = (longitude_deg - precession_deg).to_radians();
        let (sine, cosine) = 23.4393_f64.to_radians().sin_cos();
        let almanac =
            Vector3::new(longitude_rad.cos(), longitude_rad.sin() * cosine, longitude_rad.sin() * sine);
        let off_deg = angle_between_rad(&geometry.sun_inertial, &almanac).to_degrees();
        assert!(off_deg < 0.02, "{date}: {off_deg} deg");
        // From L1 the Earth stands opposite.
        let opposite_rad = angle_between_rad(&geometry.sun_inertial, &geometry.earth_inertial.unwrap());
        assert!((opposite_rad - PI).abs() < 1e-9);
        assert!(
            geometry.origin.contains(&date[..10]) && geometry.origin.contains("L1"),
            "{}",
            geometry.origin
        );
    }
}

#[test]
fn an_angle_and_a_direction_are_a_target() {
    let default = geometry("--angle 2deg");
    assert_eq!(default.axis_inertial, Vector3::z());
    assert!(
        (default.sun_inertial - Vector3::new(0.0, 10_f64.to_radians().sin(), 10_f64.to_radians().cos()))
            .norm()
            < 1e-15
    );
    assert!(
        (default.target_inertial - Vector3::new(2_f64.to_radians().sin(), 0.0, 2_f64.to_radians().cos()))
            .norm()
            < 1e-15
    );
    // By the spherical law of cosines: toward, away, across.
    for (direction_deg, sun_deg) in [(0.0, 7.0), (180.0, 13.0), (60.0, f64::NAN)] {
        let turned = geometry(&format!(
            "--angle 3deg --from 30deg,40deg --sun 30deg,50deg --direction {direction_deg}deg"
        ));
        let direction = f64::to_radians(direction_deg);
        let (angle, sun) = (3_f64.to_radians(), 10_f64.to_radians());
        let expected = (angle.cos() * sun.cos() + angle.sin() * sun.sin() * direction.cos()).acos();
        let found = angle_between_rad(&turned.target_inertial, &turned.sun_inertial);
        assert!(
            (found - expected).abs() < 1e-9
                && (sun_deg.is_nan() || (found.to_degrees() - sun_deg).abs() < 1e-9)
        );
        let off_rad = turned.great_circle().heading_rad.0 - direction;
        assert!(off_rad.sin().abs() < 1e-9 && off_rad.cos() > 0.0, "{off_rad}");
    }
}

#[test]
fn the_rhumb_line_is_the_navigators() {
    // Meridian and parallel of the Sun, and in between a course that is sailed step by step.
    let straight = geometry("--from 0deg,60deg --sun 0deg,90deg --target 0deg,70deg").rhumb_line().unwrap();
    assert!(
        (straight.length_rad - 10_f64.to_radians()).abs() < 1e-12 && straight.heading_rad.0.abs() < 1e-12
    );
    let parallel = geometry("--from 0deg,60deg --sun 0deg,90deg --target 50deg,60deg").rhumb_line().unwrap();
    assert!((parallel.length_rad - 0.5 * 50_f64.to_radians()).abs() < 1e-12, "{parallel:?}");
    assert!((parallel.heading_rad.0.abs() - FRAC_PI_2).abs() < 1e-9);
    for arguments in [
        "--from 10deg,-20deg --sun 30deg,-28deg --target 25deg,5deg",
        "--from 240deg,-20deg --sun 237.6deg,-20.1deg --target 252deg,-15deg",
    ] {
        let geometry = geometry(arguments);
        let (rhumb, great) = (geometry.rhumb_line().unwrap(), geometry.great_circle());
        assert!(rhumb.length_rad > great.length_rad);
        let steps = 200_000;
        let mut at = geometry.axis_inertial;
        for _ in 0..steps {
            let sun = (geometry.sun_inertial - at * at.dot(&geometry.sun_inertial)).normalize();
            let (sine, cosine) = rhumb.heading_rad.0.sin_cos();
            at = (at + (sun * cosine + at.cross(&sun) * sine) * (rhumb.length_rad / f64::from(steps)))
                .normalize();
        }
        let miss_rad = angle_between_rad(&at, &geometry.target_inertial);
        assert!(miss_rad < 2e-5, "{arguments}: {miss_rad}");
        assert!(angle_between_rad(&geometry.on_rhumb_line(1.0).unwrap(), &geometry.target_inertial) < 1e-9);
        assert!(angle_between_rad(&geometry.on_rhumb_line(0.0).unwrap(), &geometry.axis_inertial) < 1e-9);
    }
}

#[test]
fn the_attitude_has_the_axis_where_the_turn_begins() {
    for (from, body) in [
        ("240deg,-20deg", Vector3::z()),
        ("0deg,-90deg", Vector3::z()),
        ("0deg,90deg", Vector3::z()),
        ("70deg,10deg", Vector3::new(0.1, -0.2, 0.9).normalize()),
    ] {
        let geometry = geometry(&format!("--from {from} --sun 100deg,0deg"));
        let found = geometry.attitude(&body).inertial_from_body(&body);
        assert!((found - geometry.axis_inertial).norm() < 1e-12, "{from}: {found}");
    }
    let from = geometry("--from=-120deg,-20deg --sun 0deg,0deg");
    let place = right_ascension_declination(&from.axis_inertial);
    assert!((place.right_ascension_deg - 240.0).abs() < 1e-9 && (place.declination_deg + 20.0).abs() < 1e-9);
}

#[test]
fn the_files_start_values_are_where_a_plan_begins() {
    let half = core::f64::consts::FRAC_1_SQRT_2;
    let text = |value: &str| {
        format!("{ACE}\n[start]\n\"start.q\" = [0.0, {half}, 0.0, {half}]\n\"spin.initialRate\" = {value}\n")
    };
    let spinner = |value: &str| Spinner::parse("my.toml", &text(value)).unwrap();
    let geometry =
        TurnGeometry::new(&request("--target 2deg,0deg --sun 10deg,5deg"), &spinner("0.6")).unwrap();
    assert!((geometry.axis_inertial - Vector3::x()).norm() < 1e-12, "{}", geometry.axis_inertial);
    let rate = |value: &str, arguments: &str| {
        super::Task::new(&request(arguments), &spinner(value)).map(|task| task.case.spin.rate_rad_s)
    };
    let sun = "--sun 10deg,5deg";
    assert_eq!(rate("0.6", sun), Ok(0.6));
    assert!((rate("\"6 rpm\"", sun).unwrap() - 0.2 * PI).abs() < 1e-15);
    assert!((rate("\"36 deg/s\"", sun).unwrap() - 0.2 * PI).abs() < 1e-15);
    assert!((rate("0.6", "--sun 10deg,5deg --rate 3rpm").unwrap() - 0.1 * PI).abs() < 1e-15);
    let refused = rate("\"6 turns\"", sun).unwrap_err().to_string();
    assert!(refused.contains("spin.initialRate") && refused.contains("rpm"), "{refused}");
}

#[test]
fn what_is_left_open_is_refused() {
    for (arguments, parts) in [
        ("--target 10deg,20deg", ["--from", "where the spin axis stands"]),
        ("--target 10deg,20deg --from 10deg,10deg", ["--target", "--date or --sun"]),
        ("--target 10deg,20deg --from 10deg,20deg --sun 0deg,0deg", ["--target", "0.0000 deg"]),
        ("--target 190deg,-20deg --from 10deg,20deg --sun 0deg,0deg", ["--target", "above 0 to 175 deg"]),
        ("--sun 10deg,20deg", ["--from", "start.q"]),
        ("--from 10deg,20deg --sun 10deg,20deg", ["--direction", "--target"]),
    ] {
        let text = refused(arguments);
        assert!(parts.iter().all(|part| text.contains(part)), "{arguments}: {text}");
    }
    assert!(matches!(
        TurnGeometry::new(&request("--target 1deg,2deg --from 3deg,4deg"), &ace()),
        Err(PlanError::Direction { .. })
    ));
}
