//! Random draws as pure functions of (seed, channel, event number): no state, the same from any instance.

use core::f64::consts::PI;

use rand_chacha::{
    ChaCha8Rng,
    rand_core::{Rng, SeedableRng},
};

/// Who draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// Star tracker declination.
    StarTracker = 1,
    /// Sun sensor angle.
    SunSensor = 2,
}

/// A normally distributed number of mean 0 and variance 1.
pub fn normal(seed: u64, channel: Channel, event: u64) -> f64 {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    generator.set_stream(((channel as u64) << 56) ^ event);
    // 53 random bits, shifted off 0 so that the logarithm is finite.
    let mut uniform = || ((generator.next_u64() >> 11) as f64 + 0.5) / 9_007_199_254_740_992.0;
    let (first, second) = (uniform(), uniform());
    (-2.0 * first.ln()).sqrt() * (2.0 * PI * second).cos()
}
