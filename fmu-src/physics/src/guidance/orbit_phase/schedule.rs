//! When a Mercury orbiter observes and when it talks to Earth: downlink windows counted from periapsis.
//!
//! Windows follow the orbit, never the clock: an orbit that takes 12.07 h instead of 12 would drift through all
//! phases of a clock schedule in 90 days.

use crate::numerics::spacing::spacing;

/// Activity of an orbiter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Activity {
    /// Instruments look at the planet.
    Science,
    /// An antenna looks at the Earth.
    Downlink,
}

/// Downlink windows after periapsis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Schedule {
    /// A periapsis; the first window belongs to it.
    pub periapsis_s: f64,
    /// Orbital period, in s; infinite where there is no orbit to count.
    pub period_s: f64,
    /// Begin of downlink, in s after periapsis.
    pub downlink_start_s: f64,
    /// End of downlink, in s after periapsis.
    pub downlink_end_s: f64,
    /// Begin and end as fractions of the period, where they are given so: they follow it.
    pub period_shares: [Option<f64>; 2],
    /// A window after every how many periapses; 0 = never.
    pub every: u32,
    /// Whether the first window is the only one, whatever `every` says.
    pub once: bool,
    /// Whether all is downlink, without windows: in cruise.
    pub throughout: bool,
}

/// Why windows give no cycles of science and downlink.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NoCycle {
    /// No window is ever open.
    #[error("no downlink")]
    Never,
    /// Downlink fills the whole orbit.
    #[error("downlink throughout")]
    Throughout,
    /// A window is still open when the next one begins.
    #[error("downlinks that overlap, one every {every_s:?} s")]
    Overlap {
        /// Between two begins.
        every_s: f64,
    },
}

/// The activity at a time, when it began and when it ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// Activity of the window.
    pub activity: Activity,
    /// Since when, in the schedule's time scale; minus infinity where it never changes.
    pub since_s: f64,
    /// Until when, as far as it is known; infinite where it never changes or depends on a periapsis to come.
    pub until_s: f64,
}

impl Schedule {
    /// The same in an orbit of this period, in s.
    #[must_use]
    pub fn in_orbit(self, period_s: f64) -> Self {
        let time_s = |share: Option<f64>, given_s: f64| {
            share.map_or(given_s, |share| if period_s.is_finite() { share * period_s } else { given_s })
        };
        let [start, end] = self.period_shares;
        Self {
            period_s,
            downlink_start_s: time_s(start, self.downlink_start_s),
            downlink_end_s: time_s(end, self.downlink_end_s),
            ..self
        }
    }

    /// Activity at `time_s`, in the time scale of `periapsis_s`. Edges belong to what follows them.
    pub fn window(&self, time_s: f64) -> Window {
        if self.throughout {
            return Window { activity: Activity::Downlink, ..Window::NEVER };
        }
        let cycle_s = f64::from(self.every) * self.period_s;
        if self.once {
            return self.window_after(&[self.periapsis_s], time_s);
        }
        let length_s = (self.downlink_end_s - self.downlink_start_s).min(cycle_s);
        if self.every == 0 || !cycle_s.is_finite() || length_s.is_nan() || length_s <= 0.0 {
            return Window::NEVER;
        }
        let first_start_s = self.periapsis_s + self.downlink_start_s;
        let start_of = |cycle: f64| first_start_s + cycle * cycle_s;
        let mut cycle = ((time_s - first_start_s) / cycle_s).floor();
        // The division may round across an edge that the sum below puts exactly.
        if time_s < start_of(cycle) {
            cycle -= 1.0;
        } else if time_s >= start_of(cycle + 1.0) {
            cycle += 1.0;
        }
        Window::new(start_of(cycle), length_s, start_of(cycle + 1.0), time_s)
    }

    /// Length of a cycle of science and downlink, in s; infinite where none follows.
    pub fn cycle_s(&self) -> f64 {
        if self.once || self.throughout { f64::INFINITY } else { f64::from(self.every) * self.period_s }
    }

    /// Length of a downlink, in s.
    pub fn downlink_s(&self) -> f64 {
        self.downlink_end_s - self.downlink_start_s
    }

    /// Whether there are downlinks with science between them.
    ///
    /// # Errors
    /// Windows that never open or overlap.
    pub fn check_windows(&self) -> Result<(), NoCycle> {
        let cycle_s = self.cycle_s();
        if self.throughout {
            Err(NoCycle::Throughout)
        } else if self.downlink_start_s >= self.downlink_end_s || (self.every == 0 && !self.once) {
            Err(NoCycle::Never)
        } else if self.downlink_end_s - self.downlink_start_s >= cycle_s {
            Err(NoCycle::Overlap { every_s: cycle_s })
        } else {
            Ok(())
        }
    }

    /// Returns the same windows, moved so that one begins at `time_s`.
    pub fn begun_at(&self, time_s: f64) -> Self {
        // Rounding must not put the begin after it.
        let begin_s = time_s - 4.0 * spacing(time_s.abs().max(self.downlink_start_s));
        Self { periapsis_s: begin_s - self.downlink_start_s, ..*self }
    }

    /// The same for periapses that were met instead of computed: every `every`-th one, the latest first. A window is
    /// as long as requested; the next one ends it. Before the first window all is science.
    pub fn window_after(&self, periapses_s: &[f64], time_s: f64) -> Window {
        if self.throughout {
            return self.window(time_s);
        }
        let length_s = self.downlink_end_s - self.downlink_start_s;
        if (self.every == 0 && !self.once) || length_s.is_nan() || length_s <= 0.0 {
            return Window::NEVER;
        }
        let starts_s = || periapses_s.iter().map(|at_s| at_s + self.downlink_start_s);
        let last_s = starts_s().filter(|start_s| *start_s <= time_s).reduce(f64::max);
        let next_s = starts_s().filter(|start_s| *start_s > time_s).fold(f64::INFINITY, f64::min);
        last_s.map_or(Window { until_s: next_s, ..Window::NEVER }, |start_s| {
            Window::new(start_s, length_s, next_s, time_s)
        })
    }
}

impl Window {
    /// Science without end.
    const NEVER: Self =
        Self { activity: Activity::Science, since_s: f64::NEG_INFINITY, until_s: f64::INFINITY };

    /// The window at `time_s` when the last downlink began at `start_s` and the next one begins at `next_s`.
    fn new(start_s: f64, length_s: f64, next_s: f64, time_s: f64) -> Self {
        let end_s = start_s + length_s;
        if time_s < end_s {
            Self { activity: Activity::Downlink, since_s: start_s, until_s: end_s.min(next_s) }
        } else {
            Self { activity: Activity::Science, since_s: end_s, until_s: next_s }
        }
    }
}

#[cfg(test)]
mod tests;
