//! Windows against closed forms of a turning body and against all pairs of rows.
use core::f64::consts::TAU;

use loader::Column;
use nalgebra::Rotation3;

use super::*;

/// A flight whose body turns about inertial Z at `rate_rad_s`, with momentum of one source in EME2000.
fn flight(times_s: &[f64], rate_rad_s: f64, momentum_n_m_s: impl Fn(f64) -> Vector3<f64>) -> Recording {
    let mut columns = vec![Vec::new(); 7];
    for &t in times_s {
        // Components in the turned axes; q = (0, 0, sin, cos) of half the angle.
        let angle_rad = rate_rad_s * t;
        let body = Rotation3::from_axis_angle(&Vector3::z_axis(), -angle_rad) * momentum_n_m_s(t);
        let q = [0.0, 0.0, (angle_rad / 2.0).sin(), (angle_rad / 2.0).cos()];
        for (column, value) in columns.iter_mut().zip(q.iter().chain(body.iter())) {
            column.push(*value);
        }
    }
    let names =
        (1..=4).map(|k| format!("attitude.q[{k}]")).chain((1..=3).map(|k| format!("momentum.body[{k}]")));
    Recording {
        times_s: times_s.to_vec(),
        names: names.collect(),
        units: vec![String::new(); 7],
        columns: columns.into_iter().map(Column::Real).collect(),
    }
}

fn seconds(count: u32) -> Vec<f64> {
    (0..=count).map(f64::from).collect()
}

#[test]
fn a_line_and_a_swing_come_apart() {
    let period_s = 100.0;
    let of = |t: f64| Vector3::new(0.02 * t + 0.3 * (TAU * t / period_s).sin(), 0.0, -0.01 * t);
    let simulated = flight(&seconds(4000), 0.0, of);
    let row = Histories::new(&simulated, false).unwrap().by_source(period_s, 200.0).remove(0);
    assert_eq!(row.source, "body");
    assert!((row.secular_per_orbit_n_m_s - Vector3::new(2.0, 0.0, -1.0)).norm() < 1e-9);
    assert!((row.cyclic_in_orbit_n_m_s - Vector3::new(0.3, 0.0, 0.0)).norm() < 1e-9);
    assert!((row.gathered_n_m_s.z - 2.0).abs() < 1e-9);
}

/// Torque of constant strength: along an inertial axis every body axis of the plane gathers torque times span, fixed in
/// the body the chord of the circle that momentum draws.
#[test]
fn momentum_of_a_turning_body_does_not_grow_with_the_flight() {
    let (rate_rad_s, torque_n_m, span_s) = (TAU / 1000.0, 0.01, 250.0);
    let inertial = |t: f64| Vector3::new(torque_n_m * t, 0.0, 0.0);
    // The integral of a torque along body X.
    let fixed_in_body = |t: f64| {
        let (sine, cosine) = (rate_rad_s * t).sin_cos();
        Vector3::new(sine, 1.0 - cosine, 0.0) * (torque_n_m / rate_rad_s)
    };
    for seconds in [2_000, 20_000].map(seconds) {
        let of = |momentum: &dyn Fn(f64) -> Vector3<f64>| {
            Histories::new(&flight(&seconds, rate_rad_s, momentum), false).unwrap().gathered_n_m_s(span_s)
        };
        let expected = Vector3::new(torque_n_m * span_s, torque_n_m * span_s, 0.0);
        assert!((of(&inertial) - expected).norm() < 1e-9);
        // Of a quarter of a turn in the axes at its end: sin and 1 - cos of it.
        let expected = Vector3::new(1.0, 1.0, 0.0) * (torque_n_m / rate_rad_s);
        assert!((of(&fixed_in_body) - expected).norm() < 1e-9, "{}", of(&fixed_in_body));
    }
}

#[test]
fn the_largest_of_the_windows_is_that_of_all_pairs() {
    let times_s: Vec<f64> = (0..300).map(|k| f64::from(k) * 1.5).collect();
    let of = |t: f64| Vector3::new((0.37 * t).sin() * (1.0 + 0.01 * t), 0.004 * t, (0.05 * t).cos());
    let histories = Histories::new(&flight(&times_s, 0.03, of), false).unwrap();
    for span_s in [0.0, 1.5, 7.5, 60.0, 1e4] {
        let mut expected = [0.0_f64; 3];
        for (a, &begin_s) in times_s.iter().enumerate() {
            for &end_s in times_s[a..].iter().filter(|end_s| **end_s - begin_s <= span_s) {
                let (sine, cosine) = (0.03 * end_s).sin_cos();
                let d = of(end_s) - of(begin_s);
                let body = [cosine * d.x + sine * d.y, cosine * d.y - sine * d.x, d.z];
                expected = [0, 1, 2].map(|axis| expected[axis].max(f64::abs(body[axis])));
            }
        }
        let found = histories.gathered_n_m_s(span_s);
        assert!((found - Vector3::from(expected)).norm() < 1e-12, "{span_s}: {found} {expected:?}");
    }
}

/// Integrals of body components are vectors of no frame.
#[test]
fn body_integrals_are_taken_as_they_are() {
    let simulated = flight(&seconds(1000), 0.05, |t| Vector3::new(0.01 * t, 0.0, 0.0));
    let largest = Histories::new(&simulated, true).unwrap().gathered_n_m_s(1e9);
    let x = simulated.column("momentum.body[1]").unwrap().numbers();
    let [low, high] = [f64::min, f64::max].map(|of| x.iter().copied().reduce(of).unwrap());
    assert!((largest.x - (high - low)).abs() < 1e-12);
}
