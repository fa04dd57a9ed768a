//! The paper's numbers, the corrected envelopes and the bounds of tapered trains.

use approx::assert_relative_eq;
use std::f64::consts::PI;

use super::{paper_spin, tapered_bound_rad, train, uniform_train_rad};
use crate::spin::{
    forecast::{ForecastCase, Range, Timing},
    nutation::{Spin, allowed_nutation_rad, exact_envelope_rad, period_variation_s},
    tracker::{observation_time_eq20_s, observation_time_s},
    train::{Shape, Train, TrainError},
};

const TORQUE_N_M: f64 = 4.448 * 0.40;

/// A radial thruster on a spinner whose rate is known.
fn case(spin: Spin, timing: Timing) -> ForecastCase {
    ForecastCase { spin, assumed_rate_rad_s: spin.rate_rad_s, timing, torque_n_m: TORQUE_N_M }
}

#[test]
fn the_papers_numbers_come_out() {
    let spin = paper_spin(1.483);
    assert!((spin.manoeuvre_rad(TORQUE_N_M, 1.0) - 0.0095).abs() < 5e-5);
    assert!((spin.manoeuvre_rad(TORQUE_N_M, 0.032).to_degrees() - 0.0176).abs() < 5e-5);
    let radial = 2.0 / spin.manoeuvre_rad(TORQUE_N_M, 0.032).to_degrees();
    assert_eq!(radial.ceil(), 114.0);
    let axial = 2.0 / spin.manoeuvre_rad(4.448 * 0.78, 0.032).to_degrees();
    assert!((axial - 58.0).abs() < 1.0, "{axial}");
    // Envelopes of the notes with n = 113 and 58.
    let gamma = 2.0_f64.to_radians();
    for (n, turns, exact) in
        [(113.0, 0.5, 0.02439), (113.0, 1.0, 0.01772), (58.0, 0.5, 0.04752), (58.0, 1.0, 0.03453)]
    {
        let kick = gamma / n;
        let got = exact_envelope_rad(kick, spin.phase_advance_rad(turns)).to_degrees();
        assert!((got - exact).abs() < 6e-6, "exact {got} against {exact}");
    }
    // Eq 1: 7 ms allow 0.038 deg at 20 deg, 0.0018 deg at 1 deg.
    let allowed = |beta: f64| allowed_nutation_rad(0.007, PI / 6.0, beta.to_radians()).to_degrees();
    assert!((allowed(20.0) - 0.0382).abs() < 5e-5 && (allowed(1.0) - 0.0018).abs() < 5e-5);
    assert_relative_eq!(
        period_variation_s(allowed(20.0).to_radians(), PI / 6.0, 20.0_f64.to_radians()),
        0.007,
        max_relative = 1e-12
    );
}

#[test]
fn observation_takes_11_76_min_by_eq_20_and_the_spin_rate_drops_out_of_sampling_by_spins() {
    let rpm = PI / 30.0;
    assert!((observation_time_eq20_s(5.0 * rpm, 1.483) / 60.0 - 11.76).abs() < 0.01);
    // By the clock, exactly: the same where the rate is nominal, near it elsewhere.
    let clock = |rate: f64, ratio: f64| observation_time_s(96.0, ratio * rate);
    assert_relative_eq!(
        clock(5.0 * rpm, 1.483),
        observation_time_eq20_s(5.0 * rpm, 1.483),
        max_relative = 1e-9
    );
    let spins = |rate: f64| observation_time_s(8.0 * 2.0 * PI / rate, 1.483 * rate);
    assert_relative_eq!(spins(4.9 * rpm) * 4.9, spins(5.1 * rpm) * 5.1, max_relative = 1e-9);
    // About 21 per cent of the range needs more than 30 min by eq 20.
    let mut slow = 0;
    for i in 0..400 {
        for j in 0..400 {
            let rate = (4.9 + 0.2 * (f64::from(i) + 0.5) / 400.0) * rpm;
            let ratio = 1.471 + 0.023 * (f64::from(j) + 0.5) / 400.0;
            slow += i32::from(observation_time_eq20_s(rate, ratio) > 1800.0);
        }
    }
    let share = f64::from(slow) / 160_000.0;
    assert!((share - 0.21).abs() < 0.01, "{share}");
}

#[test]
fn a_tapered_train_stays_under_its_bound_at_any_length() {
    let spin = paper_spin(1.483);
    let q = spin.nutation_kick_rad(TORQUE_N_M, 0.032);
    for (ratio, notes_deg) in [(1.471, 0.0032), (1.483, 0.0019), (1.494, 0.0007)] {
        let bound = tapered_bound_rad(q, 2.0 * PI * ratio, 1).to_degrees();
        assert!((bound - notes_deg).abs() < 6e-5, "{ratio}: {bound}");
        for order in 1..=4 {
            for count in 2 * order + 1..80 {
                let spin = paper_spin(ratio);
                let train = train(Shape::Tapered { order }, count, 0.032, 1.0, &spin).unwrap();
                let flight = case(spin, Timing::Clock);
                let end = flight.forecast(&train).final_nutation_rad;
                let bound = tapered_bound_rad(q, 2.0 * PI * ratio, order);
                // Whole steps of width have the whole multiples of the kick to 1e-4 only.
                assert!(
                    end <= bound * 1.001 + 2e-4 * q * f64::from(1_u32 << order),
                    "{ratio} {order} {count}"
                );
            }
        }
    }
}

#[test]
fn forecasts_of_uniform_trains_are_eq_8() {
    for turns in [0.5, 1.0, 1.5, 2.0] {
        for count in [1, 2, 17, 114] {
            let spin = paper_spin(1.479);
            let train = train(Shape::Uniform, count, 0.064, turns, &spin).unwrap();
            let flight = case(spin, Timing::Clock);
            let seen = flight.forecast(&train);
            let kick = spin.nutation_kick_rad(TORQUE_N_M, 0.064);
            let expected = uniform_train_rad(kick, spin.phase_advance_rad(turns), count);
            assert_relative_eq!(seen.final_nutation_rad, expected, max_relative = 1e-8, epsilon = 1e-15);
            assert_relative_eq!(
                seen.moved_rad,
                f64::from(count) * spin.manoeuvre_rad(TORQUE_N_M, 0.064),
                max_relative = 1e-12
            );
        }
    }
}

/// Greatest final and peak nutation of a scan two thousand times as fine as the ranges are wide.
fn scanned(flight: &ForecastCase, range: &Range, train: &Train) -> [f64; 2] {
    let mut finest = [0.0_f64; 2];
    for i in 0..=2_000 {
        for j in 0..=2_000 {
            // Along the ratio, along the rate, and with both free on a coarser grid.
            if i % 40 != 0 && j % 40 != 0 {
                continue;
            }
            let mut other = *flight;
            other.spin.ratio += range.ratio * (f64::from(i) / 1_000.0 - 1.0);
            other.spin.rate_rad_s += range.rate_rad_s * (f64::from(j) / 1_000.0 - 1.0);
            let seen = other.forecast(train);
            finest = [finest[0].max(seen.final_nutation_rad), finest[1].max(seen.peak_nutation_rad)];
            if range.rate_rad_s == 0.0 {
                break;
            }
        }
    }
    finest
}

#[test]
fn the_worst_of_a_range_is_what_a_fine_scan_finds() {
    let spin = paper_spin(1.4825);
    let known = Range { ratio: 0.0115, rate_rad_s: 0.0 };
    let vague = Range { ratio: 0.06, rate_rad_s: 0.0 };
    let mut cases = Vec::new();
    for count in [6, 17, 29, 58, 114, 300] {
        for turns in [0.5, 1.0, 1.5] {
            for range in [known, vague] {
                let shapes =
                    [Shape::Uniform, Shape::Tapered { order: 1 }, Shape::Tapered { order: 3 }, Shape::Split];
                for shape in shapes {
                    cases.extend(
                        train(shape, count, 0.032, turns, &spin)
                            .map(|train| (train, range, Timing::TruePhase)),
                    );
                }
            }
        }
    }
    // By the clock the rate counts as much as the ratio, alone or with it.
    for (ratio, rate) in [(0.0, 0.02), (0.0115, 0.002)] {
        let range = Range { ratio, rate_rad_s: rate * spin.rate_rad_s };
        let train = train(Shape::Uniform, 40, 0.032, 1.0, &spin).unwrap();
        cases.extend([Timing::Clock, Timing::SunCrossing].map(|timing| (train, range, timing)));
    }
    for (train, range, timing) in cases {
        let flight = case(spin, timing);
        let worst = range.worst(&flight, &train);
        let found = [worst.final_nutation_rad, worst.peak_nutation_rad];
        for (found, finest) in found.into_iter().zip(scanned(&flight, &range, &train)) {
            let ratio = found / finest;
            assert!(
                (1.0 - 1e-3..1.0 + 1e-3).contains(&ratio),
                "{ratio}: {:?} {} {} {range:?} {timing:?}",
                train.shape,
                train.count,
                train.turns_per_pulse()
            );
        }
    }
}

#[test]
fn trains_that_make_no_sense_are_refused() {
    let spin = paper_spin(1.483);
    let make = |shape, count, width, turns| train(shape, count, width, turns, &spin);
    assert!(matches!(make(Shape::Uniform, 5, 0.032, 0.7), Err(TrainError::Turns { .. })));
    assert!(matches!(make(Shape::Uniform, 5, 0.032, f64::NAN), Err(TrainError::Turns { .. })));
    assert!(matches!(make(Shape::Uniform, 0, 0.032, 1.0), Err(TrainError::Count { .. })));
    assert!(matches!(make(Shape::Uniform, 5, -1.0, 1.0), Err(TrainError::Width { .. })));
    assert!(matches!(make(Shape::Tapered { order: 1 }, 1, 0.032, 1.0), Err(TrainError::Count { .. })));
    assert!(matches!(make(Shape::Tapered { order: 9 }, 50, 0.032, 1.0), Err(TrainError::Count { .. })));
    assert!(matches!(make(Shape::Split, 5, 0.032, 1.0), Err(TrainError::Count { .. })));
    // Sixty-four times the kick of a 2 s pulse is more than any pulse has.
    assert!(matches!(make(Shape::Tapered { order: 6 }, 50, 2.0, 1.0), Err(TrainError::Width { .. })));
}
