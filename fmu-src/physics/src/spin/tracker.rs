//! The star tracker on a spinner: which turn sees a star, how long nutation takes to show, and what it tells.

use core::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::math;

/// Picket of a star `ahead_rad` of spin after the Sun pulse, from 0.
pub fn picket_of(ahead_rad: f64, pickets: u32) -> u32 {
    let fraction = ahead_rad.rem_euclid(2.0 * PI) / (2.0 * PI);
    ((fraction * f64::from(pickets)) as u32).min(pickets.saturating_sub(1))
}

/// Whether turn number `turn` searches `picket`: every `every`th, advanced by one a turn.
pub fn searched(picket: u32, turn: u64, every: u32) -> bool {
    u64::from(picket % every) == turn % u64::from(every)
}

/// Eq 20: time to see the full range of declinations, in s, from spin rate (rad/s) and ratio. Linear in the offsets
/// from 5 rpm and 1.5, clock samples every 8 nominal turns; infinite where samples never move.
pub fn observation_time_eq20_s(spin_rate_rad_s: f64, ratio: f64) -> f64 {
    let rpm = spin_rate_rad_s * 30.0 / PI;
    60.0 / (1.5 * (rpm - 5.0) + 5.0 * ratio - 7.5).abs()
}

/// Time to see the full range of declinations, in s: sampling period times 2 pi over the phase advance per sample.
///
/// `sample_s` between samples, `nutation_rad_s` the inertial nutation rate; the advance counts modulo a turn.
pub fn observation_time_s(sample_s: f64, nutation_rad_s: f64) -> f64 {
    let turn = 2.0 * PI;
    let advance = (nutation_rad_s * sample_s + PI).rem_euclid(turn) - PI;
    sample_s * turn / advance.abs()
}

/// Least squares of declination = d0 + a cos(psi) + b sin(psi) over samples at nutation phase psi.
///
/// Nutation moves the spin axis on a cone about the momentum at the inertial nutation rate, so the amplitude
/// sqrt(a^2 + b^2) is the nutation angle (half the peak-to-peak range).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct NutationEstimator {
    /// Sums of 1, c, s, cc, cs, ss.
    sums: [f64; 6],
    /// Sums of d, c d, s d.
    right: [f64; 3],
    /// Samples so far.
    pub count: u32,
}

/// Nutation estimated from the samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NutationEstimate {
    /// Nutation angle, in rad.
    pub nutation_rad: f64,
    /// Standard deviation, in rad; pi while the samples do not fix the angle.
    pub sigma_rad: f64,
}

impl NutationEstimator {
    /// Adds a sample.
    pub fn add(&mut self, phase_rad: f64, declination_rad: f64) {
        let (s, c) = math::sin_cos(phase_rad);
        for (sum, term) in self.sums.iter_mut().zip([1.0, c, s, c * c, c * s, s * s]) {
            *sum += term;
        }
        for (sum, term) in self.right.iter_mut().zip([1.0, c, s]) {
            *sum += term * declination_rad;
        }
        self.count += 1;
    }

    /// Rejects decoded sums that no simulation can produce: no term is greater than a declination with noise of 30 rad.
    pub fn is_valid(&self) -> bool {
        let most = f64::from(self.count) * 30.0;
        self.sums.iter().chain(&self.right).all(|sum| sum.abs() <= most)
    }

    /// Amplitude and its error for samples of standard deviation `noise_rad`.
    pub fn estimate(&self, noise_rad: f64) -> NutationEstimate {
        let unknown = NutationEstimate { nutation_rad: 0.0, sigma_rad: PI };
        let [n, c, s, cc, cs, ss] = self.sums;
        if self.count < 3 {
            return unknown;
        }
        // Centred normal equations: the mean declination is eliminated.
        let [d, cd, sd] = self.right;
        let (a11, a12, a22) = (cc - c * c / n, cs - c * s / n, ss - s * s / n);
        let (b1, b2) = (cd - c * d / n, sd - s * d / n);
        let determinant = a11 * a22 - a12 * a12;
        if determinant.is_nan() || determinant <= 1e-9 * n * n {
            return unknown;
        }
        let (a, b) = ((a22 * b1 - a12 * b2) / determinant, (a11 * b2 - a12 * b1) / determinant);
        let amplitude = math::hypot(a, b);
        let trace = (a11 + a22) / determinant;
        // Along the estimated direction; without an amplitude, the mean over directions.
        let variance = if amplitude > 0.0 {
            (a22 * a * a - 2.0 * a12 * a * b + a11 * b * b) / (determinant * amplitude * amplitude)
        } else {
            0.5 * trace
        };
        NutationEstimate { nutation_rad: amplitude, sigma_rad: (noise_rad * variance.sqrt()).min(PI) }
    }
}
