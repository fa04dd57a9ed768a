//! Moments of the normal distribution, and bits that saved runs depend on.
use super::*;
use nalgebra::Matrix3;

#[test]
fn draws_of_the_spinner_keep_their_bits() {
    // Recorded before channels with numbers came in.
    let found = [
        normal(1, Channel::StarTracker, 0),
        normal(1, Channel::SunSensor, 0),
        normal(20_260_722, Channel::StarTracker, 123_456),
        normal(u64::MAX, Channel::SunSensor, 7),
    ];
    let recorded = [0x3fe45bd4874cbf45, 0x3fed0f12aabcf0ce, 0x40024ea195fcdae3, 0x3ff68fdff7566f04];
    assert_eq!(found.map(f64::to_bits), recorded);
}

#[test]
fn vectors_have_unit_covariance_and_no_mean() {
    let draws = 40_000_u32;
    let (mut mean, mut square, mut fourth) = (Vector3::zeros(), Matrix3::zeros(), Vector3::zeros());
    for event in 0..draws {
        let drawn = normal_vector(5, Channel::GyroAngle, u64::from(event));
        mean += drawn / f64::from(draws);
        square += drawn * drawn.transpose() / f64::from(draws);
        fourth += drawn.map(|x| x.powi(4)) / f64::from(draws);
    }
    // Four standard errors: 1, sqrt 2 and sqrt 96 over the root of the number.
    let error = 4.0 / f64::from(draws).sqrt();
    assert!(mean.amax() < error, "{mean}");
    assert!((square - Matrix3::identity()).amax() < error * 2.0_f64.sqrt(), "{square}");
    assert!(fourth.add_scalar(-3.0).amax() < error * 96.0_f64.sqrt(), "{fourth}");
}

#[test]
fn channels_numbers_events_and_seeds_differ() {
    let channels = [
        Channel::StarTracker,
        Channel::SunSensor,
        Channel::StarTrackerAxes,
        Channel::GyroAngle,
        Channel::GyroBias,
        Channel::SunSensorDirection(0),
        Channel::SunSensorDirection(1),
        Channel::SunSensorDirection(u16::MAX),
        Channel::AccelerometerBias,
        Channel::AccelerometerScale,
        Channel::AccelerometerNoise,
        Channel::AccelerometerDrift,
        Channel::Thruster(0),
        Channel::Thruster(u16::MAX),
        Channel::ThrustDirection,
        Channel::ThrustJitter,
    ];
    let mut found = Vec::new();
    for channel in channels {
        for (seed, event) in [(1, 0), (1, 1), (2, 0), (2, (1 << 40) - 1)] {
            assert_eq!(normal_vector(seed, channel, event).x, normal(seed, channel, event));
            let drawn = normal_vector(seed, channel, event);
            found.extend(drawn.iter().map(|x| x.to_bits()));
        }
    }
    let count = found.len();
    found.sort_unstable();
    found.dedup();
    assert_eq!(found.len(), count);
}
