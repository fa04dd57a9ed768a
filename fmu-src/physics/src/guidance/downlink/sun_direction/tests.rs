//! Where Sun and Earth stand in the body frame of each attitude.
use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::Vector3;

use super::*;
use crate::bodies::Body;
use crate::guidance::geometry::moving::moving;
use crate::guidance::pointing::antenna::AntennaRow;
use crate::guidance::pointing::antenna::tests::{BACK, SUNSHADE, antennas, fixed_along, quadrants};
use crate::guidance::tests::geometry::{Motion, Random, difference_rad_s};
use crate::guidance::tests::orbit::about_mercury;

/// Azimuth in -90..0 or 90..180 deg, typed anew, -180 counting as 180.
fn in_quadrant(antenna: Option<AntennaRow>, azimuth_rad: f64) -> bool {
    let sine = azimuth_rad.sin();
    let cosine = azimuth_rad.cos();
    match antenna {
        SUNSHADE => sine <= 1e-12 && cosine >= -1e-12,
        BACK => sine >= -1e-12 && cosine <= 1e-12,
        _ => false,
    }
}

/// Sun and Earth at an angle of each other, down to almost in line, in a random orientation.
fn random_lines(random: &mut Random) -> [MovingVector; 2] {
    let small = 10_f64.powf(random.within(-8.0, 0.0));
    let any = random.within(0.0, PI);
    let theta_rad = random.one_of(&[any, any, any, small, PI - small]);
    let sun = random.direction();
    let across = sun.cross(&random.direction()).normalize();
    let earth = sun * theta_rad.cos() + across * theta_rad.sin();
    [moving(sun * 5e10, random.direction() * 5e4), moving(earth * 1e11, random.direction() * 3e4)]
}

#[test]
fn sun_at_its_angles_and_earth_in_the_plane() {
    let mut random = Random(21);
    let mut seen = [0; 4];
    let (mut sun_worst_rad, mut earth_worst_rad) = (0.0_f64, 0.0_f64);
    for _ in 0..100_000 {
        let [to_sun, to_earth] = random_lines(&mut random);
        let mut limit_rad = |most_rad: f64| random.within(-most_rad, most_rad);
        let sun_body = SunAngles { azimuth_rad: limit_rad(0.4), elevation_rad: limit_rad(0.4) };
        let request = DownlinkRequest { sun_body, ..DownlinkRequest::default() };
        let found = downlink(&to_sun, &to_earth, &quadrants(), &request).unwrap();
        let pointing = found.vectors.pointing().unwrap();
        let body = |v: &MovingVector| value(&pointing.to_body(&unit(v).unwrap()));
        let (sun, earth) = (body(&to_sun), body(&to_earth));
        let theta_rad = angle_between_rad(&value(&to_sun), &value(&to_earth));
        let most_rad = theta_rad.min(PI - theta_rad);

        earth_worst_rad = earth_worst_rad.max(earth.z.abs());
        let earth_azimuth_rad = SunAngles::from_direction(&earth).azimuth_rad;
        assert!(in_quadrant(found.antenna.antenna, earth_azimuth_rad), "{found:?} {earth_azimuth_rad}");
        assert!((found.antenna.azimuth_rad - earth_azimuth_rad).sin().abs() < 1e-12);
        let cut_rad = sun_body.elevation_rad.clamp(-most_rad, most_rad);
        let requested = direction_from_angles(SunAngles { elevation_rad: cut_rad, ..sun_body });
        let off_rad = angle_between_rad(&sun, &requested);
        if found.clamped && (2.0 * earth_azimuth_rad).sin().abs() < 1e-12 {
            // The Earth at a bound, the Sun as near as its distance allows, and neither azimuth in a quadrant.
            let least_rad = (angle_between_rad(&earth, &requested) - theta_rad).abs();
            assert!((off_rad - least_rad).abs() < 1e-12, "{off_rad} {least_rad}");
            let delta_rad = (theta_rad.cos() / cut_rad.cos()).clamp(-1.0, 1.0).acos();
            for azimuth_rad in [sun_body.azimuth_rad - delta_rad, sun_body.azimuth_rad + delta_rad] {
                assert!(![SUNSHADE, BACK].into_iter().any(|antenna| {
                    in_quadrant(antenna, azimuth_rad) && (2.0 * azimuth_rad).sin().abs() > 1e-7
                }));
            }
            seen[3] += 1;
        } else {
            sun_worst_rad = sun_worst_rad.max(off_rad);
            seen[if found.clamped { 2 } else { usize::from(found.antenna.antenna == BACK) }] += 1;
        }
    }
    assert!(sun_worst_rad < 1e-12 && earth_worst_rad < 1e-12, "{sun_worst_rad:e} {earth_worst_rad:e}");
    assert!(seen.iter().all(|count| *count > 2000), "{seen:?}");
}

#[test]
fn the_default_puts_the_sun_on_minus_y_and_the_earth_by_its_distance() {
    let mut random = Random(22);
    for _ in 0..10_000 {
        let [to_sun, to_earth] = random_lines(&mut random);
        let found = downlink(&to_sun, &to_earth, &quadrants(), &DownlinkRequest::default()).unwrap();
        let theta_rad = angle_between_rad(&value(&to_sun), &value(&to_earth));
        let (antenna, azimuth_rad) =
            if theta_rad < FRAC_PI_2 { (SUNSHADE, -theta_rad) } else { (BACK, theta_rad) };
        assert_eq!(found.antenna.antenna, antenna);
        assert!((found.antenna.azimuth_rad - azimuth_rad).abs() < 1e-12 && !found.clamped);
        let sun = value(&found.vectors.pointing().unwrap().to_body(&unit(&to_sun).unwrap()));
        assert!((sun + Vector3::y()).norm() < 1e-12, "{sun} {theta_rad}");
    }
}

/// Earth azimuths in deg by hand for Sun azimuth and distance: none, one or two in a quadrant.
#[test]
fn one_two_or_no_azimuth_lies_in_a_quadrant() {
    for (sun_deg, theta_deg, expected_deg, antenna, clamped) in [
        (0.0, 30.0, -30.0, SUNSHADE, false),
        (0.0, 150.0, 150.0, BACK, false),
        (10.0, 5.0, 0.0, SUNSHADE, true),
        (10.0, 85.0, -75.0, SUNSHADE, false),
        (10.0, 95.0, 105.0, BACK, false),
        (-10.0, 5.0, -15.0, SUNSHADE, false),
        (-10.0, 85.0, -90.0, SUNSHADE, true),
        (-10.0, 95.0, 90.0, BACK, true),
        (-10.0, 175.0, 165.0, BACK, false),
        (10.0, 178.0, 180.0, BACK, true),
        (10.0, 165.0, 175.0, BACK, false),
    ] {
        let theta_rad = f64::to_radians(theta_deg);
        let earth = fixed(Vector3::new(theta_rad.cos(), theta_rad.sin(), 0.0));
        let sun_body = SunAngles { azimuth_rad: f64::to_radians(sun_deg), elevation_rad: 0.0 };
        let request = DownlinkRequest { sun_body, ..DownlinkRequest::default() };
        let found = downlink(&fixed(Vector3::x()), &earth, &quadrants(), &request).unwrap();
        let off_deg = found.antenna.azimuth_rad.to_degrees() - expected_deg;
        assert!(off_deg.abs() < 1e-10, "{sun_deg} {theta_deg}: {found:?}");
        assert_eq!((found.antenna.antenna, found.clamped), (antenna, clamped), "{sun_deg} {theta_deg}");
    }
}

#[test]
fn a_requested_azimuth_looks_at_the_earth_or_its_nearest_bound_does() {
    let mut random = Random(23);
    for _ in 0..10_000 {
        let [to_sun, to_earth] = random_lines(&mut random);
        let azimuth_rad = random.within(-PI, PI);
        let request =
            DownlinkRequest { antenna_azimuth_rad: Some(azimuth_rad), ..DownlinkRequest::default() };
        let found = downlink(&to_sun, &to_earth, &quadrants(), &request).unwrap();
        let degrees = azimuth_rad.to_degrees();
        let (antenna, expected_deg) = match degrees {
            d if (-90.0..=0.0).contains(&d) => (SUNSHADE, d),
            d if d >= 90.0 => (BACK, d),
            d if d < -135.0 => (BACK, 180.0),
            d if d < -90.0 => (SUNSHADE, -90.0),
            d if d <= 45.0 => (SUNSHADE, 0.0),
            _ => (BACK, 90.0),
        };
        assert_eq!(
            (found.antenna.antenna, found.clamped),
            (antenna, degrees != expected_deg && (degrees - expected_deg).abs() > 1e-9)
        );
        assert!((found.antenna.azimuth_rad.to_degrees() - expected_deg).abs() < 1e-10);
        let pointing = found.vectors.pointing().unwrap();
        let earth = value(&pointing.to_body(&unit(&to_earth).unwrap()));
        let at = SunAngles { azimuth_rad: found.antenna.azimuth_rad, elevation_rad: 0.0 };
        assert!((earth - direction_from_angles(at)).norm() < 1e-12);
        // -Y and the Sun on one side of the boresight, in one plane with it.
        let sun = value(&pointing.to_body(&unit(&to_sun).unwrap()));
        assert!(pointing.degenerate || sun.z.abs() < 1e-12);
    }
}

#[test]
fn the_rate_is_the_difference_of_the_attitude() {
    let mut random = Random(24);
    let mut compared = 0;
    for _ in 0..3000 {
        let motions = [Motion::random(&mut random), Motion::random(&mut random)];
        let mut limit_rad = |most_rad: f64| random.within(-most_rad, most_rad);
        let sun_body = SunAngles { azimuth_rad: limit_rad(0.4), elevation_rad: limit_rad(0.4) };
        let request = DownlinkRequest { sun_body, ..DownlinkRequest::default() };
        let at = |time_s: f64| {
            let [to_sun, to_earth] = motions.map(|motion| motion.at(time_s));
            let found = downlink(&to_sun, &to_earth, &quadrants(), &request)?;
            Some((found.vectors.pointing()?, found.antenna.antenna, found.clamped))
        };
        let (pointing, antenna, clamped) = at(0.0).unwrap();
        let found = pointing.frame().rate_body_rad_s;
        let step_s = (3e-4 / found.norm()).min(0.1);
        let same = |t: f64| at(t).filter(|x| (x.1, x.2) == (antenna, clamped)).map(|x| x.0);
        let Some(expected) = difference_rad_s(same, step_s) else { continue };
        let error = (found - expected).norm() / expected.norm().max(1e-5);
        assert!(error < 1e-7, "{error:e} {request:?} {pointing:?}");
        compared += 1;
    }
    assert!(compared > 2900, "{compared}");
}

#[test]
fn in_line_the_attitude_is_finite_and_nothing_without_direction() {
    let sun = moving(Vector3::x(), Vector3::y() * 1e-4);
    for earth in [sun, -sun, fixed(Vector3::x()), fixed(-Vector3::x())] {
        for elevation_rad in [0.0, 0.2, -0.2] {
            let sun_body = SunAngles { azimuth_rad: 0.1, elevation_rad };
            let request = DownlinkRequest { sun_body, ..DownlinkRequest::default() };
            let found = downlink(&sun, &earth, &quadrants(), &request).unwrap();
            let pointing = found.vectors.pointing().unwrap();
            assert!(pointing.degenerate && pointing.frame().rate_body_rad_s.iter().all(|x| x.is_finite()));
        }
    }
    assert!(downlink(&MovingVector::zeros(), &sun, &quadrants(), &DownlinkRequest::default()).is_none());
    assert!(downlink(&sun, &MovingVector::zeros(), &quadrants(), &DownlinkRequest::default()).is_none());
}

#[test]
fn the_link_needs_antenna_distance_from_the_sun_and_a_free_line() {
    let degrees = f64::to_radians;
    let limits = LinkLimits { sun_separation_rad: degrees(3.0), coverage_rad: None };
    let around = |position: Vector3<f64>, theta_deg: f64| {
        let position = position * Body::Mercury.data().radius_m;
        let sun = Vector3::new(degrees(theta_deg).cos(), degrees(theta_deg).sin(), 0.0) * 5e10;
        about_mercury(position, position + sun, position + Vector3::x() * 1e11)
    };
    let (free, all) = (Vector3::new(2.0, 0.0, 0.0), quadrants());
    for (position, theta_deg, off_deg, antenna, expected) in [
        (free, 40.0, 0.0, SUNSHADE, true),
        (free, 40.0, 0.0, BACK, false),
        (free, 40.0, 0.0, None, false),
        (free, 140.0, 0.0, BACK, true),
        (free, 2.9, 0.0, SUNSHADE, false),
        (free, 3.1, 0.0, SUNSHADE, true),
        (free, 40.0, 1.9, SUNSHADE, true),
        (free, 40.0, 2.1, SUNSHADE, false),
        (-free, 40.0, 0.0, SUNSHADE, false),
        (Vector3::new(-2.0, 0.99, 0.0), 40.0, 0.0, SUNSHADE, false),
        (Vector3::new(-2.0, 1.01, 0.0), 40.0, 0.0, SUNSHADE, true),
    ] {
        let around = around(position, theta_deg);
        let pointing =
            downlink(&around.to_sun(), &around.to_earth(), &quadrants(), &DownlinkRequest::default())
                .unwrap()
                .vectors
                .pointing()
                .unwrap();
        // Off by a turn about -Y and by one about X together: about the Sun's and the Earth's normal's middle.
        let earth = value(&pointing.to_body(&unit(&around.to_earth()).unwrap()));
        let axis = fixed(earth.cross(&Vector3::z()).normalize());
        let pointing = pointing.turned(&axis, Moving::constant(degrees(off_deg)));
        let earth = value(&pointing.to_body(&around.to_earth()));
        let azimuth_rad = SunAngles::from_direction(&earth).azimuth_rad;
        let beam = |off_deg: f64| AntennaAzimuth {
            antenna,
            azimuth_rad: azimuth_rad + degrees(off_deg),
            outside_rad: 0.0,
        };
        let found = link(&around, &earth, &all, Some(&beam(0.0)), &limits).unwrap();
        // A fan of 15 deg, and none at all.
        for (beam_off_deg, reaches) in [(7.4, true), (-7.4, true), (7.6, false), (-7.6, false), (360.0, true)]
        {
            let off = link(&around, &earth, &all, Some(&beam(beam_off_deg)), &limits).unwrap();
            assert_eq!(off.available, expected && reaches, "{beam_off_deg}");
        }
        assert!(!link(&around, &earth, &all, None, &limits).unwrap().available);
        assert_eq!(found.available, expected, "{position} {theta_deg} {off_deg} {antenna:?}");
        assert!((found.sun_separation_rad - degrees(theta_deg)).abs() < 1e-12);
    }
}

#[test]
fn a_fixed_antenna_looks_at_the_earth_with_the_sun_as_near_to_its_place_as_a_turn_about_it_brings_it() {
    let mut random = Random(25);
    let (mut earth_worst, mut sun_worst_rad) = (0.0_f64, 0.0_f64);
    for _ in 0..1_000 {
        let [to_sun, to_earth] = random_lines(&mut random);
        let axis_body = random.direction();
        let mut limit_rad = |most_rad: f64| random.within(-most_rad, most_rad);
        let sun_body = SunAngles { azimuth_rad: limit_rad(0.4), elevation_rad: limit_rad(0.4) };
        let request = DownlinkRequest { sun_body, ..DownlinkRequest::default() };
        let found = downlink(&to_sun, &to_earth, &antennas(&[fixed_along(axis_body)]), &request).unwrap();
        let pointing = found.vectors.pointing().unwrap();
        let body = |v: &MovingVector| value(&pointing.to_body(&unit(v).unwrap()));
        let (sun, earth) = (body(&to_sun), body(&to_earth));
        assert_eq!(found.antenna.antenna, Some(AntennaRow(0)));
        earth_worst = earth_worst.max((earth - axis_body).norm());
        let place = direction_from_angles(sun_body);
        let off_rad = angle_between_rad(&sun, &place);
        let theta_rad = angle_between_rad(&value(&to_sun), &value(&to_earth));
        let bound_rad = (angle_between_rad(&axis_body, &place) - theta_rad).abs();
        sun_worst_rad = sun_worst_rad.max((off_rad - bound_rad).abs());
        // No turn about the antenna's axis brings the Sun nearer.
        let axis = nalgebra::Unit::new_normalize(axis_body);
        for turn in 0..720 {
            let turned = nalgebra::Rotation3::from_axis_angle(&axis, f64::from(turn) * PI / 360.0) * sun;
            assert!(angle_between_rad(&turned, &place) > off_rad - 1e-9, "{turn}: {found:?}");
        }
    }
    assert!(earth_worst < 1e-12 && sun_worst_rad < 1e-9, "{earth_worst:e} {sun_worst_rad:e}");
}

#[test]
fn without_antennas_safe_attitudes_have_the_earth_in_the_plane_and_no_antenna() {
    let mut random = Random(26);
    for _ in 0..1_000 {
        let [to_sun, to_earth] = random_lines(&mut random);
        let request = DownlinkRequest::default();
        let found = downlink(&to_sun, &to_earth, &Antennas::default(), &request).unwrap();
        let of_messenger = downlink(&to_sun, &to_earth, &quadrants(), &request).unwrap();
        assert_eq!((found.vectors, found.clamped), (of_messenger.vectors, false));
        assert_eq!(found.antenna.antenna, None);
    }
}
