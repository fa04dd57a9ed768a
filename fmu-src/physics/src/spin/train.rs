//! Trains of pulses: how wide each is and how many turns after the first it comes.

use core::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::nutation::Spin;

use crate::math;

/// Highest order of a taper.
pub const MOST_ORDER: u32 = 6;
/// Longest train.
pub const MOST_PULSES: u32 = 1_000_000;
/// A split train waits no longer than this for the turn on which both halves cancel, in turns.
const LONGEST_WAIT_TURNS: f64 = 20.0;
/// A split train is content with halves that miss the direction by this much together, in turns.
const CONTENT_OFFSET_TURNS: f64 = 0.02;

/// Halves that miss the direction by more together cancel too much of each other's work, in turns.
const MOST_OFFSET_TURNS: f64 = 0.25;
/// Least part of the move of exact pulses that a split train keeps: cos(pi / 4) at [`MOST_OFFSET_TURNS`].
pub const LEAST_OF_SPLIT: f64 = core::f64::consts::FRAC_1_SQRT_2;

/// The shape of a train.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Shape {
    /// Equal pulses.
    Uniform,
    /// Ends rise and fall by binomial sums: order 1 is 1 2 2 ... 2 1, order 2 is 1 3 4 ... 4 3 1.
    Tapered {
        /// 1 to 6.
        order: u32,
    },
    /// Two equal halves, the second delayed until its nutation cancels the first's.
    Split,
}

/// Why a train cannot be simulated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TrainError {
    /// Spacing.
    #[error("{turns} turns per pulse: allowed are 0.5, 1, 1.5 and so on")]
    Turns {
        /// Spacing that was requested.
        turns: f64,
    },
    /// Half turns with one thruster.
    #[error(
        "a train with a pulse every {turns} turns needs two opposite thrusters in alternation: with one, every second \
         pulse takes back the one before, and the momentum never moves"
    )]
    Cancels {
        /// Spacing.
        turns: f64,
    },
    /// Count.
    #[error("{count} pulses; {allowed}")]
    Count {
        /// Number that was requested.
        count: u32,
        /// Range that is allowed.
        allowed: String,
    },
    /// Width.
    #[error("a pulse of {width_s} s; {allowed}")]
    Width {
        /// Width that was requested.
        width_s: f64,
        /// Range that is allowed.
        allowed: String,
    },
    /// Split trains need a nutation that turns in the body.
    #[error("a split train waits for nutation to turn in the body; with inertia ratio {ratio} it does not")]
    NoNutation {
        /// I3/I_T.
        ratio: f64,
    },
    /// No turn soon enough on which both halves point near the target.
    #[error(
        "the halves of a split train would point {offset_turns:.3} turns apart with inertia ratio {ratio}, allowed: up to \
         {MOST_OFFSET_TURNS} turns"
    )]
    OffsetHalves {
        /// Turns from the direction of the first half to that of the second.
        offset_turns: f64,
        /// I3/I_T.
        ratio: f64,
    },
}

/// Pulses of a train, whatever their number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pulses {
    /// Shape of the train.
    pub shape: Shape,
    /// Width of the outermost pulse, in s.
    pub unit_width_s: f64,
    /// Turns from pulse to pulse.
    pub turns_per_pulse: f64,
    /// Smallest step of width, in s; 0 for none.
    pub resolution_s: f64,
}

/// A train of pulses.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Train {
    /// Its shape.
    pub shape: Shape,
    /// Number of pulses.
    pub count: u32,
    half_turns_per_pulse: u32,
    /// Widths while the taper rises; the last is the plateau's.
    widths_s: [f64; MOST_ORDER as usize + 1],
    /// Order of its taper; 0 without one.
    pub order: u32,
    second_half: SecondHalf,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct SecondHalf {
    /// First pulse of the second half; 0 without one.
    first: u32,
    /// Half turns from the first pulse of the train to it.
    half_turns: u32,
    /// Turns by which the second half comes late against the exact direction, half of it each.
    offset_turns: f64,
}

impl Train {
    /// A train of `count` pulses.
    ///
    /// Wider pulses of a taper have a whole multiple of the outermost one's *nutation kick*, and whole steps of the resolution
    /// if it has. The nutation of `spin` sizes pulses and places the halves of a split train.
    ///
    /// # Errors
    /// A train that cannot be simulated.
    pub fn new(pulses: &Pulses, count: u32, spin: &Spin) -> Result<Self, TrainError> {
        let Pulses { shape, unit_width_s, turns_per_pulse, resolution_s } = *pulses;
        let half_turns = 2.0 * turns_per_pulse;
        if !(1.0..=200.0).contains(&half_turns) || half_turns.fract() != 0.0 {
            return Err(TrainError::Turns { turns: turns_per_pulse });
        }
        if !(unit_width_s.is_finite() && unit_width_s > 0.0) {
            return Err(TrainError::Width { width_s: unit_width_s, allowed: "a positive width".into() });
        }
        let mut train = Self {
            shape,
            count,
            half_turns_per_pulse: half_turns as u32,
            widths_s: [unit_width_s; MOST_ORDER as usize + 1],
            order: 0,
            second_half: SecondHalf::default(),
        };
        let refuse = |allowed: &str| TrainError::Count { count, allowed: allowed.to_owned() };
        if !(1..=MOST_PULSES).contains(&count) {
            return Err(refuse(&format!("a train has 1 to {MOST_PULSES}")));
        }
        match shape {
            Shape::Uniform => {}
            Shape::Tapered { order } => {
                if !(1..=MOST_ORDER).contains(&order) {
                    return Err(refuse(&format!("a taper of order {order} is not among 1 to {MOST_ORDER}")));
                }
                if count <= order {
                    return Err(refuse(&format!("a taper of order {order} needs more than {order}")));
                }
                train.order = order;
                train.taper(unit_width_s, spin, resolution_s)?;
            }
            Shape::Split => {
                if !count.is_multiple_of(2) {
                    return Err(refuse("a split train has an even number"));
                }
                train.split(spin)?;
            }
        }
        Ok(train)
    }

    fn taper(&mut self, unit_width_s: f64, spin: &Spin, resolution_s: f64) -> Result<(), TrainError> {
        let whole = resolution_s > 0.0 && {
            let steps = unit_width_s / resolution_s;
            (steps - steps.round()).abs() < 1e-9
        };
        for k in 0..=self.order {
            let units = taper_weight(self.order, self.count, k);
            let width_s = spin.scaled_width_s(unit_width_s, units).ok_or_else(|| TrainError::Width {
                width_s: unit_width_s,
                allowed: format!("no single pulse has {units} times its nutation kick; take a shorter one"),
            })?;
            self.widths_s[k as usize] =
                if whole { (width_s / resolution_s).round().max(1.0) * resolution_s } else { width_s };
        }
        Ok(())
    }

    fn split(&mut self, spin: &Spin) -> Result<(), TrainError> {
        let advance = spin.ratio - 1.0;
        if advance.abs() < 1e-6 {
            return Err(TrainError::NoNutation { ratio: spin.ratio });
        }
        let first = self.count / 2;
        let soonest = first * self.half_turns_per_pulse;
        let step = if self.half_turns_per_pulse.is_multiple_of(2) { 2 } else { 1 };
        let mut best = SecondHalf { first, half_turns: soonest, offset_turns: f64::INFINITY };
        let mut half_turns = soonest;
        while f64::from(half_turns - soonest) <= 2.0 * LONGEST_WAIT_TURNS {
            // Half turns of nutation in the body at that pulse, counting the opposite thruster's reversal as one.
            let parity = f64::from(half_turns % 2);
            let phase = advance * f64::from(half_turns) + parity;
            let odd = 2.0 * ((phase - 1.0) / 2.0).round() + 1.0;
            let offset_turns = (odd - phase) / (2.0 * advance);
            if offset_turns.abs() < best.offset_turns.abs() {
                best = SecondHalf { first, half_turns, offset_turns };
            }
            if offset_turns.abs() <= CONTENT_OFFSET_TURNS {
                break;
            }
            half_turns += step;
        }
        // The ratios 1.4 and 1.6 are on the edge itself.
        if best.offset_turns.abs() > MOST_OFFSET_TURNS * (1.0 + 1e-9) {
            return Err(TrainError::OffsetHalves { offset_turns: best.offset_turns, ratio: spin.ratio });
        }
        self.second_half = best;
        Ok(())
    }

    /// Whether the numbers of a decoded train belong together.
    pub fn is_valid(&self) -> bool {
        (1..=MOST_PULSES).contains(&self.count)
            && (1..=200).contains(&self.half_turns_per_pulse)
            && self.order <= MOST_ORDER
            && self.second_half.first <= self.count
            && self.second_half.half_turns <= 200 * MOST_PULSES + 400
            && self.second_half.offset_turns.abs() <= 1.0
            && self.widths_s.iter().all(|w| *w > 0.0)
    }

    /// Turns from pulse to pulse.
    pub fn turns_per_pulse(&self) -> f64 {
        0.5 * f64::from(self.half_turns_per_pulse)
    }

    /// Whether two opposite thrusters alternate.
    pub fn alternates(&self) -> bool {
        !self.half_turns_per_pulse.is_multiple_of(2)
    }

    /// Width of pulse `k` from 0, in s.
    pub fn width_s(&self, k: u32) -> f64 {
        let from_end = k.min(self.count.saturating_sub(1 + k)).min(self.order);
        self.widths_s[from_end.min(MOST_ORDER) as usize]
    }

    /// Width a longer train of this shape repeats, in s.
    pub fn plateau_width_s(&self) -> f64 {
        self.widths_s[self.order.min(MOST_ORDER) as usize]
    }

    /// Width of the widest pulse, in s.
    pub fn widest_s(&self) -> f64 {
        (0..=self.order).map(|k| self.width_s(k)).fold(0.0, f64::max)
    }

    /// Half turns from the first pulse's turn to that of pulse `k`; odd ones belong to the opposite thruster.
    pub fn half_turns(&self, k: u32) -> u32 {
        let SecondHalf { first, half_turns, .. } = self.second_half;
        if first > 0 && k >= first {
            return half_turns + (k - first) * self.half_turns_per_pulse;
        }
        k * self.half_turns_per_pulse
    }

    /// Turns by which the centre of pulse `k` comes after the instant that points exactly at the target.
    pub fn offset_turns(&self, k: u32) -> f64 {
        let SecondHalf { first, offset_turns, .. } = self.second_half;
        if first == 0 {
            return 0.0;
        }
        if k >= first { 0.5 * offset_turns } else { -0.5 * offset_turns }
    }

    /// Turns from the centre of the first pulse to that of pulse `k`.
    pub fn turns(&self, k: u32) -> f64 {
        0.5 * f64::from(self.half_turns(k)) + (self.offset_turns(k) - self.offset_turns(0))
    }

    /// How far the train moves the momentum toward its target, in rad: each pulse by eq 3 times the cosine of how far it is
    /// off the exact direction. The halves of a split train are off to either side alike.
    pub fn manoeuvre_rad(&self, spin: &Spin, torque_n_m: f64) -> f64 {
        let one =
            |k: u32| math::cos(TAU * self.offset_turns(k)) * spin.manoeuvre_rad(torque_n_m, self.width_s(k));
        // What does not rise or fall is alike within each half.
        let (rise, fall) =
            (self.order.min(self.count), self.count.saturating_sub(self.order).max(self.order));
        let middle = self.second_half.first.clamp(rise, fall.min(self.count));
        let alike = |from: u32, to: u32| if from < to { f64::from(to - from) * one(from) } else { 0.0 };
        let ends = (0..rise).chain(fall..self.count).map(one).sum::<f64>();
        ends + alike(rise, middle) + alike(middle, fall.min(self.count))
    }

    /// Sum of the widths, in s.
    pub fn on_time_s(&self) -> f64 {
        (0..self.count).map(|k| self.width_s(k)).sum()
    }

    /// From the first edge to the last at `period_s` a turn, in s.
    pub fn duration_s(&self, period_s: f64) -> f64 {
        let last = self.count.saturating_sub(1);
        self.turns(last) * period_s + 0.5 * (self.width_s(0) + self.width_s(last))
    }
}

/// Weight of pulse `k` in units of the outermost: a train of ones convolved with (1 + x)^order.
fn taper_weight(order: u32, count: u32, k: u32) -> f64 {
    let ones = count - order;
    let mut binomial = 1.0;
    let mut sum = 0.0;
    for j in 0..=order {
        if j > 0 {
            binomial *= f64::from(order - j + 1) / f64::from(j);
        }
        if k >= j && k - j < ones {
            sum += binomial;
        }
    }
    sum
}
