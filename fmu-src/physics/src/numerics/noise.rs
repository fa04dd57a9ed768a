//! Random draws as pure functions of (seed, channel, event number): no state, the same from any instance.

use core::f64::consts::PI;

use nalgebra::Vector3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use crate::math;

/// Consumer of random draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// Star tracker declination of a spinner.
    StarTracker,
    /// Sun sensor angle of a spinner.
    SunSensor,
    /// Star tracker of a three-axis spacecraft, by body axis.
    StarTrackerAxes,
    /// Angle random walk of gyros, by body axis.
    GyroAngle,
    /// Rate random walk (of the bias) of gyros, by body axis.
    GyroBias,
    /// Sun sensor of a three-axis spacecraft, with its number.
    SunSensorDirection(u16),
    /// Bias of accelerometers at the start, by body axis.
    AccelerometerBias,
    /// Scale error of accelerometers, by body axis.
    AccelerometerScale,
    /// Noise of accelerometers, by body axis.
    AccelerometerNoise,
    /// Random walk of the accelerometers' bias, by body axis.
    AccelerometerDrift,
    /// Thrust of a thruster's pulses, with its number.
    Thruster(u16),
    /// Misalignment and drift of a delta-v's thrust.
    ThrustDirection,
    /// Jitter of a delta-v's thrust, by second.
    ThrustJitter,
    /// Magnitude of a maneuver.
    ManeuverMagnitude,
    /// Direction of a maneuver.
    ManeuverDirection,
    /// Centre of mass after a thruster event, by body axis.
    CenterOfMass,
    /// A dispersed value of a run, with its number.
    Dispersion(u16),
}

impl Channel {
    /// Number of the generator's stream; streams of two channels differ for event numbers below 2^40.
    fn stream(self, event: u64) -> u64 {
        let (code, number) = match self {
            Self::StarTracker => (1, 0),
            Self::SunSensor => (2, 0),
            Self::StarTrackerAxes => (3, 0),
            Self::GyroAngle => (4, 0),
            Self::GyroBias => (5, 0),
            Self::SunSensorDirection(number) => (6, u64::from(number)),
            Self::AccelerometerBias => (7, 0),
            Self::AccelerometerScale => (8, 0),
            Self::AccelerometerNoise => (9, 0),
            Self::AccelerometerDrift => (10, 0),
            Self::Thruster(number) => (11, u64::from(number)),
            Self::ThrustDirection => (12, 0),
            Self::ThrustJitter => (13, 0),
            Self::ManeuverMagnitude => (14, 0),
            Self::ManeuverDirection => (15, 0),
            Self::CenterOfMass => (16, 0),
            Self::Dispersion(number) => (17, u64::from(number)),
        };
        (code << 56) ^ (number << 40) ^ event
    }
}

/// Points of the plane by radius and angle, whose coordinates are independent and normally distributed (Box and Muller).
fn polar_points<const N: usize>(seed: u64, channel: Channel, event: u64) -> [(f64, f64); N] {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    generator.set_stream(channel.stream(event));
    // 53 random bits, shifted off 0 so that the logarithm is finite.
    let mut uniform = || ((generator.next_u64() >> 11) as f64 + 0.5) / 9_007_199_254_740_992.0;
    core::array::from_fn(|_| ((-2.0 * math::ln(uniform())).sqrt(), 2.0 * PI * uniform()))
}

/// A normally distributed number of mean 0 and variance 1.
pub fn normal(seed: u64, channel: Channel, event: u64) -> f64 {
    let [(radius, angle)] = polar_points(seed, channel, event);
    radius * math::cos(angle)
}

/// Three independent normally distributed numbers of mean 0 and variance 1; the first is that of [`normal`].
pub fn normal_vector(seed: u64, channel: Channel, event: u64) -> Vector3<f64> {
    let [(radius, angle), (third_radius, third_angle)] = polar_points(seed, channel, event);
    Vector3::new(radius * math::cos(angle), radius * math::sin(angle), third_radius * math::cos(third_angle))
}

#[cfg(test)]
mod tests;
