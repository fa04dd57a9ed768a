//! The estimator against Farrenkopf's steady state in closed form, random walks in continuous time, and failures.

use nalgebra::Vector3;

use super::{random, random_attitude};
use crate::attitude::Attitude;
use crate::attitude::control::{Estimate, EstimatorState, Gyro, SensorHealth, SensorSettings, StarTracker};

const ALL: SensorHealth = SensorHealth { star_tracker: true, gyro: true };
const NO_TRACKER: SensorHealth = SensorHealth { star_tracker: false, gyro: true };
const NO_GYRO: SensorHealth = SensorHealth { star_tracker: true, gyro: false };
const NONE: SensorHealth = SensorHealth { star_tracker: false, gyro: false };

fn silent() -> SensorSettings {
    SensorSettings {
        star_tracker: StarTracker::default(),
        gyro: Gyro::default(),
        seed: 3,
        interval_s: 0.02,
        acceleration_rad_s2: f64::INFINITY,
        longest_without_tracker_s: 100.0,
    }
}

fn noisy() -> SensorSettings {
    SensorSettings {
        star_tracker: StarTracker { noise_rad: Vector3::repeat(5e-5), interval_s: 1.0 },
        gyro: Gyro {
            angle_random_walk_rad_sqrt_s: 1e-5,
            rate_random_walk_rad_s_sqrt_s: 2e-6,
            initial_bias_rad_s: Vector3::zeros(),
        },
        interval_s: 0.2,
        ..silent()
    }
}

/// A body that turns at a rate which changes slowly.
struct Motion {
    attitude: Attitude,
    rate: Vector3<f64>,
    sample: u64,
}

impl Motion {
    fn new(number: u64) -> Self {
        Self { attitude: random_attitude(number), rate: random(number) * 1e-3, sample: 0 }
    }

    fn sample(
        &mut self,
        state: &mut EstimatorState,
        settings: &SensorSettings,
        health: SensorHealth,
    ) -> Estimate {
        let estimate = state.sample(settings, health, &self.attitude, &self.rate, self.sample);
        assert!(state.is_valid());
        estimate
    }

    fn advance(&mut self, interval_s: f64) {
        let change = random(self.sample / 50) * 1e-6;
        self.attitude = self.attitude.propagated(self.rate + change * 0.5, interval_s).normalized();
        self.rate += change;
        self.sample += 1;
    }
}

fn error(estimate: &Estimate, motion: &Motion) -> Vector3<f64> {
    estimate.attitude.rotation_vector_to(&motion.attitude)
}

#[test]
fn without_noise_the_estimate_is_the_truth() {
    for interval_s in [0.0, 0.02, 1.0] {
        let mut settings = silent();
        settings.star_tracker.interval_s = interval_s;
        let mut motion = Motion::new(1);
        let mut state = EstimatorState::new(&settings, motion.attitude);
        for _ in 0..5000 {
            let estimate = motion.sample(&mut state, &settings, ALL);
            let difference = error(&estimate, &motion).norm();
            if interval_s == 1.0 {
                assert!(difference < 1e-14, "{difference}");
            } else {
                assert_eq!(estimate.attitude, motion.attitude);
            }
            assert_eq!(estimate.rate_body_rad_s, Some(motion.rate));
            assert!(estimate.is_valid);
            motion.advance(settings.interval_s);
        }
    }
}

/// Farrenkopf (1978): variances of angle before and after a fix, of bias before it, and the gains on both.
struct Farrenkopf {
    angle_before: f64,
    angle_after: f64,
    bias_before: f64,
    angle_gain: f64,
    bias_gain: f64,
}

fn farrenkopf(settings: &SensorSettings) -> Farrenkopf {
    let (noise, dt) = (settings.star_tracker.noise_rad.x, settings.star_tracker.interval_s);
    let su = settings.gyro.rate_random_walk_rad_s_sqrt_s * dt.powf(1.5) / noise;
    let sv = settings.gyro.angle_random_walk_rad_sqrt_s * dt.sqrt() / noise;
    let gamma = (1.0 + sv * sv / 4.0 + su * su / 48.0).sqrt();
    let zeta = gamma + su / 4.0 + 0.5 * (2.0 * gamma * su + sv * sv + su * su / 3.0).sqrt();
    Farrenkopf {
        angle_before: noise * noise * (zeta * zeta - 1.0),
        angle_after: noise * noise * (1.0 - 1.0 / (zeta * zeta)),
        bias_before: (noise / dt).powi(2) * su * (zeta - 1.0 / zeta + su / 2.0),
        angle_gain: 1.0 - 1.0 / (zeta * zeta),
        bias_gain: -su / (zeta * dt),
    }
}

#[test]
fn the_spread_of_errors_is_farrenkopfs() {
    let settings = noisy();
    let expected = farrenkopf(&settings);
    let mut motion = Motion { rate: Vector3::zeros(), ..Motion::new(2) };
    let mut state = EstimatorState::new(&settings, motion.attitude);
    let (mut after, mut before, mut bias, mut count) = (0.0, 0.0, 0.0, 0.0);
    for sample in 0..1_000_000_u64 {
        let estimate = motion.sample(&mut state, &settings, ALL);
        let is_fix = sample % 5 == 0;
        if sample > 5000 && is_fix {
            after += error(&estimate, &motion).norm_squared();
            count += 3.0;
        }
        if sample > 5000 && sample % 5 == 4 {
            // One gyro sample before the fix: the angle grows by a fifth of the interval's share until then.
            before += error(&estimate, &motion).norm_squared();
            let rate = estimate.rate_body_rad_s.unwrap();
            bias += rate.norm_squared();
        }
        motion.sample += 1;
    }
    let rate_noise = settings.gyro.angle_random_walk_rad_sqrt_s.powi(2) / settings.interval_s;
    let [after, before, bias] = [after, before, bias].map(|sum| sum / count);
    assert!((after / expected.angle_after - 1.0).abs() < 0.03, "{after} {}", expected.angle_after);
    let late = expected.angle_after + 0.8 * (expected.angle_before - expected.angle_after);
    assert!((before / late - 1.0).abs() < 0.03, "{before} {late}");
    let bias = bias - rate_noise;
    assert!((bias / expected.bias_before - 1.0).abs() < 0.08, "{bias} {}", expected.bias_before);
}

#[test]
fn an_error_of_the_bias_decays_with_farrenkopfs_gains() {
    // Two gyros whose bias differs and nothing else: what differs in their estimates has no noise.
    let settings = noisy();
    let gains = farrenkopf(&settings);
    let bias = |sign: f64| {
        let gyro = Gyro { initial_bias_rad_s: Vector3::new(1e-6, 2e-6, -3e-6) * sign, ..settings.gyro };
        SensorSettings { gyro, ..settings }
    };
    let attitude = random_attitude(5);
    let mut states = [1.0, -1.0].map(|sign| EstimatorState::new(&bias(sign), attitude));
    let mut differences: Vec<[f64; 2]> = Vec::new();
    for sample in 0..5 * 200_u64 {
        let [a, b] = [0, 1]
            .map(|which: usize| states[which].sample(&settings, ALL, &attitude, &Vector3::zeros(), sample));
        if sample % 5 == 0 {
            let angle = a.attitude.rotation_vector_to(&b.attitude).x;
            differences.push([angle, (b.rate_body_rad_s.unwrap() - a.rate_body_rad_s.unwrap()).x]);
        }
    }
    // Angle and rate error from fix to fix with the steady gains, once the covariance has settled.
    let [mut angle, mut rate] = differences[60];
    let scale = angle.abs();
    for [found_angle, found_rate] in &differences[61..75] {
        let before = angle + rate * settings.star_tracker.interval_s;
        angle = before * (1.0 - gains.angle_gain);
        rate += gains.bias_gain * before;
        assert!((found_angle - angle).abs() < 1e-3 * scale, "{found_angle} {angle}");
        assert!((found_rate - rate).abs() < 1e-3 * scale, "{found_rate} {rate}");
    }
    let [first, last] = [differences[3], differences[199]];
    assert!(last[0].abs() < 1e-6 * first[0].abs().max(1e-8) && last[1].abs() < 1e-6 * first[1].abs());
}

#[test]
fn a_constant_bias_is_found() {
    let mut settings = noisy();
    settings.gyro.rate_random_walk_rad_s_sqrt_s = 0.0;
    settings.gyro.initial_bias_rad_s = Vector3::new(2e-5, -1e-5, 4e-5);
    let mut motion = Motion::new(7);
    let mut state = EstimatorState::new(&settings, motion.attitude);
    settings.gyro.angle_random_walk_rad_sqrt_s = 0.0;
    let mut last = Vector3::zeros();
    for _ in 0..100_000 {
        let estimate = motion.sample(&mut state, &settings, ALL);
        last = estimate.rate_body_rad_s.unwrap() - motion.rate;
        motion.advance(settings.interval_s);
    }
    assert!(last.norm() < 1e-8, "{last}");
}

#[test]
fn gyros_alone_walk_as_in_continuous_time() {
    let mut settings = noisy();
    settings.longest_without_tracker_s = 1e6;
    let (samples, runs) = (200_u32, 2000_u64);
    let mut square = 0.0;
    for seed in 0..runs {
        settings.seed = seed;
        let attitude = random_attitude(1);
        let mut state = EstimatorState::new(&settings, attitude);
        let mut last = None;
        for sample in 0..=samples {
            last = Some(state.sample(&settings, NO_TRACKER, &attitude, &Vector3::zeros(), u64::from(sample)));
        }
        square += last.unwrap().attitude.rotation_vector_to(&attitude).norm_squared() / (3 * runs) as f64;
    }
    let time_s = f64::from(samples) * settings.interval_s;
    let expected = settings.gyro.angle_random_walk_rad_sqrt_s.powi(2) * time_s
        + settings.gyro.rate_random_walk_rad_s_sqrt_s.powi(2) * time_s.powi(3) / 3.0;
    // Four standard errors of a variance from 6000 numbers.
    assert!((square / expected - 1.0).abs() < 4.0 * (2.0_f64 / 6000.0).sqrt(), "{square} {expected}");
}

#[test]
fn tracker_noise_differs_by_axis() {
    let mut settings = silent();
    settings.star_tracker.noise_rad = Vector3::new(1e-5, 2e-5, 8e-5);
    let attitude = random_attitude(2);
    let mut state = EstimatorState::new(&settings, attitude);
    let draws = 20_000_u32;
    let (mut square, mut rate_square) = (Vector3::zeros(), Vector3::zeros());
    for sample in 0..draws {
        let estimate = state.sample(&settings, NO_GYRO, &attitude, &Vector3::zeros(), u64::from(sample));
        let error = attitude.rotation_vector_to(&estimate.attitude);
        square += error.component_mul(&error) / f64::from(draws);
        let rate = estimate.rate_body_rad_s.unwrap_or_default();
        rate_square += rate.component_mul(&rate) / f64::from(draws);
    }
    let variance = settings.star_tracker.noise_rad.component_mul(&settings.star_tracker.noise_rad);
    assert!((square.component_div(&variance)).add_scalar(-1.0).amax() < 0.05, "{square}");
    // Any acceleration: the attitude is the measured one, the rate that of an alpha-beta filter with alpha = 1 and, by
    // Farrenkopf's gain for a random walk without bound, beta = 3 - sqrt(3): v' = (1 - beta) v + beta (z' - z) / T.
    let beta = 3.0 - 3.0_f64.sqrt();
    let of_rate = variance * (2.0 * beta * beta / (2.0 - beta) / settings.interval_s.powi(2));
    assert!((rate_square.component_div(&of_rate)).add_scalar(-1.0).amax() < 0.06, "{rate_square}");
}

#[test]
fn without_the_tracker_the_attitude_is_known_for_a_while() {
    let mut settings = silent();
    settings.longest_without_tracker_s = 10.0;
    let mut motion = Motion::new(3);
    let mut state = EstimatorState::new(&settings, motion.attitude);
    for sample in 0..2000_u64 {
        let health = if (100..1500).contains(&sample) { NO_TRACKER } else { ALL };
        let estimate = motion.sample(&mut state, &settings, health);
        // The last fix was at sample 99; 10 s are 500 samples.
        assert_eq!(estimate.is_valid, !(600..1500).contains(&sample), "{sample}");
        assert_eq!(estimate.rate_body_rad_s, Some(motion.rate));
        assert!(error(&estimate, &motion).norm() < 1e-12);
        motion.advance(settings.interval_s);
    }
}

#[test]
fn without_gyros_the_rate_comes_from_the_tracker() {
    for per_fix in [1, 10_u64] {
        let mut settings = silent();
        settings.star_tracker.interval_s = settings.interval_s * per_fix as f64;
        let mut motion = Motion::new(4);
        let mut state = EstimatorState::new(&settings, motion.attitude);
        for sample in 0..1000_u64 {
            let health = if sample < 300 { ALL } else { NO_GYRO };
            let estimate = motion.sample(&mut state, &settings, health);
            assert!(estimate.is_valid);
            // The mean over the time since the fix before last: the rate changes by 1e-6 rad/s a sample at most.
            let lag = 4e-6 * per_fix as f64;
            assert!((estimate.rate_body_rad_s.unwrap() - motion.rate).norm() < lag * 2.0);
            assert!(error(&estimate, &motion).norm() < lag * 2.0 * settings.star_tracker.interval_s);
            motion.advance(settings.interval_s);
        }
    }
}

/// Of a still body, in the steady state of an alpha-beta filter with Farrenkopf's gains (Bar-Shalom et al., 6.5.3): the rate's
/// variance is 2 beta^2 / (alpha (4 - 2 alpha - beta)) of that of the measured angle over the interval.
#[test]
fn without_gyros_the_noise_of_the_rate_is_a_filters() {
    for acceleration_rad_s2 in [1e-6, 1e-5, 1e-4] {
        let settings = SensorSettings { acceleration_rad_s2, ..noisy() };
        let (noise_rad, interval_s) = (settings.star_tracker.noise_rad.x, settings.star_tracker.interval_s);
        let gyro = Gyro {
            angle_random_walk_rad_sqrt_s: 0.0,
            rate_random_walk_rad_s_sqrt_s: acceleration_rad_s2 * interval_s.sqrt(),
            ..settings.gyro
        };
        let gains = farrenkopf(&SensorSettings { gyro, ..settings });
        let (alpha, beta) = (gains.angle_gain, -gains.bias_gain * interval_s);
        let share = 2.0 * beta * beta / (alpha * (4.0 - 2.0 * alpha - beta));
        let expected = share * (noise_rad / interval_s).powi(2);
        let attitude = random_attitude(14);
        let mut state = EstimatorState::new(&settings, attitude);
        let (mut square, mut count) = (0.0, 0.0);
        for sample in 0..500_000_u64 {
            let health = if sample < 50 { ALL } else { NO_GYRO };
            let estimate = state.sample(&settings, health, &attitude, &Vector3::zeros(), sample);
            assert!(estimate.is_valid);
            if sample > 5000 && sample.is_multiple_of(5) {
                square += estimate.rate_body_rad_s.unwrap().norm_squared();
                count += 3.0;
            }
        }
        let found = square / count;
        assert!((found / expected - 1.0).abs() < 0.1, "{acceleration_rad_s2}: {found} {expected}");
        // A difference of two measurements has twice the variance of one, whatever the acceleration.
        let of_difference = 2.0 * (noise_rad / interval_s).powi(2);
        assert!(found < 0.5 * of_difference, "{acceleration_rad_s2}: {found} {of_difference}");
    }
}

#[test]
fn without_gyros_from_the_start_the_second_fix_gives_the_rate() {
    let mut settings = SensorSettings { acceleration_rad_s2: 1e-4, ..noisy() };
    settings.star_tracker.noise_rad = Vector3::repeat(1e-9);
    let rate = Vector3::new(1e-3, -2e-3, 5e-4);
    let mut motion = Motion { rate, ..Motion::new(15) };
    let mut state = EstimatorState::new(&settings, motion.attitude);
    for sample in 0..50_u64 {
        let estimate = motion.sample(&mut state, &settings, NO_GYRO);
        // Fixes at samples 0 and 5.
        assert_eq!(estimate.rate_body_rad_s.is_some(), sample >= 5, "{sample}");
        assert_eq!(estimate.is_valid, sample == 0 || sample >= 5, "{sample}");
        if let Some(found) = estimate.rate_body_rad_s {
            assert!((found - rate).norm() < 1e-7, "{sample}: {}", found - rate);
            assert!(error(&estimate, &motion).norm() < 1e-7);
        }
        motion.attitude = motion.attitude.propagated(rate, settings.interval_s).normalized();
        motion.sample += 1;
    }
}

#[test]
fn without_both_nothing_is_known_until_a_fix() {
    let mut settings = silent();
    settings.star_tracker.interval_s = 0.2;
    let mut motion = Motion::new(6);
    let mut state = EstimatorState::new(&settings, motion.attitude);
    for sample in 0..1000_u64 {
        let health = match sample {
            0..100 => ALL,
            100..200 => NONE,
            200..305 => NO_TRACKER,
            _ => ALL,
        };
        let estimate = motion.sample(&mut state, &settings, health);
        // The first fix after the outage is at sample 310.
        assert_eq!(estimate.is_valid, !(100..310).contains(&sample), "{sample}");
        assert_eq!(estimate.rate_body_rad_s, (!(100..200).contains(&sample)).then_some(motion.rate));
        if estimate.is_valid {
            assert!(error(&estimate, &motion).norm() < 1e-13);
        }
        motion.advance(settings.interval_s);
    }
}

#[test]
fn the_first_fix_after_an_outage_of_both_is_taken_as_it_is() {
    let settings = noisy();
    let attitude = random_attitude(8);
    let mut state = EstimatorState::new(&settings, attitude);
    for sample in 0..1000_u64 {
        state.sample(&settings, ALL, &attitude, &Vector3::zeros(), sample);
    }
    // The body turns while nothing measures.
    let turned = attitude.turned(Vector3::new(0.4, -0.3, 0.2));
    state.sample(&settings, NONE, &turned, &Vector3::zeros(), 1000);
    for sample in 1001..1006 {
        let estimate = state.sample(&settings, ALL, &turned, &Vector3::zeros(), sample);
        assert_eq!(estimate.is_valid, sample == 1005);
        let error = estimate.attitude.rotation_vector_to(&turned).norm();
        assert_eq!(error < 5.0 * settings.star_tracker.noise_rad.norm(), estimate.is_valid, "{error}");
    }
}

#[test]
fn a_restored_state_goes_on_to_the_bit() {
    let settings = noisy();
    let mut motion = Motion::new(9);
    let mut state = EstimatorState::new(&settings, motion.attitude);
    for _ in 0..333 {
        motion.sample(&mut state, &settings, ALL);
        motion.advance(settings.interval_s);
    }
    let mut restored: EstimatorState = toml::from_str(&toml::to_string(&state).unwrap()).unwrap();
    for _ in 0..333 {
        let (first, second) =
            (motion.sample(&mut state, &settings, ALL), motion.sample(&mut restored, &settings, ALL));
        assert_eq!(first, second);
        motion.advance(settings.interval_s);
    }
}
