//! Effect of a train by the linear theory: final and peak nutation, and the angle by which the momentum moves.

use core::f64::consts::PI;

use serde::{Deserialize, Serialize};

use super::{nutation::Spin, train::Train};
use crate::enumeration::enumeration;
use crate::math;

enumeration! {
    /// Reference by which pulses are timed.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    pub enum Timing {
        /// The first pulse by phase, the others at fixed intervals of the assumed spin period.
        1 => Clock,
        /// A delay at the assumed spin rate after each Sun crossing.
        2 => SunCrossing,
        /// The instant that points exactly at the target, each turn.
        3 => TruePhase,
    }
}

/// A train on a spinner whose rate may differ from what was assumed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForecastCase {
    /// The body as it is.
    pub spin: Spin,
    /// Spin rate by which clock pulses are timed, in rad/s.
    pub assumed_rate_rad_s: f64,
    /// Timing.
    pub timing: Timing,
    /// Transverse torque, in N m.
    pub torque_n_m: f64,
}

/// Prediction of the linear theory.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Forecast {
    /// Nutation after the last pulse, in rad.
    pub final_nutation_rad: f64,
    /// Greatest nutation after any pulse, in rad.
    pub peak_nutation_rad: f64,
    /// Momentum moved toward the target, in rad.
    pub moved_rad: f64,
}

impl ForecastCase {
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
        for k in 0..train.count {
            let width_s = train.width_s(k);
            if width_s != last_width_s {
                kick = spin.nutation_kick_rad(self.torque_n_m, width_s);
                move_rad = spin.manoeuvre_rad(self.torque_n_m, width_s);
                last_width_s = width_s;
            }
            let time_s = train.turns(k) * period_s;
            let (sine, cosine) = math::sin_cos(nutation * (time_s - last_s));
            (re, im) = (re * cosine - im * sine, re * sine + im * cosine);
            let half_turns = train.half_turns(k);
            re += if half_turns % 2 == 1 { -kick } else { kick };
            last_s = time_s;
            sum.final_nutation_rad = math::hypot(re, im);
            sum.peak_nutation_rad = sum.peak_nutation_rad.max(sum.final_nutation_rad);
            let (_, late_cosine) = math::sin_cos(
                spin.rate_rad_s * time_s + 2.0 * PI * train.offset_turns(0) - PI * f64::from(half_turns),
            );
            sum.moved_rad += move_rad * late_cosine;
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

/// Samples to a turn of the last pulse's nutation, than which no nutation turns faster over a range.
const FINE: f64 = 16.0;
/// Samples to a turn where another sweep fills in what lies between.
const COARSE: f64 = 8.0;
/// Fewest intervals of a range.
const FEWEST: u32 = 8;
/// Most intervals for any train; more only while the samples of a sweep follow fewer than [`MOST_PULSES`] in all.
const MOST: u32 = 400;
const MOST_PULSES: f64 = 4e6;
/// Greatest number of pulses that a sweep follows, whatever the train.
const MOST_FOLLOWED: f64 = 6e7;
/// A maximum between samples is looked for where it could exceed the greatest so far by this fraction.
const WORTH_LOOKING: f64 = 1e-5;

impl Range {
    /// Worst final and peak nutation over the range, within 1e-3 of what any finer scan finds, and the least and
    /// greatest move. Trains of more than three thousand pulses are sampled more coarsely, those of more than 150 thousand more coarsely still.
    pub fn worst(&self, flight: &ForecastCase, train: &Train) -> Worst {
        let turns = train.turns(train.count.saturating_sub(1)) + 1.0;
        let count = f64::from(train.count.max(1));
        let most = ((MOST_PULSES / count) as u32).max(MOST.min((MOST_FOLLOWED / count) as u32));
        let samples = |half_width: f64, per_turn: f64| {
            if half_width == 0.0 {
                return 1;
            }
            ((2.0 * half_width * turns * per_turn).ceil() as u32).clamp(FEWEST, most.max(FEWEST)) + 1
        };
        let ratios = samples(self.ratio, FINE);
        let rate = self.rate_rad_s / flight.spin.rate_rad_s;
        let rates = match flight.timing {
            // By the clock the rate turns nutation as the ratio does. Sweeps of the ratio fill in between its samples
            // if they are wide enough.
            Timing::Clock if 2.0 * self.ratio * turns * COARSE >= 1.0 => samples(rate, COARSE),
            Timing::Clock => samples(rate, FINE),
            // From turn to turn it does not: sizes change, and steadily.
            Timing::SunCrossing | Timing::TruePhase => samples(rate, 0.0),
        };
        let at = |ratio: f64, rate: f64| {
            let mut other = *flight;
            other.spin.ratio += self.ratio * ratio;
            other.spin.rate_rad_s += self.rate_rad_s * rate;
            other.forecast(train)
        };
        let mut worst = Worst {
            final_nutation_rad: 0.0,
            peak_nutation_rad: 0.0,
            least_moved_rad: f64::INFINITY,
            most_moved_rad: f64::NEG_INFINITY,
        };
        if ratios == 1 {
            worst.sweep(rates, |position| at(0.0, position));
        } else {
            (0..rates).for_each(|j| worst.sweep(ratios, |position| at(position, position_of(j, rates))));
        }
        worst
    }
}

/// Position of sample `i` of `count` in a range from -1 to 1.
fn position_of(i: u32, count: u32) -> f64 {
    if count == 1 { 0.0 } else { 2.0 * f64::from(i) / f64::from(count - 1) - 1.0 }
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

impl Worst {
    fn include(&mut self, seen: &Forecast) {
        self.final_nutation_rad = self.final_nutation_rad.max(seen.final_nutation_rad);
        self.peak_nutation_rad = self.peak_nutation_rad.max(seen.peak_nutation_rad);
        self.least_moved_rad = self.least_moved_rad.min(seen.moved_rad);
        self.most_moved_rad = self.most_moved_rad.max(seen.moved_rad);
    }

    /// Takes in `count` samples at positions from -1 to 1, and the tops of parabolas through three of them.
    fn sweep(&mut self, count: u32, at: impl Fn(f64) -> Forecast) {
        let mut window = [[0.0; 2]; 3];
        for i in 0..count {
            let seen = at(position_of(i, count));
            self.include(&seen);
            window = [window[1], window[2], [seen.final_nutation_rad, seen.peak_nutation_rad]];
            if i < 2 {
                continue;
            }
            for kind in 0..2 {
                let greatest = [self.final_nutation_rad, self.peak_nutation_rad][kind];
                if let Some((offset, top)) = vertex(window.map(|sample| sample[kind]))
                    && top > greatest * (1.0 + WORTH_LOOKING)
                {
                    let spacing = 2.0 / f64::from(count - 1);
                    self.include(&at(position_of(i - 1, count) + offset * spacing));
                }
            }
        }
    }
}

/// Abscissa and value of the maximum of the parabola through (-1, a), (0, b), (1, c), if it lies within -1 to 1.
fn vertex([a, b, c]: [f64; 3]) -> Option<(f64, f64)> {
    let curvature = 2.0 * b - a - c;
    let offset = 0.5 * (c - a) / curvature;
    (curvature > 0.0 && offset.abs() <= 1.0).then_some((offset, b + 0.25 * (c - a) * offset))
}
