//! Sun and Earth against VSOP87, the spacecraft against its motion integrated step by step.
use nalgebra::Vector3;

use super::*;
use crate::attitude::angle_between_rad;
use crate::bodies::Body;
use crate::environment::bodies_from_center::{BodiesFromCenter, fixed};
use crate::environment::ephemeris::Ephemeris;
use crate::guidance::TargetPlanet;
use crate::guidance::geometry::moving::rate;

const EPOCH_S: f64 = 2.9e8;
const DAY_S: f64 = 86_400.0;

fn start() -> CartesianState {
    CartesianState {
        position_m: Vector3::new(3.0e6, -1.0e6, 2.0e6),
        velocity_m_s: Vector3::new(900.0, 2_400.0, 500.0),
    }
}

fn ephemeris_at_time(center: Body, sun: &CartesianState, earth: &CartesianState) -> EphemerisAtTime {
    EphemerisAtTime::new(EPOCH_S, TargetPlanet::from_body(center.data()), &start(), sun, earth)
}

#[test]
fn sun_and_earth_stand_where_the_theory_has_them() {
    let (mut ephemeris, mut worst_rad) = (Ephemeris::default(), 0.0_f64);
    for center in [Body::Mercury, Body::Venus, Body::Mars] {
        let bodies = BodiesFromCenter { center, ellipse: None, custom: None };
        let (sun, earth) = bodies.sun_and_earth(&mut ephemeris, EPOCH_S);
        let present = ephemeris_at_time(center, &sun, &earth);
        let predicted = PredictedOrbit::new(&present).unwrap();
        for days in [0.5, 1.0, 4.0] {
            let epoch_s = EPOCH_S + days * DAY_S;
            let (sun, earth) = bodies.sun_and_earth(&mut ephemeris, epoch_s);
            let then = predicted.at(epoch_s);
            for (found, expected) in [(then.sun, sun), (then.earth, earth)] {
                let off_rad = angle_between_rad(&value(&found), &expected.position_m);
                worst_rad = worst_rad.max(off_rad);
                // The Moon swings the Earth by 13 m/s.
                let speed_m_s = (rate(&found) - expected.velocity_m_s).norm();
                assert!(speed_m_s < 26.0, "{center:?} {days}: {speed_m_s}");
            }
        }
    }
    assert!((1e-6..3e-5).contains(&worst_rad), "{worst_rad:e}");
}

#[test]
fn the_spacecraft_falls_about_its_planet() {
    let still = fixed(Vector3::new(6e10, 0.0, 0.0));
    let present = ephemeris_at_time(Body::Mercury, &still, &still);
    let (mut r, mut v) = (start().position_m, start().velocity_m_s);
    // Leapfrog, of second order.
    let (step_s, steps) = (0.5, 8_000);
    let pull = |r: &Vector3<f64>| r * (-present.planet.gm_m3_s2 / r.norm().powi(3));
    for _ in 0..steps {
        v += pull(&r) * (0.5 * step_s);
        r += v * step_s;
        v += pull(&r) * (0.5 * step_s);
    }
    let predicted = PredictedOrbit::new(&present).unwrap();
    let then = predicted.at(EPOCH_S + step_s * f64::from(steps));
    assert!((value(&then.position) - r).norm() < 1.0, "{:?} {r:?}", then.position);
    // What is given without a velocity stands still.
    assert_eq!(value(&then.sun), still.position_m);
    assert_eq!(value(&then.earth), still.position_m);
}

#[test]
fn what_escapes_has_no_orbit_ahead() {
    let still = fixed(Vector3::new(6e10, 0.0, 0.0));
    let mut present = ephemeris_at_time(Body::Mercury, &still, &still);
    present.velocity *= crate::guidance::geometry::moving::Moving::from_re(10.0);
    assert!(PredictedOrbit::new(&present).is_none());
}
