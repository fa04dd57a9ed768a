//! Valve of a thruster: its thrust over time as a fraction of the full one, from edge to edge.
//!
//! The fraction rises linearly to 1 while the valve is open and falls linearly to 0 after it closes ([`ValveTiming`]). It is
//! the same from the last edge or the end of a ramp on, at whatever times it is asked for. A pulse's thrust is scattered about the nominal one
//! by a draw that depends on seed, thruster and number of the pulse alone.

use serde::{Deserialize, Serialize};

use crate::numerics::noise::{Channel, normal};
use crate::spacecraft::ValveTiming;

/// State of a valve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Valve {
    is_open: bool,
    /// When it last opened, closed or came to the end of a ramp, in s, and the fraction then.
    since_s: f64,
    fraction: f64,
    /// Thrust of the present pulse over the nominal one.
    scale: f64,
    pulses: u32,
}

impl Valve {
    /// Rejects decoded states that no simulation can produce.
    pub fn is_valid(&self) -> bool {
        (0.0..=1.0).contains(&self.fraction) && (0.0..=10.0).contains(&self.scale)
    }

    /// Whether it is open.
    pub fn is_open(&self) -> bool {
        self.is_open
    }

    /// Whether it is closed with nothing left to come out.
    pub fn is_shut(&self) -> bool {
        !self.is_open && self.fraction == 0.0
    }

    /// Pulses begun so far.
    pub fn pulses(&self) -> u32 {
        self.pulses
    }

    /// Opens it; nothing where it is open.
    pub fn open(&mut self, timing: &ValveTiming, time_s: f64, scatter: f64, seed: u64, thruster: u16) {
        if self.is_open {
            return;
        }
        self.fraction = self.ramp(timing, time_s)[0];
        (self.since_s, self.is_open) = (time_s, true);
        let drawn = if scatter > 0.0 {
            scatter * normal(seed, Channel::Thruster(thruster), self.pulses.into())
        } else {
            0.0
        };
        self.scale = (1.0 + drawn).clamp(0.0, 10.0);
        self.pulses = self.pulses.saturating_add(1);
    }

    /// Closes it; nothing where it is closed.
    pub fn close(&mut self, timing: &ValveTiming, time_s: f64) {
        if self.is_open {
            self.fraction = self.ramp(timing, time_s)[0];
            (self.since_s, self.is_open) = (time_s, false);
        }
    }

    /// Closes it with nothing left to come out.
    pub fn shut(&mut self, time_s: f64) {
        (self.since_s, self.is_open, self.fraction) = (time_s, false, 0.0);
    }

    /// When its thrust next stops rising or falling; infinite where it is constant.
    pub fn ramp_end_s(&self, timing: &ValveTiming) -> f64 {
        let left_s = if self.is_open {
            (1.0 - self.fraction) * timing.rise_s
        } else {
            self.fraction * timing.tail_off_s
        };
        if left_s > 0.0 { self.since_s + left_s } else { f64::INFINITY }
    }

    /// Takes note that the ramp which ends at `time_s` is over.
    pub fn end_ramp(&mut self, time_s: f64) {
        (self.since_s, self.fraction) = (time_s, if self.is_open { 1.0 } else { 0.0 });
    }

    /// Thrust over the nominal full one at `time_s` and its slope per second, as they are just after that time.
    pub fn thrust(&self, timing: &ValveTiming, time_s: f64) -> [f64; 2] {
        self.ramp(timing, time_s).map(|it| it * self.scale)
    }

    fn ramp(&self, timing: &ValveTiming, time_s: f64) -> [f64; 2] {
        if time_s >= self.ramp_end_s(timing) {
            return [if self.is_open { 1.0 } else { 0.0 }, 0.0];
        }
        let elapsed_s = time_s - self.since_s;
        match (self.is_open, self.fraction) {
            (true, from) if timing.rise_s > 0.0 && from < 1.0 => {
                [(from + elapsed_s / timing.rise_s).min(1.0), timing.rise_s.recip()]
            }
            (true, _) => [1.0, 0.0],
            (false, from) if timing.tail_off_s > 0.0 && from > 0.0 => {
                [(from - elapsed_s / timing.tail_off_s).max(0.0), -timing.tail_off_s.recip()]
            }
            (false, _) => [0.0, 0.0],
        }
    }
}

#[cfg(test)]
mod tests;
