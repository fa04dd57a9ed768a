//! Polygons against the spherical triangle of Sun, Earth and XY plane.

use nalgebra::Vector3;
use physics::constants::ASTRONOMICAL_UNIT_M;

use super::*;
use crate::momentum::test_spacecraft::{row, sunlit};

const REACH_RAD: [f64; 2] = [0.26, 0.22];

/// A downlink during which the Earth moves from one angle off the Sun to another, in deg.
fn rows(sunlit: &SunlitSpacecraft, from_deg: f64, to_deg: f64) -> Vec<FlightRow> {
    (0..9)
        .map(|k| {
            let angle = (from_deg + (to_deg - from_deg) * f64::from(k) / 8.0).to_radians();
            let mut row = row(sunlit, 3600.0 * f64::from(k), 0.4, 0.0);
            let sun = row.to_sun_m.normalize();
            let side = sun.cross(&Vector3::z()).normalize();
            row.to_earth_m = (sun * angle.cos() + side * angle.sin()) * ASTRONOMICAL_UNIT_M;
            row
        })
        .collect()
}

/// cos theta = cos E cos delta; the Earth's azimuth A - delta or A + delta within -90 to 0 or 90 to 180 deg.
fn is_allowed([azimuth, elevation]: [f64; 2], theta_deg: f64) -> bool {
    let cosine = theta_deg.to_radians().cos() / elevation.cos();
    if cosine.abs() > 1.0 {
        return false;
    }
    let delta = cosine.acos();
    [azimuth - delta, azimuth + delta].into_iter().any(|earth| {
        let earth_deg = (earth.to_degrees() + 180.0).rem_euclid(360.0) - 180.0;
        (-90.0..=0.0).contains(&earth_deg) || (90.0..=180.0).contains(&earth_deg)
    })
}

#[test]
fn what_lies_within_is_allowed_and_little_else_is() {
    let sunlit = sunlit([0.0; 3]);
    for (from_deg, to_deg) in
        [(5.0, 5.5), (9.0, 8.0), (40.0, 41.0), (86.0, 87.0), (93.0, 94.0), (150.0, 151.0), (172.0, 171.0)]
    {
        let rows = rows(&sunlit, from_deg, to_deg);
        let sides = places(&sunlit, &rows.iter().collect::<Vec<_>>(), REACH_RAD);
        let (mut inside, mut allowed) = (0, 0);
        for i in -40..=40 {
            for j in -40..=40 {
                let place = [f64::from(i) / 40.0 * REACH_RAD[0], f64::from(j) / 40.0 * REACH_RAD[1]];
                let is_inside = sides.iter().all(|side| side.holds(place));
                let is_allowed = [from_deg, 0.5 * (from_deg + to_deg), to_deg]
                    .into_iter()
                    .all(|theta_deg| is_allowed(place, theta_deg));
                assert!(!is_inside || is_allowed, "{from_deg} {to_deg}: {place:?}");
                inside += u32::from(is_inside);
                allowed += u32::from(is_allowed);
            }
        }
        println!("{from_deg} to {to_deg} deg: {inside} of {allowed} with {} sides", sides.len());
        assert!(f64::from(inside) > 0.85 * f64::from(allowed), "{from_deg} {to_deg}: {inside} of {allowed}");
        assert_eq!(sides.is_empty(), [40.0, 150.0].contains(&from_deg), "{from_deg} {to_deg}: {sides:?}");
    }
}

#[test]
fn with_sun_and_earth_at_a_right_angle_the_middle_stays() {
    let sunlit = sunlit([0.0; 3]);
    let rows = rows(&sunlit, 89.5, 90.5);
    let sides = places(&sunlit, &rows.iter().collect::<Vec<_>>(), REACH_RAD);
    assert!(sides.iter().all(|side| side.holds([0.0, 0.0])));
    assert!(!sides.iter().all(|side| side.holds([-0.1, 0.0])));
}
