//! Impulse of pulses against the area of a trapezoid, and ramps that are cut short.
use super::*;
use approx::assert_relative_eq;

const TIMING: ValveTiming = ValveTiming { min_on_s: 0.0, rise_s: 0.01, tail_off_s: 0.03 };

/// Area under the thrust of a valve that is open from 1 s to `close_s`, by the trapezoidal rule between its edges.
fn area(close_s: f64) -> f64 {
    let mut valve = Valve::default();
    let (mut sum, mut now_s) = (0.0, 0.0);
    let mut edges = vec![(1.0, true), (close_s, false)];
    loop {
        let edge_s = edges.first().map_or(f64::INFINITY, |edge| edge.0);
        let next_s = edge_s.min(valve.ramp_end_s(&TIMING));
        if next_s.is_infinite() {
            return sum;
        }
        let [from, slope] = valve.thrust(&TIMING, now_s);
        let span_s = next_s - now_s;
        sum += (from + 0.5 * slope * span_s) * span_s;
        now_s = next_s;
        if edge_s <= now_s {
            let (_, opens) = edges.remove(0);
            if opens {
                valve.open(&TIMING, now_s, 0.0, 0, 0);
            } else {
                valve.close(&TIMING, now_s);
            }
        } else {
            valve.end_ramp(now_s);
        }
    }
}

#[test]
fn a_pulse_is_a_trapezoid() {
    for on_s in [0.01, 0.02, 1.0, 100.0] {
        assert_relative_eq!(area(1.0 + on_s), TIMING.full_thrust_s(on_s), max_relative = 1e-11);
        assert_relative_eq!(TIMING.on_s(TIMING.full_thrust_s(on_s)), on_s, max_relative = 1e-12);
    }
    // Closed halfway up: the triangle of the rise and that of a tail-off from there.
    assert_relative_eq!(area(1.005), 0.5 * 0.5 * (0.005 + 0.015), max_relative = 1e-11);
}

#[test]
fn pulses_scatter_by_their_number_alone() {
    let timing = ValveTiming::default();
    let draws = |scatter: f64| {
        let mut valve = Valve::default();
        let pulse = |k: u32| {
            valve.open(&timing, f64::from(k), scatter, 3, 7);
            let [thrust, _] = valve.thrust(&timing, f64::from(k) + 0.1);
            valve.close(&timing, f64::from(k) + 0.2);
            thrust
        };
        (0..4000).map(pulse).collect::<Vec<_>>()
    };
    let (scattered, exact) = (draws(0.02), draws(0.0));
    assert!(exact.iter().all(|thrust| *thrust == 1.0));
    let mean = scattered.iter().sum::<f64>() / 4000.0;
    let square = scattered.iter().map(|it| (it - 1.0).powi(2)).sum::<f64>() / 4000.0;
    assert!((mean - 1.0).abs() < 4.0 * 0.02 / 4000f64.sqrt(), "{mean}");
    assert_relative_eq!(square.sqrt(), 0.02, max_relative = 0.05);
    assert_eq!(scattered, draws(0.02));
}
