//! Pulse schedule of a valve: the law by which a pulse commanded for a step becomes times at which the valve opens and closes.
//!
//! Law: a valve opens `delay` after the step's start where the pulse lasts at least the valve's shortest time, or reaches the
//! step's end. It closes where the pulse or the step ends, whichever is first, and never sooner than the shortest time after it
//! opened, over the step's end if need be. A pulse from the next step's start on joins one that is open there, so that a pulse
//! may continue from step to step. Anything else does not open.

use serde::{Deserialize, Serialize};

use crate::numerics::spacing::spacing;
use crate::numerics::{Span, or_infinite};
use crate::spacecraft::ValveTiming;

/// A pulse this share short of the shortest time lasts that time.
const SAME_LENGTH: f64 = 1e-12;

/// The current pulse.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct OpenPulse {
    /// When the valve closes, in s; infinite without end.
    #[serde(with = "or_infinite")]
    closes_s: f64,
    /// Earliest time of closing, in s.
    holds_until_s: f64,
}

/// The pulse ahead: when the valve opens and closes, in s.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct NextPulse {
    opens_s: f64,
    /// Infinite without end.
    #[serde(with = "or_infinite")]
    closes_s: f64,
}

/// The current pulse of a valve and the one ahead, and what became of the last step's command.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PulseSchedule {
    open: Option<OpenPulse>,
    next: Option<NextPulse>,
    was_too_short: bool,
}

impl PulseSchedule {
    /// Rejects decoded states that no simulation can produce.
    pub fn is_valid(&self) -> bool {
        self.next.is_none_or(|next| next.opens_s <= next.closes_s)
    }

    /// Takes the pulse commanded for a step; whether anything opens or continues.
    ///
    /// A valve that is busy otherwise (`is_free` false) takes none.
    pub fn command(
        &mut self,
        timing: &ValveTiming,
        pulse: &PulseCommand,
        Span { start_s, end_s }: Span,
        is_free: bool,
    ) -> bool {
        self.was_too_short = false;
        if pulse.on_s <= 0.0 {
            return false;
        }
        let rounding_s = PulseCommand::rounding_s(start_s, end_s);
        let opens_s = start_s + pulse.delay_s;
        let reaches_end = opens_s + pulse.on_s >= end_s - rounding_s;
        let joins =
            pulse.delay_s <= rounding_s && self.open.is_some_and(|it| it.closes_s >= due_from_s(start_s));
        let shortest_s = timing.min_on_s * (1.0 - SAME_LENGTH) - 4.0 * spacing(end_s);
        let opens = opens_s < end_s - rounding_s && (pulse.on_s >= shortest_s || reaches_end || joins);
        self.was_too_short = !opens;
        if opens && is_free {
            let closes_s = if reaches_end { end_s } else { opens_s + pulse.on_s };
            self.plan(timing, Span::new(opens_s, closes_s));
        }
        opens && is_free
    }

    /// Plans a pulse; one that begins before the present one ends makes that end as late as it does itself, but not before the
    /// valve may close.
    pub fn plan(&mut self, timing: &ValveTiming, pulse: Span) {
        let Span { start_s: opens_s, end_s: closes_s } = pulse;
        match &mut self.open {
            Some(open) if opens_s <= due_s(open.closes_s) => open.closes_s = closes_s.max(open.holds_until_s),
            _ => {
                let closes_s = closes_s.max(opens_s + timing.min_on_s);
                self.next = Some(NextPulse { opens_s, closes_s });
            }
        }
    }

    /// Ends the current pulse as soon as the valve may close from `time_s` on, in s, and plans none.
    pub fn end(&mut self, time_s: f64) {
        self.next = None;
        if let Some(open) = &mut self.open {
            open.closes_s = time_s.max(open.holds_until_s);
        }
    }

    /// No current pulse and none ahead.
    pub fn clear(&mut self) {
        (self.open, self.next) = (None, None);
    }

    /// When the valve next closes, in s; infinite where it is closed or stays open.
    pub fn closes_s(&self) -> f64 {
        self.open.map_or(f64::INFINITY, |open| open.closes_s)
    }

    /// When it next opens, in s; infinite where it does not.
    pub fn opens_s(&self) -> f64 {
        self.next.map_or(f64::INFINITY, |next| next.opens_s)
    }

    /// Whether no pulse is current or ahead.
    pub fn is_idle(&self) -> bool {
        self.open.is_none() && self.next.is_none()
    }

    /// When it next opens or closes, in s; infinite where it does neither.
    pub fn next_edge_s(&self) -> f64 {
        self.opens_s().min(self.closes_s())
    }

    /// Takes note that the current pulse is over; whether it is by `due_s`, in s.
    pub fn close_if_due(&mut self, due_s: f64) -> bool {
        let closes = self.closes_s() <= due_s;
        if closes {
            self.open = None;
        }
        closes
    }

    /// Takes note that the pulse ahead began; whether it did by `due_s`, in s.
    pub fn open_if_due(&mut self, timing: &ValveTiming, due_s: f64) -> bool {
        let Some(NextPulse { opens_s, closes_s }) = self.next.filter(|next| next.opens_s <= due_s) else {
            return false;
        };
        self.next = None;
        self.open = Some(OpenPulse { closes_s, holds_until_s: opens_s + timing.min_on_s });
        true
    }

    /// Whether the valve is open for a pulse.
    pub fn is_open(&self) -> bool {
        self.open.is_some()
    }

    /// Whether the last step commanded a pulse that does not open the valve.
    pub fn was_too_short(&self) -> bool {
        self.was_too_short
    }
}

/// Times up to this one are due at `time_s`.
pub fn due_s(time_s: f64) -> f64 {
    time_s + 4.0 * spacing(time_s)
}

/// Times from this one on are not over at `time_s`.
fn due_from_s(time_s: f64) -> f64 {
    time_s - 4.0 * spacing(time_s)
}

/// A thruster command within a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PulseCommand {
    /// From the start of the step, in s.
    pub delay_s: f64,
    /// How long, in s.
    pub on_s: f64,
}

impl PulseCommand {
    /// A pulse whose times are rounded to whole steps of `resolution_s`; 0 = not rounded.
    pub fn rounded(delay_s: f64, on_s: f64, resolution_s: f64) -> Self {
        let rounded = |time_s: f64| {
            let time_s = time_s.max(0.0);
            let steps = time_s / resolution_s;
            // So many steps that doubles do not count them are as fine as no rounding.
            if resolution_s > 0.0 && steps < 1e15 { steps.round() * resolution_s } else { time_s }
        };
        Self { delay_s: rounded(delay_s), on_s: rounded(on_s) }
    }

    /// Whether decoded numbers can be some.
    pub fn is_valid(&self) -> bool {
        self.delay_s >= 0.0 && self.on_s >= 0.0
    }

    /// Whether it does not end within a step, by more than the rounding of times.
    pub fn is_cut(&self, start_s: f64, end_s: f64) -> bool {
        self.on_s > 0.0 && self.delay_s + self.on_s > end_s - start_s + Self::rounding_s(start_s, end_s)
    }

    /// By how much times within a step from `start_s` to `end_s`, in s, are taken for the same.
    pub(super) fn rounding_s(start_s: f64, end_s: f64) -> f64 {
        1e-9 * (end_s - start_s) + 8.0 * spacing(start_s.abs().max(end_s.abs()))
    }
}
