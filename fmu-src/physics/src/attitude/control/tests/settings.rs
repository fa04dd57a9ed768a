//! Stability of the sampled loop against the eigenvalues of its transition matrix.

use nalgebra::Matrix3;

use crate::attitude::control::{ControllerSettings, GainError};

fn settings(bandwidth_rad_s: f64, damping: f64, integral: f64) -> ControllerSettings {
    ControllerSettings {
        rate_hz: 50.0,
        bandwidth_rad_s,
        damping,
        integral,
        slew_rate_rad_s: 0.0,
        slew_acceleration_rad_s2: 0.0,
        keeps_reference: false,
    }
}

/// Growth a sample of angle, rate and integral, from a long product of the transition matrix: one column a unit state
/// advanced by the controller's law and the double integrator.
fn growth(settings: &ControllerSettings) -> f64 {
    let (w, z, c) = (settings.bandwidth_rad_s, settings.damping, settings.integral);
    let dt = 1.0 / settings.rate_hz;
    let columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|[angle, rate, sum]: [f64; 3]| {
        let sum = if c > 0.0 { sum + angle * dt } else { 0.0 };
        let acceleration =
            -w * w * (1.0 + 2.0 * z * c) * angle - (2.0 * z + c) * w * rate - c * w * w * w * sum;
        [angle + dt * rate + 0.5 * dt * dt * acceleration, rate + dt * acceleration, sum]
    });
    let step = Matrix3::from_fn(|row, column| columns[column][row]);
    // Squared with scaling 24 times: 2^24 samples.
    let (mut power, mut log_norm) = (step, 0.0);
    for _ in 0..24 {
        let norm = power.norm();
        power /= norm;
        log_norm = 2.0 * (log_norm + norm.ln());
        power *= power;
    }
    ((log_norm + power.norm().ln()) / f64::from(1 << 24)).exp()
}

#[test]
fn what_is_refused_grows_and_what_is_allowed_decays() {
    for damping in [0.05, 0.3, 0.7, 1.0, 2.0] {
        for integral in [0.0, 0.01, 0.1, 1.0] {
            let Err(GainError::Unstable { allowed_rad_s, .. }) = settings(1e4, damping, integral).check()
            else {
                panic!("{damping} {integral}");
            };
            for (factor, is_stable) in [(0.01, true), (0.5, true), (0.97, true), (1.03, false), (2.0, false)]
            {
                let tried = settings(allowed_rad_s * factor, damping, integral);
                assert_eq!(tried.check().is_ok(), is_stable, "{tried:?}");
                let growth = growth(&tried);
                assert_eq!(growth < 1.0, is_stable, "{tried:?} {growth}");
            }
        }
    }
}

#[test]
fn the_bound_without_integral_is_that_of_the_closed_form() {
    // D < 2 and P < 2 D with P = x^2, D = 2 d x.
    for damping in [0.1, 0.4, 0.5, 0.6, 1.5] {
        let Err(GainError::Unstable { allowed_rad_s, .. }) = settings(1e3, damping, 0.0).check() else {
            panic!("{damping}");
        };
        let expected = 50.0 * (1.0 / damping).min(4.0 * damping);
        assert!((allowed_rad_s / expected - 1.0).abs() < 1e-9, "{allowed_rad_s} {expected}");
    }
}

#[test]
fn a_refusal_names_what_was_found_and_what_is_allowed() {
    let message = settings(100.0, 0.7, 0.0).check().unwrap_err().to_string();
    assert!(message.contains("100 rad/s") && message.contains("50 Hz"), "{message}");
    assert!(message.contains("71.4285714"), "{message}");
    for (broken, word) in [
        (ControllerSettings { rate_hz: 0.0, ..settings(0.1, 0.7, 0.0) }, "sample rate is 0 Hz"),
        (settings(-1.0, 0.7, 0.0), "bandwidth is -1 rad/s"),
        (settings(0.1, f64::NAN, 0.0), "damping ratio is NaN"),
        (settings(0.1, 0.7, -0.1), "integral ratio is -0.1"),
        (ControllerSettings { slew_rate_rad_s: -1.0, ..settings(0.1, 0.7, 0.0) }, "slew rate is -1 rad/s"),
        (
            ControllerSettings { slew_acceleration_rad_s2: f64::INFINITY, ..settings(0.1, 0.7, 0.0) },
            "slew acceleration is inf rad/s2",
        ),
    ] {
        let message = broken.check().unwrap_err().to_string();
        assert!(message.contains(word), "{message}");
    }
    assert_eq!(settings(0.1, 0.7, 0.1).check(), Ok(()));
}
