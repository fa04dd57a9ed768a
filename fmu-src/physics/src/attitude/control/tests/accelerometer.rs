//! Accelerometers against the statistics of their errors, seed by seed and sample by sample.

use nalgebra::Vector3;

use super::super::{AccelerometerSettings, AccelerometerState};

const INTERVAL_S: f64 = 0.02;

const SEEDS: u32 = 2000;

/// Error of the sum after `count` samples of the acceleration `true_m_s2`, in m/s.
fn error_m_s(settings: &AccelerometerSettings, true_m_s2: &Vector3<f64>, count: u64) -> Vector3<f64> {
    let mut state = AccelerometerState::new(settings);
    for number in 0..count {
        state.sample(settings, &(true_m_s2 * INTERVAL_S), INTERVAL_S, number);
    }
    state.delta_v_body_m_s() - true_m_s2 * (INTERVAL_S * count as f64)
}

/// Standard deviation of that error over seeds and axes, and its mean.
fn deviation_m_s(settings: AccelerometerSettings, true_m_s2: f64, count: u64) -> (f64, f64) {
    let (mut square, mut mean) = (0.0, 0.0);
    for seed in 1..=SEEDS {
        let settings = AccelerometerSettings { seed: u64::from(seed), ..settings };
        let error = error_m_s(&settings, &Vector3::repeat(true_m_s2), count);
        square += error.norm_squared() / f64::from(3 * SEEDS);
        mean += error.sum() / f64::from(3 * SEEDS);
    }
    (square.sqrt(), mean)
}

/// The deviation found of 6000 draws lies within four standard errors of what is expected, their mean of 0.
fn assert_deviation(settings: AccelerometerSettings, true_m_s2: f64, count: u64, expected_m_s: f64) {
    let (found, mean) = deviation_m_s(settings, true_m_s2, count);
    let draws = f64::from(3 * SEEDS);
    assert!(
        (found / expected_m_s - 1.0).abs() < 4.0 / (2.0 * draws).sqrt(),
        "{found} m/s, expected {expected_m_s}"
    );
    assert!(mean.abs() < 4.0 * expected_m_s / draws.sqrt(), "{mean} m/s");
}

#[test]
fn without_errors_the_sum_is_the_velocity() {
    let settings = AccelerometerSettings::default();
    let error = error_m_s(&settings, &Vector3::new(0.088, -0.01, 0.3), 5000);
    assert!(error.amax() < 1e-12, "{error}");
}

#[test]
fn bias_grows_with_time_and_scale_with_velocity() {
    let count = 50;
    let (time_s, none) = (count as f64 * INTERVAL_S, AccelerometerSettings::default());
    let bias = AccelerometerSettings { bias_m_s2: 1.5e-5, ..none };
    assert_deviation(bias, 0.0, count, 1.5e-5 * time_s);
    assert_deviation(bias, 0.088, 4 * count, 1.5e-5 * time_s * 4.0);
    let scale = AccelerometerSettings { scale: 1e-4, ..none };
    assert_deviation(scale, 0.088, count, 1e-4 * 0.088 * time_s);
    assert_eq!(error_m_s(&scale, &Vector3::zeros(), count), Vector3::zeros());
}

#[test]
fn noise_grows_with_the_root_of_time_and_drift_with_its_power_of_three_halves() {
    let none = AccelerometerSettings::default();
    let noise = AccelerometerSettings { noise_m_s2: 1e-4, ..none };
    assert_deviation(noise, 0.0, 25, 1e-4 * INTERVAL_S * 5.0);
    // Of a random walk's sum: its n steps count n, n-1 ... 1 times.
    let drift = AccelerometerSettings { drift_m_s2_sqrt_s: 1e-5, ..none };
    let count = 100_u64;
    let squares: u64 = (1..=count).map(|n| n * n).sum();
    assert_deviation(drift, 0.0, count, 1e-5 * INTERVAL_S.powf(1.5) * (squares as f64).sqrt());
}

#[test]
fn errors_of_different_kinds_seeds_and_axes_are_independent() {
    let none = AccelerometerSettings { seed: 3, ..AccelerometerSettings::default() };
    let kinds = [
        AccelerometerSettings { bias_m_s2: 1.0, ..none },
        AccelerometerSettings { bias_m_s2: 1.0, seed: 4, ..none },
        AccelerometerSettings { scale: 1.0, ..none },
        AccelerometerSettings { noise_m_s2: 1.0, ..none },
        AccelerometerSettings { drift_m_s2_sqrt_s: 1.0, ..none },
    ];
    let mut found: Vec<u64> = Vec::new();
    for settings in &kinds {
        let error = error_m_s(settings, &Vector3::repeat(1.0), 1);
        found.extend(error.iter().map(|x| (x * 1e6).round().abs() as u64));
    }
    let count = found.len();
    found.sort_unstable();
    found.dedup();
    assert_eq!(found.len(), count);
    assert_eq!(error_m_s(&kinds[0], &Vector3::zeros(), 9), error_m_s(&kinds[0], &Vector3::zeros(), 9));
}
