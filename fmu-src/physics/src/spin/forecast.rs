//! What a train does by the linear theory: final and peak nutation, and how far the momentum moves.

use core::f64::consts::PI;

use serde::{Deserialize, Serialize};

use super::{nutation::Spin, train::Train};

/// What pulses are timed by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Timing {
    /// Fixed intervals of the assumed spin period after the first pulse.
    Clock,
    /// A delay at the assumed spin rate after each Sun crossing.
    SunCrossing,
    /// The instant that points exactly at the target, each turn.
    TruePhase,
}

/// A train on a spinner whose rate may differ from what was assumed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flight {
    /// The body as it is.
    pub spin: Spin,
    /// Spin rate by which clock pulses are timed, in rad/s.
    pub assumed_rate_rad_s: f64,
    /// Timing.
    pub timing: Timing,
    /// Transverse torque, in N m.
    pub torque_n_m: f64,
}

/// What the linear theory foresees.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Forecast {
    /// After the last pulse, in rad.
    pub final_nutation_rad: f64,
    /// Greatest after any pulse, in rad.
    pub peak_nutation_rad: f64,
    /// Momentum moved toward the target, in rad.
    pub moved_rad: f64,
    /// Momentum moved at right angles to it, in rad.
    pub aside_rad: f64,
}

impl Flight {
    /// Follows the train pulse by pulse.
    pub fn forecast(&self, train: &Train) -> Forecast {
        let spin = &self.spin;
        let period_s = match self.timing {
            Timing::Clock => 2.0 * PI / self.assumed_rate_rad_s,
            Timing::SunCrossing | Timing::TruePhase => spin.period_s(),
        };
        let nutation = spin.body_nutation_rad_s();
        let mut sum = Forecast::default();
        let (mut re, mut im, mut last_s) = (0.0_f64, 0.0_f64, 0.0_f64);
        let (mut last_width_s, mut kick, mut move_rad) = (f64::NAN, 0.0, 0.0);
        for k in 0..train.count() {
            let width_s = train.width_s(k);
            if width_s != last_width_s {
                kick = spin.nutation_kick_rad(self.torque_n_m, width_s);
                move_rad = spin.manoeuvre_rad(self.torque_n_m, width_s);
                last_width_s = width_s;
            }
            let time_s = train.turns(k) * period_s;
            let (sine, cosine) = (nutation * (time_s - last_s)).sin_cos();
            (re, im) = (re * cosine - im * sine, re * sine + im * cosine);
            let half_turns = train.half_turns(k);
            re += if half_turns % 2 == 1 { -kick } else { kick };
            last_s = time_s;
            sum.final_nutation_rad = re.hypot(im);
            sum.peak_nutation_rad = sum.peak_nutation_rad.max(sum.final_nutation_rad);
            let (late_sine, late_cosine) = (spin.rate_rad_s * time_s + 2.0 * PI * train.offset_turns(0)
                - PI * f64::from(half_turns))
            .sin_cos();
            sum.moved_rad += move_rad * late_cosine;
            sum.aside_rad += move_rad * late_sine;
        }
        sum
    }
}

/// Worst of `forecast` over a range of ratios and spin rates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Half width of the inertia ratio.
    pub ratio: f64,
    /// Half width of the spin rate, in rad/s.
    pub rate_rad_s: f64,
}

impl Range {
    /// Worst final and peak nutation over the range, and the least and greatest move, sampled finely enough for the
    /// nutation of the last pulse to turn by less than an eighth of a turn from sample to sample.
    pub fn worst(&self, flight: &Flight, train: &Train) -> Worst {
        let turns = train.turns(train.count().saturating_sub(1)) + 1.0;
        let samples = |half_width: f64| {
            if half_width == 0.0 {
                1
            } else {
                ((2.0 * half_width * turns * 8.0).ceil() as u32).clamp(8, 400) + 1
            }
        };
        let ratios = samples(self.ratio);
        let rates = samples(self.rate_rad_s / flight.spin.rate_rad_s).min(9);
        let at = |i: u32, count: u32| {
            if count == 1 { 0.0 } else { 2.0 * f64::from(i) / f64::from(count - 1) - 1.0 }
        };
        let mut worst = Worst {
            final_nutation_rad: 0.0,
            peak_nutation_rad: 0.0,
            least_moved_rad: f64::INFINITY,
            most_moved_rad: f64::NEG_INFINITY,
        };
        for i in 0..ratios {
            for j in 0..rates {
                let mut other = *flight;
                other.spin.ratio += self.ratio * at(i, ratios);
                other.spin.rate_rad_s += self.rate_rad_s * at(j, rates);
                let seen = other.forecast(train);
                worst.final_nutation_rad = worst.final_nutation_rad.max(seen.final_nutation_rad);
                worst.peak_nutation_rad = worst.peak_nutation_rad.max(seen.peak_nutation_rad);
                worst.least_moved_rad = worst.least_moved_rad.min(seen.moved_rad);
                worst.most_moved_rad = worst.most_moved_rad.max(seen.moved_rad);
            }
        }
        worst
    }
}

/// See [`Range::worst`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst {
    /// In rad.
    pub final_nutation_rad: f64,
    /// In rad.
    pub peak_nutation_rad: f64,
    /// In rad.
    pub least_moved_rad: f64,
    /// In rad.
    pub most_moved_rad: f64,
}
