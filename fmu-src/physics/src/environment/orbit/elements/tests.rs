//! Elements and state are two names of one orbit: in every quadrant, and where angles lose their meaning.

use core::f64::consts::{FRAC_PI_2, PI};

use proptest::prelude::*;

use super::*;
use crate::constants::GM_MERCURY_M3_S2 as MU;

fn elements(a: f64, e: f64, i: f64, node: f64, arg: f64, anomaly: f64) -> Elements {
    Elements {
        semi_major_axis_m: a,
        eccentricity: e,
        inclination_rad: i,
        ascending_node_rad: node,
        periapsis_argument_rad: arg,
        true_anomaly_rad: anomaly,
    }
}

fn close(state: &CartesianState, other: &CartesianState, tolerance: f64) -> bool {
    (state.position_m - other.position_m).norm() < tolerance * state.position_m.norm()
        && (state.velocity_m_s - other.velocity_m_s).norm() < tolerance * state.velocity_m_s.norm()
}

fn angle_between(a: f64, b: f64) -> f64 {
    ((a - b + PI).rem_euclid(TAU) - PI).abs()
}

#[test]
fn hand_solved_states() {
    // Circle in the xy plane, a quarter turn on; polar orbit at periapsis over the pole.
    let circle = elements(1e7, 0.0, 0.0, 0.0, 0.0, FRAC_PI_2).state(MU).unwrap();
    let speed = (MU / 1e7).sqrt();
    assert!((circle.position_m - Vector3::new(0.0, 1e7, 0.0)).norm() < 1e-8);
    assert!((circle.velocity_m_s - Vector3::new(-speed, 0.0, 0.0)).norm() < 1e-12);
    let polar = elements(1e7, 0.5, FRAC_PI_2, 0.0, FRAC_PI_2, 0.0).state(MU).unwrap();
    let speed = (MU / 1e7 * 3.0).sqrt();
    assert!((polar.position_m - Vector3::new(0.0, 0.0, 5e6)).norm() < 1e-8);
    assert!((polar.velocity_m_s - Vector3::new(-speed, 0.0, 0.0)).norm() < 1e-12);
}

#[test]
fn degenerate_orbits_follow_the_convention() {
    let at = |e, i, node, arg, anomaly| elements(2e7, e, i, node, arg, anomaly);
    // (given, expected): angles that mean nothing move into the next one.
    for (given, expected) in [
        (at(0.0, 1.0, 2.0, 0.5, 0.25), at(0.0, 1.0, 2.0, 0.0, 0.75)),
        (at(0.3, 0.0, 2.0, 0.5, 0.25), at(0.3, 0.0, 0.0, 2.5, 0.25)),
        (at(0.3, PI, 2.0, 0.5, 0.25), at(0.3, PI, 0.0, TAU - 1.5, 0.25)),
        (at(0.0, 0.0, 2.0, 0.5, 0.25), at(0.0, 0.0, 0.0, 0.0, 2.75)),
    ] {
        let found = Elements::from_state(&given.state(MU).unwrap(), MU).unwrap();
        assert!((found.eccentricity - expected.eccentricity).abs() < 1e-13);
        let latitude_rad = expected.periapsis_argument_rad + expected.true_anomaly_rad;
        assert!(angle_between(found.argument_of_latitude_rad(), latitude_rad) < 1e-12);
        assert!((0.0..TAU).contains(&found.argument_of_latitude_rad()));
        for (f, x) in [
            (found.inclination_rad, expected.inclination_rad),
            (found.ascending_node_rad, expected.ascending_node_rad),
            (found.periapsis_argument_rad, expected.periapsis_argument_rad),
            (found.true_anomaly_rad, expected.true_anomaly_rad),
        ] {
            assert!(angle_between(f, x) < 1e-12, "{found:?} {expected:?}");
        }
    }
}

#[test]
fn impossible_orbits_are_named() {
    let good = elements(1e7, 0.5, 1.0, 1.0, 1.0, 1.0);
    let say = |e: Elements| e.check().unwrap_err().to_string();
    assert!(
        say(Elements { eccentricity: -0.1, ..good }).contains("eccentricity is -0.1, allowed is 0 or more")
    );
    assert!(say(Elements { eccentricity: 1.0, ..good }).contains("parabola"));
    assert!(say(Elements { eccentricity: 1.5, ..good }).contains("below 0 for a hyperbola"));
    assert!(say(Elements { semi_major_axis_m: -1.0, ..good }).contains("above 0 for an ellipse"));
    assert!(say(Elements { inclination_rad: f64::NAN, ..good }).contains("inclination in rad is NaN"));
    let hyperbola = elements(-1e7, 1.5, 1.0, 1.0, 1.0, 3.0);
    assert!(say(hyperbola).contains("asymptotes"));
    assert!(good.state(0.0).unwrap_err().to_string().contains("gravitational parameter"));
    let fall = CartesianState { position_m: Vector3::x() * 1e7, velocity_m_s: Vector3::x() * 10.0 };
    assert!(matches!(Elements::from_state(&fall, MU), Err(OrbitError::Rectilinear { .. })));
    assert!(matches!(
        Elements::from_state(&CartesianState::default(), MU),
        Err(OrbitError::Rectilinear { .. })
    ));
    let escape = CartesianState {
        position_m: Vector3::x() * 1e7,
        velocity_m_s: Vector3::y() * (2.0 * MU / 1e7).sqrt(),
    };
    assert!(matches!(Elements::from_state(&escape, MU), Err(OrbitError::Parabolic { .. })));
}

proptest! {
    #[test]
    fn round_trip_in_all_quadrants(
        a in 3e6..1e9f64, e in 0.01..0.95f64, i in 0.01..3.13f64,
        node in 0.0..TAU, arg in 0.0..TAU, anomaly in 0.0..TAU,
    ) {
        let given = elements(a, e, i, node, arg, anomaly);
        let state = given.state(MU).unwrap();
        let found = Elements::from_state(&state, MU).unwrap();
        prop_assert!((found.semi_major_axis_m / a - 1.0).abs() < 1e-11);
        prop_assert!((found.eccentricity - e).abs() < 1e-12);
        prop_assert!((found.inclination_rad - i).abs() < 1e-12);
        prop_assert!(angle_between(found.ascending_node_rad, node) < 1e-12);
        prop_assert!(angle_between(found.periapsis_argument_rad, arg) < 1e-11);
        prop_assert!(angle_between(found.true_anomaly_rad, anomaly) < 1e-11);
        prop_assert!(close(&found.state(MU).unwrap(), &state, 1e-11));
    }

    #[test]
    fn hyperbolas_too(a in -1e9..-3e6f64, e in 1.05..6.0f64, i in 0.01..3.13f64, share in -0.95..0.95f64) {
        let asymptote = (-1.0 / e).acos();
        let given = elements(a, e, i, 4.0, 5.0, share * asymptote);
        let state = given.state(MU).unwrap();
        let found = Elements::from_state(&state, MU).unwrap();
        prop_assert!((found.true_anomaly_rad - share * asymptote).abs() < 1e-11);
        prop_assert!(close(&found.state(MU).unwrap(), &state, 1e-10));
    }

    #[test]
    fn any_state_survives(p in prop::array::uniform3(-1e7..1e7f64), v in prop::array::uniform3(-4e3..4e3f64)) {
        let state = CartesianState { position_m: p.into(), velocity_m_s: v.into() };
        let momentum = state.position_m.cross(&state.velocity_m_s).norm();
        prop_assume!(state.position_m.norm() > 1e5);
        prop_assume!(momentum > 0.01 * state.position_m.norm() * state.velocity_m_s.norm());
        if let Ok(found) = Elements::from_state(&state, MU) {
            prop_assume!((found.eccentricity - 1.0).abs() > 1e-3);
            prop_assert!(close(&found.state(MU).unwrap(), &state, 1e-9));
            // Vis-viva energy and momentum are those of the state.
            let energy = state.velocity_m_s.norm_squared() / 2.0 - MU / state.position_m.norm();
            prop_assert!((-MU / (2.0 * found.semi_major_axis_m) / energy - 1.0).abs() < 1e-9);
            prop_assert!(((MU * found.semi_latus_rectum_m()).sqrt() / momentum - 1.0).abs() < 1e-9);
        }
    }
}
