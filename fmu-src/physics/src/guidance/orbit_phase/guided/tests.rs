//! A slew begins where the old attitude was, ends at the new one, and its rate is the derivative of its axes.
use super::*;
use crate::attitude::{MovingUnit, rotation_vector};
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::scenario::scenario_tests::camera;
use approx::assert_relative_eq;
use nalgebra::Vector3;

impl Sight for LinesOfSight {
    fn lines(&self) -> LinesOfSight {
        *self
    }

    fn ephemeris(&self) -> Option<EphemerisAtTime> {
        None
    }
}

fn lines(t: f64) -> LinesOfSight {
    let moving = |p: Vector3<f64>, v: Vector3<f64>| MovingUnit::from_vector(p, v).unwrap();
    let w = 2e-4;
    LinesOfSight {
        sun: moving(Vector3::new(1.0, 1e-7 * t, 0.1), Vector3::new(0.0, 1e-7, 0.0)),
        planet: Some(moving(
            Vector3::new((w * t).cos(), 0.5, (w * t).sin()),
            Vector3::new(-w * (w * t).sin(), 0.0, w * (w * t).cos()),
        )),
        earth: moving(Vector3::new(-0.3, 1.0, 0.2), Vector3::zeros()),
        sun_from_planet: None,
    }
}

fn guided(slew_rate_rad_s: f64) -> Guided {
    let law = crate::guidance::tests::orbit::guided;
    Guided { slew_rate_rad_s, ..law(ScienceRule::Nadir, 43_200.0, [7200.0, 36_000.0], 2) }
}

/// With MESSENGER's antennas.
fn at(law: &Guided, time_s: f64) -> GuidedAttitude {
    OrbitPhaseLaw { guided: *law, default_downlink: &DefaultDownlink::default() }.at(time_s, lines)
}

#[test]
fn a_slew_is_continuous_and_arrives() {
    let law = guided(3e-3);
    let just_before = at(&guided(0.0), 7200.0 - 1e-6).frame.inertial_from_body;
    let at_edge = at(&law, 7200.0);
    assert!(at_edge.slewing);
    assert_relative_eq!(just_before.matrix(), at_edge.frame.inertial_from_body.matrix(), epsilon = 1e-8);
    let angle_rad = rotation_vector(&just_before, &at(&guided(0.0), 7200.0).frame.inertial_from_body).norm();
    let end_s = 7200.0 + angle_rad / 3e-3;
    assert!(at(&law, end_s - 0.1).slewing);
    assert!(!at(&law, end_s + 0.1).slewing);
    assert_eq!(at(&law, end_s + 0.1).frame, at(&guided(0.0), end_s + 0.1).frame);
}

#[test]
fn rate_is_the_derivative_of_the_axes_everywhere() {
    let angles = SunAngles { azimuth_rad: -0.1, elevation_rad: 0.15 };
    let off_sun = DownlinkSunDirection { angles, earth_ahead: false };
    for sun_direction in [None, Some(off_sun)] {
        rate_is_the_derivative(&Guided { sun_direction, ..guided(2e-3) });
        let science = ScienceRule::Unloading { sun: angles, gimbal: camera() };
        rate_is_the_derivative(&Guided { sun_direction, science, ..guided(2e-3) });
    }
}

fn rate_is_the_derivative(law: &Guided) {
    for t in [100.0, 7300.0, 7500.0, 20_000.0, 36_100.0, 50_000.0] {
        let dt = 0.01;
        let axes_at = |t| at(law, t).frame.inertial_from_body;
        let turned = rotation_vector(&axes_at(t - dt), &axes_at(t + dt)) / (2.0 * dt);
        assert_relative_eq!(turned, at(law, t).frame.rate_body_rad_s, epsilon = 1e-8);
    }
}
