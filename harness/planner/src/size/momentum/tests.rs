//! Windows against closed forms of a turning body and against all pairs of rows.
use core::f64::consts::TAU;

use fmi::Column;
use nalgebra::Rotation3;

use super::*;

/// A flight whose body turns about inertial Z at `rate_rad_s`, with momentum of one source in EME2000.
fn flight(times_s: &[f64], rate_rad_s: f64, momentum_n_m_s: impl Fn(f64) -> Vector3<f64>) -> Recording {
    let mut columns = vec![Vec::new(); 13];
    for &t in times_s {
        // Components in the turned axes; q = (0, 0, sin, cos) of half the angle.
        let angle_rad = rate_rad_s * t;
        let body = Rotation3::from_axis_angle(&Vector3::z_axis(), -angle_rad) * momentum_n_m_s(t);
        let q = [0.0, 0.0, (angle_rad / 2.0).sin(), (angle_rad / 2.0).cos()];
        let others = [1e-3, 0.0, 2e-3, 0.0, 0.0, rate_rad_s];
        for (column, value) in columns.iter_mut().zip(q.iter().chain(body.iter()).chain(&others)) {
            column.push(*value);
        }
    }
    let names =
        (1..=4).map(|k| format!("attitude.q[{k}]")).chain((1..=3).map(|k| format!("momentum.body[{k}]")));
    let vectors = ["torque.total", "attitude.rate"].into_iter();
    let names = names.chain(vectors.flat_map(|name| (1..=3).map(move |k| format!("{name}[{k}]"))));
    Recording {
        times_s: times_s.to_vec(),
        names: names.collect(),
        units: vec![String::new(); 13],
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
    let row =
        Histories::new(&simulated, false, Vector3::zeros()).unwrap().by_source(period_s, 200.0).remove(0);
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
            Histories::new(&flight(&seconds, rate_rad_s, momentum), false, Vector3::zeros())
                .unwrap()
                .gathered_n_m_s(span_s)
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
    let histories = Histories::new(&flight(&times_s, 0.03, of), false, Vector3::zeros()).unwrap();
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
    let largest = Histories::new(&simulated, true, Vector3::zeros()).unwrap().gathered_n_m_s(1e9);
    let x = simulated.column("momentum.body[1]").unwrap().numbers();
    let [low, high] = [f64::min, f64::max].map(|of| x.iter().copied().reduce(of).unwrap());
    assert!((largest.x - (high - low)).abs() < 1e-12);
}

/// A body that turns about Z under a torque along it: the bias along Z stays, one along X has to follow the body, whose wheels take
/// up the chord of its circle; the torque holds what is gathered there and turns the rest.
#[test]
fn a_bias_across_the_rate_is_gathered_as_the_body_turns() {
    let (rate_rad_s, torque_n_m, span_s) = (TAU / 1000.0, 0.01, 250.0);
    let simulated = flight(&seconds(3000), rate_rad_s, |t| Vector3::new(0.0, 0.0, torque_n_m * t));
    let of = |bias| Histories::new(&simulated, false, bias).unwrap();
    let along = of(Vector3::new(0.0, 0.0, 7.0));
    let line = Vector3::new(0.0, 0.0, torque_n_m * span_s);
    assert!((along.gathered_n_m_s(span_s) - line).norm() < 1e-9);
    let across = of(Vector3::new(2.0, 0.0, 0.0));
    // A quarter of a turn.
    assert!((across.gathered_n_m_s(span_s) - line - Vector3::new(2.0, 2.0, 0.0)).norm() < 1e-9);
    let (unloaded, time_s) = across.unloaded_n_m_s(span_s).unwrap();
    assert_eq!((unloaded.len(), time_s), (12, 3000.0));
    assert!(across.unloaded_n_m_s(3001.0).is_none());
    assert!(unloaded.iter().all(|it| (it - line - Vector3::new(-2.0, -2.0, 0.0)).norm() < 1e-9));
    let torque = along.torque_n_m(Vector3::new(0.0, 3.0, 0.0));
    assert!((torque - Vector3::new(1e-3 + rate_rad_s * 3.0, 0.0, 2e-3)).norm() < 1e-12);
}

#[test]
fn wheels_last_until_the_first_window_that_fills_them() {
    let of = |t: f64| Vector3::new(0.0, if t > 900.0 { 0.02 * (t - 900.0) } else { 0.0 }, 0.001 * t);
    let histories = Histories::new(&flight(&seconds(9000), 0.0, of), false, Vector3::zeros()).unwrap();
    let [limited, by_z] = [[1.0, 4.99, 50.0], [1.0, 5e3, 2.0]].map(Vector3::from);
    assert_eq!(histories.shortest_beyond_s(limited), Some(250.0));
    assert!((histories.shortest_beyond_s(by_z).unwrap() - 2001.0).abs() <= 1.0);
    assert_eq!(histories.shortest_beyond_s(Vector3::repeat(1e3)), None);
}
