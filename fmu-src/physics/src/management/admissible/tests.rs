//! Where the Earth stands, by the downlink law itself.
use super::*;
use crate::attitude::MovingUnit;
use crate::guidance::pointing::antenna::tests::quadrants;
use crate::guidance::{LinesOfSight, downlink_toward};
use core::f64::consts::FRAC_PI_4;
use nalgebra::Vector3;

const LIMITS: KeepInLimits = KeepInLimits { azimuth_rad: 0.26, elevation_rad: 0.23 };

fn lines(separation_rad: f64) -> LinesOfSight {
    let still = |direction| MovingUnit { direction, rate_1_s: Vector3::zeros() };
    LinesOfSight {
        sun: still(Vector3::x()),
        planet: None,
        earth: still(Vector3::new(separation_rad.cos(), separation_rad.sin(), 0.0)),
        sun_from_planet: None,
    }
}

#[test]
fn admissible_places_have_the_earth_in_a_quadrant_and_others_have_not() {
    let (mut inside, mut outside) = (0, 0);
    for i in 1..180 {
        let separation_rad = f64::from(i).to_radians();
        let lines = lines(separation_rad);
        for branch in Branch::all(LIMITS, &quadrants(), separation_rad).iter().flatten() {
            for j in -26..=26 {
                for k in [-0.22_f64, -0.1, 0.0, 0.07, 0.2] {
                    let angles = SunAngles { azimuth_rad: 0.01 * f64::from(j), elevation_rad: k };
                    if k.abs() > separation_rad.min(PI - separation_rad) {
                        assert_eq!(branch.place(angles), None);
                        continue;
                    }
                    let place = DownlinkSunDirection { angles, earth_ahead: branch.earth_ahead };
                    let frame = downlink_toward(&lines, &place).unwrap().frame;
                    let earth = frame.inertial_from_body.inverse() * lines.earth.direction;
                    let azimuth_rad = SunAngles::from_direction(&earth).azimuth_rad;
                    let off_rad = (azimuth_rad - branch.fan.unwrap().middle_rad + PI).rem_euclid(TAU) - PI;
                    if (off_rad.abs() - FRAC_PI_4).abs() < 1e-9 {
                        continue;
                    }
                    let covered = off_rad.abs() < FRAC_PI_4;
                    assert_eq!(branch.place(angles).is_some(), covered, "{i} {branch:?} {angles:?}");
                    if covered { inside += 1 } else { outside += 1 }
                }
            }
        }
    }
    assert!(inside > 10_000 && outside > 10_000, "{inside} {outside}");
}

#[test]
fn while_a_downlink_lasts_the_earth_stays_in_the_quadrant() {
    let (mut inside, mut left) = (0, 0);
    for i in 0..340 {
        let start_rad = (5.0 + 0.5 * f64::from(i)).to_radians();
        let end_rad = start_rad + 1.1_f64.to_radians();
        let through = (0..=10).map(|k| start_rad + (end_rad - start_rad) * f64::from(k) / 10.0);
        let places: Vec<_> = through.map(|it| (it, lines(it))).collect();
        for branch in Branch::all(LIMITS, &quadrants(), start_rad).iter().flatten() {
            let lasting = branch.lasting([start_rad, end_rad]);
            for j in -26..=26 {
                for k in [-0.22_f64, 0.0, 0.11] {
                    let angles = SunAngles { azimuth_rad: 0.01 * f64::from(j), elevation_rad: k };
                    let off_rad = places.iter().map(|(separation_rad, lines)| {
                        if k.abs() > separation_rad.min(PI - separation_rad) {
                            return f64::INFINITY;
                        }
                        let place = DownlinkSunDirection { angles, earth_ahead: branch.earth_ahead };
                        let frame = downlink_toward(lines, &place).unwrap().frame;
                        let earth = frame.inertial_from_body.inverse() * lines.earth.direction;
                        let azimuth_rad = SunAngles::from_direction(&earth).azimuth_rad;
                        let off_rad =
                            (azimuth_rad - branch.fan.unwrap().middle_rad + PI).rem_euclid(TAU) - PI;
                        off_rad.abs() - FRAC_PI_4
                    });
                    let greatest_rad = off_rad.fold(f64::NEG_INFINITY, f64::max);
                    if greatest_rad.abs() < 1e-9 {
                        continue;
                    }
                    let stays = greatest_rad < 0.0;
                    assert_eq!(lasting.place(angles).is_some(), stays, "{i} {branch:?} {angles:?}");
                    inside += u32::from(stays);
                    left += u32::from(!stays && branch.place(angles).is_some());
                }
            }
        }
    }
    assert!(inside > 10_000 && left > 100, "{inside} {left}");
}

#[test]
fn the_first_branch_is_the_default_attitude() {
    for degrees in [1.0_f64, 30.0, 89.0, 91.0, 150.0, 179.0] {
        let first = Branch::all(LIMITS, &quadrants(), degrees.to_radians())[0].unwrap();
        let place = first.place(SunAngles::default());
        assert_eq!(place.map(|it| it.earth_ahead), Some(degrees > 90.0), "{degrees}");
    }
}
