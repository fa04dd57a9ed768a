//! The closed form obeys Newton's law: it agrees with integrating the acceleration, keeps energy and momentum,
//! and sweeps equal areas.

use proptest::prelude::*;

use super::*;
use crate::constants::{GM_EARTH_M3_S2, GM_MERCURY_M3_S2 as MU};

#[allow(clippy::unreadable_literal, reason = "a table")]
mod universal_variables;

fn messenger() -> Elements {
    // Paper 004 Table 3.
    Elements {
        semi_major_axis_m: 10_175_000.0,
        eccentricity: 0.74,
        inclination_rad: 82.52_f64.to_radians(),
        ascending_node_rad: 350.17_f64.to_radians(),
        periapsis_argument_rad: 119.16_f64.to_radians(),
        true_anomaly_rad: 1.0,
    }
}

/// Classical Runge-Kutta on Newton's law, nothing of the orbit module in it.
fn runge_kutta(mut state: CartesianState, mu: f64, duration_s: f64, steps: u32) -> CartesianState {
    let gravity = |r: Vector3<f64>| -r * (mu / r.norm().powi(3));
    let h = duration_s / f64::from(steps);
    for _ in 0..steps {
        let (r, v) = (state.position_m, state.velocity_m_s);
        let (k1r, k1v) = (v, gravity(r));
        let (k2r, k2v) = (v + k1v * (h / 2.0), gravity(r + k1r * (h / 2.0)));
        let (k3r, k3v) = (v + k2v * (h / 2.0), gravity(r + k2r * (h / 2.0)));
        let (k4r, k4v) = (v + k3v * h, gravity(r + k3r * h));
        state.position_m += (k1r + k2r * 2.0 + k3r * 2.0 + k4r) * (h / 6.0);
        state.velocity_m_s += (k1v + k2v * 2.0 + k3v * 2.0 + k4v) * (h / 6.0);
    }
    state
}

#[test]
fn agrees_with_integrating_newtons_law() {
    let hyperbola =
        Elements { semi_major_axis_m: -8e6, eccentricity: 1.6, true_anomaly_rad: -1.2, ..messenger() };
    for elements in [messenger(), hyperbola] {
        let orbit = TwoBodyOrbit::from_elements(elements, MU, 1000.0).unwrap();
        let start = orbit.state_at(1000.0);
        let given = elements.state(MU).unwrap();
        assert!((start.position_m - given.position_m).norm() < 1e-6);
        assert!((start.velocity_m_s - given.velocity_m_s).norm() < 1e-9);
        let integrated = runge_kutta(start, MU, 20_000.0, 80_000);
        let closed = orbit.state_at(21_000.0);
        assert!((integrated.position_m - closed.position_m).norm() < 1e-3);
        assert!((integrated.velocity_m_s - closed.velocity_m_s).norm() < 1e-6);
    }
}

/// Share of the distance that a place differs by.
fn apart(found: &CartesianState, x_m: f64, y_m: f64) -> f64 {
    (found.position_m - Vector3::new(x_m, y_m, 0.0)).norm() / x_m.hypot(y_m)
}

#[test]
fn places_are_those_of_universal_variables_to_1e_11_for_all_eccentricities() {
    assert_eq!(GM_EARTH_M3_S2, 3.986_004_355_07e14);
    // As late an epoch as flights have.
    let epoch_s = 292_248_000.0;
    for [x_m, y_m, vx_m_s, vy_m_s, after_s, then_x_m, then_y_m] in universal_variables::STATES {
        let state = CartesianState {
            position_m: Vector3::new(x_m, y_m, 0.0),
            velocity_m_s: Vector3::new(vx_m_s, vy_m_s, 0.0),
        };
        let orbit = TwoBodyOrbit::from_state(&state, GM_EARTH_M3_S2, epoch_s).unwrap();
        let off = apart(&orbit.state_at(epoch_s + after_s), then_x_m, then_y_m);
        assert!(off < 1e-11, "{off:e} after {after_s} s from {state:?}");
        assert!((orbit.periapsis_distance_m() / 7e6 - 1.0).abs() < 1e-11);
        assert!(apart(&orbit.state_at(epoch_s), x_m, y_m) < 1e-14);
    }
    for [a_m, e, anomaly_rad, after_s, then_x_m, then_y_m] in universal_variables::ELEMENTS {
        let elements =
            Elements { eccentricity: e, true_anomaly_rad: anomaly_rad, ..Elements::circle(a_m, 0.0) };
        let orbit = TwoBodyOrbit::from_elements(elements, GM_EARTH_M3_S2, epoch_s).unwrap();
        let off = apart(&orbit.state_at(epoch_s + after_s), then_x_m, then_y_m);
        assert!(off < 1e-11, "{off:e} after {after_s} s from {elements:?}");
    }
    let parabola = Elements { eccentricity: 1.0, ..Elements::circle(7e6, 0.0) };
    assert!(TwoBodyOrbit::from_elements(parabola, GM_EARTH_M3_S2, 0.0).is_err());
}

#[test]
fn energy_momentum_and_eccentricity_vector_are_constant() {
    let orbit = TwoBodyOrbit::from_elements(messenger(), MU, 0.0).unwrap();
    let invariants = |s: CartesianState| {
        let momentum = s.position_m.cross(&s.velocity_m_s);
        let energy = s.velocity_m_s.norm_squared() / 2.0 - MU / s.position_m.norm();
        (energy, momentum, s.velocity_m_s.cross(&momentum) / MU - s.position_m.normalize())
    };
    let (energy, momentum, vector) = invariants(orbit.state_at(0.0));
    for i in 0..500 {
        let (e, h, v) = invariants(orbit.state_at(f64::from(i) * 15_551.3));
        assert!((e / energy - 1.0).abs() < 2e-13);
        assert!((h - momentum).norm() < 1e-14 * momentum.norm());
        assert!((v - vector).norm() < 1e-13);
    }
}

#[test]
fn messenger_period_and_numbering() {
    // 12.07 h, not the 12 h of the paper's text.
    let orbit = TwoBodyOrbit::from_elements(messenger(), MU, 5e8).unwrap();
    assert!((orbit.period_s() / 3600.0 - 12.07).abs() < 0.005);
    for number in -3..400 {
        let epoch_s = orbit.periapsis_epoch_s(number);
        assert_eq!(orbit.orbit_number(epoch_s), number);
        assert_eq!(orbit.time_since_periapsis_s(epoch_s), 0.0);
        assert_eq!(orbit.orbit_number(epoch_s.next_down()), number - 1);
        assert!(orbit.time_since_periapsis_s(epoch_s.next_down()) < orbit.period_s() + 1e-6);
        let distance = orbit.state_at(epoch_s).position_m.norm();
        assert!((distance / messenger().periapsis_distance_m() - 1.0).abs() < 1e-12);
    }
    assert!(orbit.periapsis_epoch_s(0) < 5e8 && orbit.periapsis_epoch_s(1) > 5e8);
}

#[test]
fn a_period_brings_it_back() {
    let orbit = TwoBodyOrbit::from_elements(messenger(), MU, 0.0).unwrap();
    let (now, later) = (orbit.state_at(100.0), orbit.state_at(100.0 + orbit.period_s()));
    assert!((now.position_m - later.position_m).norm() < 1e-4);
    assert!(TwoBodyOrbit::from_elements(messenger(), MU, f64::NAN).is_err());
}

proptest! {
    #[test]
    fn energy_and_momentum_are_those_of_the_elements_near_a_parabola_too(
        log_gap in -15.0..1.0f64, outside: bool, anomaly in -2.6..2.6f64, t in -1e7..1e7f64,
    ) {
        let gap = 10.0_f64.powf(log_gap);
        let e = if outside { 1.0 + 0.9 * gap } else { (1.0 - gap).max(0.0) };
        let (q, anomaly) = (7e6, if e > 1.2 { anomaly / 2.6 * (-1.0 / e).acos() * 0.9 } else { anomaly });
        prop_assume!(e != 1.0);
        let elements = Elements {
            semi_major_axis_m: q / (1.0 - e), eccentricity: e, true_anomaly_rad: anomaly, ..messenger()
        };
        let orbit = TwoBodyOrbit::from_elements(elements, MU, 0.0).unwrap();
        for state in [orbit.state_at(0.0), orbit.state_at(t)] {
            let (r, v) = (state.position_m.norm(), state.velocity_m_s.norm());
            let momentum = state.position_m.cross(&state.velocity_m_s).norm();
            prop_assert!((momentum / (MU * q * (1.0 + e)).sqrt() - 1.0).abs() < 1e-11);
            prop_assert!((v * v - 2.0 * MU / r + MU / elements.semi_major_axis_m).abs() < 1e-11 * (v * v).max(MU / r));
        }
        let given = elements.state(MU).unwrap();
        prop_assert!((orbit.state_at(0.0).position_m - given.position_m).norm() < 1e-12 * given.position_m.norm());
    }

    #[test]
    fn velocity_is_the_derivative_of_position(
        a in 3e6..5e7f64, e in 0.0..0.9f64, anomaly in 0.0..TAU, t in -1e6..1e6f64,
    ) {
        let elements = Elements { semi_major_axis_m: a, eccentricity: e, true_anomaly_rad: anomaly, ..messenger() };
        let orbit = TwoBodyOrbit::from_elements(elements, MU, 0.0).unwrap();
        let state = orbit.state_at(t);
        // Fourth-order central difference on a hundred-thousandth of the local time scale.
        let h = 3e-3 * state.position_m.norm() / state.velocity_m_s.norm();
        let p = |k: f64| orbit.state_at(t + k * h).position_m;
        let slope = ((p(1.0) - p(-1.0)) * 8.0 - (p(2.0) - p(-2.0))) / (12.0 * h);
        prop_assert!((slope - state.velocity_m_s).norm() < 1e-8 * state.velocity_m_s.norm());
    }

    #[test]
    fn state_and_orbit_are_one(t in -1e5..1e5f64, later in -1e5..1e5f64) {
        let orbit = TwoBodyOrbit::from_elements(messenger(), MU, 0.0).unwrap();
        let again = TwoBodyOrbit::from_state(&orbit.state_at(t), MU, t).unwrap();
        let (a, b) = (orbit.state_at(later), again.state_at(later));
        prop_assert!((a.position_m - b.position_m).norm() < 1e-3);
    }
}
