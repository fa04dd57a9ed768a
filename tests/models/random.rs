//! Random numbers that are the same in every run.

/// Numbers in [0, 1) that are the same every time.
#[derive(Clone)]
pub(crate) struct RandomNumbers(pub u64);

impl RandomNumbers {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// A whole number from `low` to `high`.
    pub(crate) fn whole(&mut self, low: i32, high: i32) -> f64 {
        (f64::from(low) + (f64::from(high - low + 1) * self.next()).floor()).min(f64::from(high))
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.next() * count as f64) as usize
    }

    /// Within limits: an end, or any magnitude.
    pub(crate) fn legal(&mut self, (min, max): (f64, f64), whole: bool) -> f64 {
        if whole {
            let span = max.min(1e9) - min.max(-1e9) + 1.0;
            return match self.below(4) {
                0 => min,
                1 => max,
                _ => (min.max(-1e9) + (self.next() * span).floor()).min(max),
            };
        }
        match self.below(6) {
            0 => min.max(-1e30),
            1 => max.min(1e30),
            _ => {
                let sign = if self.next() < 0.5 { -1.0 } else { 1.0 };
                (sign * 10_f64.powf(self.next() * 36.0 - 12.0)).clamp(min, max)
            }
        }
    }

    pub(crate) fn direction(&mut self) -> [f64; 3] {
        let (azimuth, z) = (core::f64::consts::TAU * self.next(), 2.0 * self.next() - 1.0);
        let rho = (1.0 - z * z).sqrt();
        [rho * azimuth.cos(), rho * azimuth.sin(), z]
    }
}
