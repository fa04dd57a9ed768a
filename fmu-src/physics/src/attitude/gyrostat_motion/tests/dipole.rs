//! A dipole in a magnetic field, against the pendulum and the invariants.

use approx::assert_relative_eq;
use nalgebra::Matrix3;

use super::*;
use crate::attitude::dipole_in_field::DipoleInField;

const INERTIA: [f64; 3] = [0.9, 1.4, 1.1];

fn body() -> Gyrostat {
    Gyrostat::new(Matrix3::from_diagonal(&INERTIA.into()), vec![]).unwrap()
}

fn load(dipole: [f64; 3], field: [f64; 3], rate: [f64; 3]) -> BodyLoad {
    let dipole = DipoleInField {
        dipole_body_a_m2: [Vector3::from(dipole), Vector3::zeros()],
        field_inertial_t: [Vector3::from(field), Vector3::from(rate)],
    };
    BodyLoad { dipole: Some(dipole), ..BodyLoad::none(1.0) }
}

/// Quarter period of a pendulum, complete elliptic integral of the first kind, by the arithmetic-geometric mean.
fn quarter_period(sine_of_half: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - sine_of_half * sine_of_half).sqrt());
    for _ in 0..12 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    core::f64::consts::FRAC_PI_2 / a
}

#[test]
fn a_compass_needle_swings_like_a_pendulum() {
    // J theta'' = -m B sin theta from rest at 60 deg: back there after 4 K(sin 30 deg) sqrt(J / m B).
    let (dipole, field) = (0.4, 4e-5);
    let away = 60.0_f64.to_radians();
    let field_t = [field * away.cos(), field * away.sin(), 0.0];
    let spacecraft = body();
    let load = load([dipole, 0.0, 0.0], field_t, [0.0; 3]);
    let still = Vector3::zeros();
    let mut motion = GyrostatMotion::new(&spacecraft, 0.0, Quaternion::IDENTITY, &still, |_| 0.0);
    let period_s = 4.0 * quarter_period((0.5 * away).sin()) * (INERTIA[2] / (dipole * field)).sqrt();
    // At rest on the other side of the field half a period later, and where it began after the whole of it.
    for (part, turned) in [(0.5, 2.0 * away), (1.0, 0.0)] {
        simulate(&mut motion, &spacecraft, &[], &load, part * period_s, 1.0);
        let found = motion.at(&spacecraft, part * period_s);
        assert!(found.rate_body_rad_s.norm() < 1e-11, "{}", found.rate_body_rad_s);
        let needle = found.attitude.inertial_from_body(&Vector3::x());
        assert_relative_eq!(needle.y.atan2(needle.x), turned, epsilon = 1e-10);
    }
}

#[test]
fn energy_and_momentum_along_the_field_stay() {
    let (dipole, field) = ([0.3, -0.2, 0.5], [2e-5, 3e-5, -1e-5]);
    let spacecraft = body();
    let load = load(dipole, field, [0.0; 3]);
    let rate = Vector3::new(0.004, -0.002, 0.003);
    let mut motion = GyrostatMotion::new(&spacecraft, 0.0, Quaternion::IDENTITY, &rate, |_| 0.0);
    let invariants = |body: &BodyMotion| {
        let field_body = body.attitude.body_from_inertial(&Vector3::from(field));
        let kinetic =
            0.5 * body.rate_body_rad_s.component_mul(&Vector3::from(INERTIA)).dot(&body.rate_body_rad_s);
        [
            kinetic - Vector3::from(dipole).dot(&field_body),
            body.momentum_inertial_n_m_s.dot(&Vector3::from(field)),
        ]
    };
    let before = invariants(&motion.at(&spacecraft, 0.0));
    simulate(&mut motion, &spacecraft, &[], &load, 3600.0, 0.5);
    for (before, after) in before.into_iter().zip(invariants(&motion.at(&spacecraft, 3600.0))) {
        assert_relative_eq!(before, after, max_relative = 1e-11);
    }
}

#[test]
fn a_field_that_grows_turns_the_body_by_as_much() {
    // About the axis of the field's rate nothing else acts: J theta'' = m (B0 + B' t) for small angles.
    let (dipole, grown) = (0.4, 1e-12);
    let spacecraft = body();
    let load = load([dipole, 0.0, 0.0], [0.0; 3], [0.0, grown, 0.0]);
    let mut motion = GyrostatMotion::new(&spacecraft, 0.0, Quaternion::IDENTITY, &Vector3::zeros(), |_| 0.0);
    motion.advance(&spacecraft, &[], &load, 2.0);
    let found = motion.at(&spacecraft, 2.0);
    assert_relative_eq!(found.rate_body_rad_s.z, dipole * grown * 2.0 / INERTIA[2], max_relative = 1e-12);
    let until = motion.evaluated_at(&spacecraft, 2.0);
    let impulse =
        motion.dipole_impulse_inertial_n_m_s(&load.dipole.unwrap().dipole_body_a_m2, &until).unwrap();
    assert_relative_eq!(impulse.z, dipole * grown * 2.0, max_relative = 1e-12);
    assert_relative_eq!(impulse, found.momentum_inertial_n_m_s, epsilon = 1e-25);
}

#[test]
fn two_dipoles_turn_the_body_by_their_sum_and_each_has_its_impulse() {
    // One that stays and one that grows, both along X, in a field along Y: J theta'' = (m + m' t) B for small angles.
    let (field, end_s) = (1e-12, 2.0);
    let steady = [Vector3::new(0.4, 0.0, 0.0), Vector3::zeros()];
    let growing = [Vector3::zeros(), Vector3::new(0.3, 0.0, 0.0)];
    let spacecraft = body();
    let mut load = load([0.0; 3], [0.0, field, 0.0], [0.0; 3]);
    load.dipole.as_mut().unwrap().dipole_body_a_m2 = [steady[0] + growing[0], steady[1] + growing[1]];
    let mut motion = GyrostatMotion::new(&spacecraft, 0.0, Quaternion::IDENTITY, &Vector3::zeros(), |_| 0.0);
    motion.advance(&spacecraft, &[], &load, end_s);
    let found = motion.at(&spacecraft, end_s);
    let expected_n_m_s = [0.4 * field * end_s, 0.3 * field * end_s * end_s / 2.0];
    let total_n_m_s = expected_n_m_s[0] + expected_n_m_s[1];
    assert_relative_eq!(found.rate_body_rad_s.z, total_n_m_s / INERTIA[2], max_relative = 1e-12);
    assert_relative_eq!(found.momentum_inertial_n_m_s.z, total_n_m_s, max_relative = 1e-12);
    for (part, expected) in [steady, growing].iter().zip(expected_n_m_s) {
        let impulse =
            motion.dipole_impulse_inertial_n_m_s(part, &motion.evaluated_at(&spacecraft, end_s)).unwrap();
        assert_relative_eq!(impulse.z, expected, max_relative = 1e-12);
    }
}

#[test]
fn a_dipole_that_grows_keeps_its_power_balance() {
    // d/dt (T - m . b) = -m' . b: the energy that the growing dipole brings in.
    let (dipole, slope, field) = ([0.3, -0.2, 0.5], [2e-3, 1e-3, -3e-3], [2e-5, 3e-5, -1e-5]);
    let spacecraft = body();
    let rate = Vector3::new(0.004, -0.002, 0.003);
    let mut motion = GyrostatMotion::new(&spacecraft, 0.0, Quaternion::IDENTITY, &rate, |_| 0.0);
    let [start, slope] = [dipole, slope].map(Vector3::from);
    let energy = |body: &BodyMotion, time_s: f64| {
        let field_body = body.attitude.body_from_inertial(&Vector3::from(field));
        let kinetic =
            0.5 * body.rate_body_rad_s.component_mul(&Vector3::from(INERTIA)).dot(&body.rate_body_rad_s);
        [kinetic - (start + slope * time_s).dot(&field_body), -slope.dot(&field_body)]
    };
    let [mut expected, mut power] = energy(&motion.at(&spacecraft, 0.0), 0.0);
    let (before, step_s) = (expected, 0.5);
    for k in 0..400 {
        let time_s = f64::from(k) * step_s;
        let mut load = load(dipole, field, [0.0; 3]);
        load.dipole.as_mut().unwrap().dipole_body_a_m2 = [start + slope * time_s, slope];
        while motion.end_s() < time_s + step_s {
            motion.advance(&spacecraft, &[], &load, time_s + step_s);
        }
        // Simpson's rule.
        let [_, middle] = energy(&motion.at(&spacecraft, time_s + 0.5 * step_s), time_s + 0.5 * step_s);
        let [_, end] = energy(&motion.at(&spacecraft, time_s + step_s), time_s + step_s);
        expected += step_s / 6.0 * (power + 4.0 * middle + end);
        power = end;
    }
    let end_s = motion.end_s();
    let [found, _] = energy(&motion.at(&spacecraft, end_s), end_s);
    assert!((found - before).abs() > 1e-6, "{found} {before}");
    assert_relative_eq!(found, expected, max_relative = 1e-11);
}
