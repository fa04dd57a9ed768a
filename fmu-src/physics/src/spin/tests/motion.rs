//! Motion agrees with closed forms, an independent integrator and the conservation laws.

use approx::assert_relative_eq;
use nalgebra::{Matrix3, Rotation3, Vector3};

use super::{assert_same_attitude, energy_j, reach, runge_kutta, started, tensor};
use crate::attitude::{Inertia, Quaternion, RigidBodyState, angle_between_rad};
use crate::spin::{motion::Motion, series::BodyTorque};
use crate::tests::short_or_long;

const OMEGA_RAD_S: f64 = std::f64::consts::PI / 6.0;

fn start(inertia: Inertia, damper_s: f64, rate: Vector3<f64>, torque: Vector3<f64>) -> Motion {
    started(&inertia, &tensor(inertia.principal_kg_m2(), [0.0; 3]), damper_s, rate, torque)
}

fn state_at(mut motion: Motion, time_s: f64) -> RigidBodyState {
    reach(&mut motion, time_s);
    motion.at(time_s)
}

/// Complete and incomplete Jacobi functions by descending Landen (arithmetic-geometric mean): sn, cn, dn.
fn jacobi(u: f64, m: f64) -> (f64, f64, f64) {
    let (mut a, mut c) = (vec![1.0_f64], vec![m.sqrt()]);
    let mut b = (1.0 - m).sqrt();
    while c.last().unwrap().abs() > 1e-17 {
        let (last, root) = (*a.last().unwrap(), (a.last().unwrap() * b).sqrt());
        a.push(0.5 * (last + b));
        c.push(0.5 * (last - b));
        b = root;
    }
    let n = a.len() - 1;
    let mut phi = 2.0_f64.powi(n as i32) * a[n] * u;
    for k in (1..=n).rev() {
        phi = 0.5 * (phi + (c[k] / a[k] * phi.sin()).asin());
    }
    (phi.sin(), phi.cos(), (1.0 - m * phi.sin().powi(2)).sqrt())
}

#[test]
fn triaxial_torque_free_rates_follow_jacobi_over_an_hour() {
    let (i1, i2, i3) = (236.0, 245.0, 353.82);
    let inertia = Inertia::new([i1, i2, i3]).unwrap();
    let (w10, w30) = (0.03, OMEGA_RAD_S);
    let motion = start(inertia, 0.0, Vector3::new(w10, 0.0, w30), Vector3::zeros());
    // Spin about the major axis, started where w2 = 0: w1 = w10 cn, w2 = w20 sn, w3 = w30 dn.
    let (a, b) = ((i3 - i1) / i2, (i2 - i1) / i3);
    let w20 = w10 * (i1 * (i3 - i1) / (i2 * (i3 - i2))).sqrt();
    let rate = w30 * ((i3 - i2) * (i3 - i1) / (i1 * i2)).sqrt();
    let m = b / a * (w20 / w30).powi(2);
    let mut motion = motion;
    for i in 1..=360 {
        let t = 10.0 * f64::from(i);
        reach(&mut motion, t);
        let w = motion.at(t).rate_rad_s(&inertia);
        let (sn, cn, dn) = jacobi(rate * t, m);
        assert!((w - Vector3::new(w10 * cn, w20 * sn, w30 * dn)).norm() < 1e-10, "{t} s: {w}");
    }
}

#[test]
fn triaxial_attitude_agrees_with_runge_kutta() {
    let inertia = Inertia::new([200.0, 260.0, 353.82]).unwrap();
    let rate = Vector3::new(0.05, -0.08, OMEGA_RAD_S);
    let state = state_at(start(inertia, 0.0, rate, Vector3::zeros()), 100.0);
    let (w, m) =
        runge_kutta(&tensor(inertia.principal_kg_m2(), [0.0; 3]), rate, |_| Vector3::zeros(), 100.0, 20_000);
    assert!((state.rate_rad_s(&inertia) - w).norm() < 1e-11);
    assert_same_attitude(state.attitude, &m, 1e-10);
}

#[test]
fn constant_torque_with_an_axial_part_agrees_with_runge_kutta() {
    for principal in [[238.58, 238.58, 353.82], [200.0, 260.0, 353.82]] {
        let inertia = Inertia::new(principal).unwrap();
        let (rate, torque) = (Vector3::new(0.01, 0.02, OMEGA_RAD_S), Vector3::new(1.779, -0.4, 3.0));
        let state = state_at(start(inertia, 0.0, rate, torque), 30.0);
        let (w, m) =
            runge_kutta(&tensor(inertia.principal_kg_m2(), [0.0; 3]), rate, |_| torque, 30.0, 10_000);
        assert!((state.rate_rad_s(&inertia) - w).norm() < 1e-11);
        assert_same_attitude(state.attitude, &m, 1e-10);
    }
}

#[test]
fn axisymmetric_rates_under_constant_torque_follow_the_fresnel_form() {
    // w = e^{iL(t)} [w0 + (T/It) int_0^t e^{-iL(s)} ds], L = (r - 1)(W t + a t^2/2), by Gauss-Legendre quadrature.
    let (transverse, spin) = (238.58, 353.82);
    let inertia = Inertia::new([transverse, transverse, spin]).unwrap();
    let (w0, torque) = (Vector3::new(0.002, -0.001, OMEGA_RAD_S), Vector3::new(1.5, 0.7, -0.9));
    let end = 40.0;
    let phase = |t: f64| (spin / transverse - 1.0) * (w0.z * t + 0.5 * torque.z / spin * t * t);
    let (mut re, mut im) = (0.0, 0.0);
    let nodes = [
        (0.0, 128.0 / 225.0),
        (0.538_469_310_105_683, 0.478_628_670_499_366_5),
        (0.906_179_845_938_664, 0.236_926_885_056_189_08),
    ];
    let panels = 2000;
    for i in 0..panels {
        let half = 0.5 * end / f64::from(panels);
        let middle = (2.0 * f64::from(i) + 1.0) * half;
        for (x, weight) in nodes {
            for x in if x == 0.0 { vec![0.0] } else { vec![x, -x] } {
                let angle = phase(middle + half * x);
                re += weight * half * angle.cos();
                im -= weight * half * angle.sin();
            }
        }
    }
    let (kick_re, kick_im) =
        ((torque.x * re - torque.y * im) / transverse, (torque.x * im + torque.y * re) / transverse);
    let (sum_re, sum_im) = (w0.x + kick_re, w0.y + kick_im);
    let (sine, cosine) = phase(end).sin_cos();
    let expected = Vector3::new(
        sum_re * cosine - sum_im * sine,
        sum_re * sine + sum_im * cosine,
        w0.z + torque.z / spin * end,
    );
    let state = state_at(start(inertia, 0.0, w0, torque), end);
    assert!((state.rate_rad_s(&inertia) - expected).norm() < 1e-13);
}

#[test]
fn a_torque_polynomial_in_time_agrees_with_runge_kutta() {
    let inertia = Inertia::new([238.58, 238.58, 353.82]).unwrap();
    let rate = Vector3::new(0.0, 0.01, OMEGA_RAD_S);
    let mut torque = BodyTorque::constant(Vector3::new(0.2, 0.0, -0.1));
    torque.origin_s = -3.0;
    torque.coefficients_n_m[1] = [0.05, -0.02, 0.01].into();
    torque.coefficients_n_m[3] = [1e-4, 2e-4, -1e-4].into();
    let law = |t: f64| {
        let x = t + 3.0;
        Vector3::new(
            0.2 + 0.05 * x + 1e-4 * x.powi(3),
            -0.02 * x + 2e-4 * x.powi(3),
            -0.1 + 0.01 * x - 1e-4 * x.powi(3),
        )
    };
    let quiet = start(inertia, 0.0, rate, Vector3::zeros());
    let motion = quiet.followed_by(0.0, inertia, torque, f64::INFINITY);
    let state = state_at(motion, 20.0);
    let (w, m) = runge_kutta(&tensor(inertia.principal_kg_m2(), [0.0; 3]), rate, law, 20.0, 8_000);
    assert!((state.rate_rad_s(&inertia) - w).norm() < 1e-11);
    assert_same_attitude(state.attitude, &m, 1e-10);
}

#[test]
fn the_closed_form_and_the_series_are_the_same_motion() {
    let rate = Vector3::new(0.02, -0.01, OMEGA_RAD_S);
    for damper_s in [0.0, 34_200.0, 600.0] {
        let symmetric = Inertia::new([238.58, 238.58, 353.82]).unwrap();
        let closed = start(symmetric, damper_s, rate, Vector3::zeros());
        // A torque too small to matter sends the same body through the series.
        let series = start(symmetric, damper_s, rate, Vector3::new(0.0, 0.0, 1e-300));
        assert!(closed.segment_end_s().is_infinite() && series.segment_end_s().is_finite());
        let (a, b) = (state_at(closed, 700.0), state_at(series, 700.0));
        let difference =
            a.attitude.0.iter().zip(b.attitude.0).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        // 366 rad of phase, some hundred segments: rounding alone.
        assert!(difference < 2e-12, "{damper_s}: {difference}");
        assert!((a.momentum_body - b.momentum_body).norm() < 1e-12 * a.momentum_body.norm());
    }
}

#[test]
fn momentum_and_energy_are_conserved_over_many_revolutions() {
    let rate = Vector3::new(0.03, 0.01, OMEGA_RAD_S);
    let end_s = short_or_long(2e4, 1e5) * 2.0 * std::f64::consts::PI / OMEGA_RAD_S;
    for (principal, tolerance) in [([238.58, 238.58, 353.82], 1e-12), ([200.0, 260.0, 353.82], 1e-10)] {
        let inertia = Inertia::new(principal).unwrap();
        let motion = start(inertia, 0.0, rate, Vector3::zeros());
        let (before, after) = (motion.at(0.0), state_at(motion.clone(), end_s));
        assert_relative_eq!(
            energy_j(&after, &inertia),
            energy_j(&before, &inertia),
            max_relative = tolerance
        );
        let seen = if inertia.is_axisymmetric() {
            momentum_by_precession(&inertia, &motion, end_s)
        } else {
            momentum_by_differences(&inertia, motion, end_s)
        };
        let off = (seen - before.momentum_inertial).norm() / before.momentum_inertial.norm();
        assert!(off < tolerance, "{principal:?}: {off:e}");
    }
}

/// J omega in inertial space, the rate from differences of the attitude about `time_s`: nothing is taken from the momentum
/// that the motion carries.
fn momentum_by_differences(inertia: &Inertia, mut motion: Motion, time_s: f64) -> Vector3<f64> {
    // Eighth order; a step of 1/16 s is exact in binary at any such time, and (omega dt)^8/630 is 1e-15.
    let (dt_s, centre_s) = (1.0 / 16.0, time_s.floor());
    let mut q = Vec::new();
    for k in -4..=4 {
        let at_s = centre_s + f64::from(k) * dt_s;
        reach(&mut motion, at_s);
        q.push(motion.at(at_s).attitude.0);
    }
    let weights = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let slope: [f64; 4] = std::array::from_fn(|i| {
        weights.iter().enumerate().map(|(k, w)| w * (q[5 + k][i] - q[3 - k][i])).sum::<f64>() / dt_s
    });
    // omega = 2 q* q', body components.
    let (v, w) = (Vector3::new(q[4][0], q[4][1], q[4][2]), q[4][3]);
    let v_dot = Vector3::new(slope[0], slope[1], slope[2]);
    let rate = (v_dot * w - v * slope[3] - v.cross(&v_dot)) * 2.0;
    let [a, b, c] = inertia.principal_kg_m2();
    Quaternion(q[4]).inertial_from_body(&Vector3::new(a * rate.x, b * rate.y, c * rate.z))
}

/// The momentum from the spin axis alone: it runs on a cone about H at |H|/IT. Directions near `time_s` give the axis of the
/// cone whatever their phase, and the phase after all those turns gives |H| to a part of a turn in all.
fn momentum_by_precession(inertia: &Inertia, motion: &Motion, time_s: f64) -> Vector3<f64> {
    let axis = |at_s: f64| motion.at(at_s).attitude.spin_axis_inertial();
    let [transverse, ..] = inertia.principal_kg_m2();
    let cone = |at_s: f64| {
        let (a, b, c) = (axis(at_s), axis(at_s + 3.0), axis(at_s + 6.0));
        (b - a).cross(&(c - b)).normalize()
    };
    let (first, last) = (cone(0.0), cone(time_s));
    let across = |z: Vector3<f64>| (z - last * last.dot(&z)).normalize();
    let (from, to) = (across(axis(0.0)), across(axis(time_s)));
    let phase = last.dot(&from.cross(&to)).atan2(from.dot(&to));
    // Whole turns from the rate over the first second, then ten times as long and so on.
    let (mut span_s, mut rate) = (1.0, 0.0);
    while span_s < time_s {
        let across = |z: Vector3<f64>| (z - first * first.dot(&z)).normalize();
        let to = across(axis(span_s));
        let start = across(axis(0.0));
        let part = first.dot(&start.cross(&to)).atan2(start.dot(&to));
        rate = turned(rate * span_s, part) / span_s;
        span_s *= 10.0;
    }
    last * (turned(rate * time_s, phase) / time_s * transverse)
}

/// The angle nearest to `about_rad` that is `part_rad` but for whole turns.
fn turned(about_rad: f64, part_rad: f64) -> f64 {
    let turn = 2.0 * std::f64::consts::PI;
    part_rad + turn * ((about_rad - part_rad) / turn).round()
}

#[test]
fn the_closed_form_turns_the_spin_axis_about_the_momentum_at_its_printed_rate() {
    // Eq 11: Omega_1 = I3/IT Omega_s for small nutation; |H|/IT in general.
    let inertia = Inertia::axisymmetric(353.82, 1.483).unwrap();
    let motion = start(inertia, 0.0, Vector3::new(1e-4, 0.0, OMEGA_RAD_S), Vector3::zeros());
    let turn = 2.0 * std::f64::consts::PI / (1.483 * OMEGA_RAD_S);
    let (z0, z1) =
        (motion.at(0.0).attitude.spin_axis_inertial(), motion.at(turn).attitude.spin_axis_inertial());
    assert!(angle_between_rad(&z0, &z1) < 1e-11);
    let half = motion.at(0.5 * turn).attitude.spin_axis_inertial();
    assert_relative_eq!(
        angle_between_rad(&z0, &half),
        2.0 * motion.at(0.0).nutation_rad(&inertia),
        max_relative = 1e-6
    );
}

#[test]
fn the_damper_takes_the_nutation_angle_to_1_e_and_keeps_the_momentum() {
    let tau = 34_200.0;
    for principal in [[238.58, 238.58, 353.82], [236.0, 241.0, 353.82]] {
        let inertia = Inertia::new(principal).unwrap();
        let motion = start(inertia, tau, Vector3::new(0.002, 0.0, OMEGA_RAD_S), Vector3::zeros());
        let before = motion.at(0.0);
        let after = state_at(motion, tau);
        // The nutation angle of a triaxial body also swings by a few per cent within each nutation period.
        let tolerance = if inertia.is_axisymmetric() { 1e-11 } else { 0.05 };
        assert_relative_eq!(
            after.nutation_rad(&inertia),
            before.nutation_rad(&inertia) / std::f64::consts::E,
            max_relative = tolerance
        );
        assert_eq!(after.momentum_inertial, before.momentum_inertial);
        assert!(energy_j(&after, &inertia) < energy_j(&before, &inertia));
        // The spin relaxes to H/I3.
        let rest =
            state_at(start(inertia, 60.0, Vector3::new(0.05, 0.0, OMEGA_RAD_S), Vector3::zeros()), 3_000.0);
        assert_relative_eq!(
            rest.rate_rad_s(&inertia).z,
            rest.momentum_body.norm() / 353.82,
            max_relative = 1e-12
        );
    }
}

#[test]
fn nutation_of_a_minor_axis_spinner_grows_to_a_flat_spin() {
    for principal in [[400.0, 400.0, 300.0], [390.0, 410.0, 300.0], [300.0, 420.0, 353.82]] {
        let inertia = Inertia::new(principal).unwrap();
        let motion = start(inertia, 500.0, Vector3::new(1e-4, 0.0, OMEGA_RAD_S), Vector3::zeros());
        let first = motion.at(0.0).nutation_rad(&inertia);
        if inertia.is_axisymmetric() {
            let later = state_at(motion.clone(), 500.0).nutation_rad(&inertia);
            assert_relative_eq!(later, first * std::f64::consts::E, max_relative = 1e-6);
        }
        let end = state_at(motion, 20_000.0);
        assert!(end.nutation_rad(&inertia) > 1.3, "{}", end.nutation_rad(&inertia));
        assert!(end.attitude.0.iter().all(|c| c.is_finite()));
    }
}

#[test]
fn the_damped_closed_form_obeys_the_dampers_own_differential_equation() {
    // phi' = -phi/tau and the kinematics of the line of nodes, checked by differences of the attitude.
    let inertia = Inertia::new([238.58, 238.58, 353.82]).unwrap();
    let tau = 200.0;
    let motion = start(inertia, tau, Vector3::new(0.2, -0.1, OMEGA_RAD_S), Vector3::zeros());
    for t in [0.0, 10.0, 333.0] {
        let (state, dt) = (motion.at(t), 1e-4);
        let matrix = |time: f64| {
            let q = motion.at(time).attitude;
            Matrix3::from_columns(
                &[Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| q.inertial_from_body(&axis)),
            )
        };
        let turned = Rotation3::from_matrix_unchecked(matrix(t - dt).transpose() * matrix(t + dt));
        let rate = turned.scaled_axis() / (2.0 * dt);
        let h = state.momentum_body;
        let gain = motion.damper.gain(&h);
        let expected = state.rate_rad_s(&inertia) + Vector3::new(-h.y, h.x, 0.0) * gain;
        assert!((rate - expected).norm() < 1e-8, "{rate} {expected}");
    }
}

#[test]
fn sampling_does_not_move_the_motion() {
    let inertia = Inertia::new([236.0, 245.0, 353.82]).unwrap();
    let motion = start(inertia, 34_200.0, Vector3::new(0.01, 0.0, OMEGA_RAD_S), Vector3::new(1e-3, 0.0, 0.0));
    let mut sampled = motion.clone();
    for i in 1..=4000 {
        let t = 0.05 * f64::from(i);
        reach(&mut sampled, t);
        let _ = sampled.at(t);
    }
    assert_eq!(sampled.at(200.0), state_at(motion, 200.0));
}

#[test]
fn moments_that_no_body_has_are_refused_by_name() {
    let error = Inertia::new([100.0, -3.0, 100.0]).unwrap_err().to_string();
    assert!(error.contains("inertia[2]") && error.contains("-3"));
    let error = Inertia::new([100.0, 100.0, 300.0]).unwrap_err().to_string();
    assert!(error.contains("inertia[3]") && error.contains("triangle"));
    assert!(Inertia::new([f64::NAN, 1.0, 1.0]).is_err());
}
