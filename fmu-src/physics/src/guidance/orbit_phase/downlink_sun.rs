//! Direction of the Sun during a downlink: selected at the sample where the downlink begins, held while it lasts.
//!
//! A downlink begins where the scenario becomes downlink without an azimuth of its own, with each entry of the timeline that
//! names it, and where a window of the orbit phase begins. Science of the orbit phase that unloads momentum is alike: chosen where it
//! or the scenario begins, held until the next downlink. In Operational alone: other modes have the Sun on -Y.

use serde::{Deserialize, Serialize};

use super::guided::Guided;
use super::periapsis_count::PeriapsisCount;
use super::predicted_orbit::ellipse_of;
use super::schedule::{Activity, Schedule};
use crate::attitude::Attitude;
use crate::guidance::downlink::sun_direction::{SelectedSunDirection, SelectedSunDirections};
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::pointing::command::{BoresightOption, PointingCommand, Scenario};

/// Begin of a downlink, or of science that unloads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindowStart<'a> {
    /// Scenario that it belongs to: downlink or orbit phase.
    pub scenario: Scenario,
    /// Activity that begins.
    pub activity: Activity,
    /// Positions and motions at the begin.
    pub ephemeris: &'a EphemerisAtTime,
    /// The attitude as it is estimated.
    pub attitude: Attitude,
    /// Duration, in s.
    pub span_s: f64,
    /// Science and downlink from here on, in s past J2000 TDB; the scenario downlink counts on the windows of the orbit phase, of
    /// which one begins here. Places of the Sun are those of default attitudes.
    pub law: Guided,
}

/// Returns the rest of the window of a command; `None` where it has no selected direction of the Sun.
pub fn present_window<'e>(
    law: &Guided,
    command: &PointingCommand,
    ephemeris: &'e EphemerisAtTime,
    attitude: Attitude,
    periapses: &mut PeriapsisCount,
) -> Option<WindowStart<'e>> {
    let epoch_s = ephemeris.epoch_s;
    let windows = &in_present_orbit(&law.schedule, ephemeris);
    let scenario = command.scenario?;
    let (activity, schedule, span_s) = match scenario {
        Scenario::Downlink if command.boresight.option != Some(BoresightOption::PhasedArray) => {
            (Activity::Downlink, windows.begun_at(epoch_s), windows.downlink_s())
        }
        Scenario::OrbitPhase => {
            let schedule = periapses.windows(windows, ephemeris);
            let window = schedule.window(epoch_s);
            (window.activity, schedule, window.until_s - epoch_s)
        }
        _ => return None,
    };
    let is_selected = activity == Activity::Downlink || law.science.unloads();
    let law = Guided { schedule, ..*law };
    is_selected.then_some(WindowStart { scenario, activity, ephemeris, attitude, span_s, law })
}

/// Windows with fractions of the period taken of the orbit that the spacecraft is on.
fn in_present_orbit(windows: &Schedule, ephemeris: &EphemerisAtTime) -> Schedule {
    if windows.period_shares == [None; 2] {
        return *windows;
    }
    ellipse_of(ephemeris).map_or(*windows, |orbit| Schedule {
        period_s: windows.period_s,
        ..windows.in_orbit(orbit.period_s())
    })
}

/// Last selection.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct DownlinkSun {
    /// Directions that were selected last.
    pub selected: SelectedSunDirections,
    /// The scenario whose downlink lasts.
    lasts: Option<Scenario>,
    /// The timeline's entry that named the downlink, by when it begins on the timeline's clock, in s.
    entry: Option<f64>,
    /// Whether that science lasts.
    science_lasts: bool,
}

impl DownlinkSun {
    /// Whether a downlink lasts, or science that unloads, whose target is out of reach.
    pub fn is_clamped(&self) -> bool {
        let SelectedSunDirections { downlink, science } = self.selected;
        let present = if self.lasts.is_some() { downlink } else { science.filter(|_| self.science_lasts) };
        present.is_some_and(|chosen| chosen.clamped)
    }

    /// Selects the Sun's direction where a downlink begins, or science that unloads; returns whether one does. `entry` is the timeline's
    /// that names the scenario.
    pub fn update(
        &mut self,
        window: Option<&WindowStart<'_>>,
        entry: Option<f64>,
        choose: impl Fn(&WindowStart<'_>) -> Option<SelectedSunDirection>,
    ) -> bool {
        let Some(start) = window else {
            self.end();
            return false;
        };
        let is_span = start.span_s.is_finite() && start.span_s > 0.0;
        let chosen = || is_span.then(|| choose(start)).flatten();
        match start.activity {
            Activity::Downlink => self.last(start.scenario, entry, chosen),
            Activity::Science => self.last_in_science(chosen),
        }
    }

    /// Ends the downlink or the science that lasts.
    pub fn end(&mut self) {
        (self.lasts, self.science_lasts) = (None, false);
    }

    /// Science lasts that unloads; where it begins `choose` gives its place. Whether it begins.
    pub fn last_in_science(&mut self, choose: impl FnOnce() -> Option<SelectedSunDirection>) -> bool {
        self.lasts = None;
        let begins = !self.science_lasts;
        if begins {
            (self.selected.science, self.science_lasts) = (choose(), true);
        }
        begins
    }

    /// A downlink of `scenario` lasts, by `entry` of the timeline where one names it; where it begins `choose` gives its place.
    /// Whether it begins.
    pub fn last(
        &mut self,
        scenario: Scenario,
        entry: Option<f64>,
        choose: impl FnOnce() -> Option<SelectedSunDirection>,
    ) -> bool {
        self.science_lasts = false;
        let is_new_entry = scenario == Scenario::Downlink && entry.is_some() && entry != self.entry;
        let begins = self.lasts != Some(scenario) || is_new_entry;
        if begins {
            (self.selected.downlink, self.lasts) = (choose(), Some(scenario));
        }
        self.entry = entry.or(self.entry);
        begins
    }
}

#[cfg(test)]
mod tests {
    //! One choice a downlink, whatever goes on meanwhile.
    use super::*;
    use crate::attitude::SunAngles;
    use crate::guidance::downlink::sun_direction::DownlinkSunDirection;
    use core::cell::Cell;

    #[test]
    fn a_downlink_is_chosen_once_and_a_new_one_anew() {
        let count = Cell::new(0);
        let mut sun = DownlinkSun::default();
        let mut last = |scenario, entry| {
            sun.last(scenario, entry, || {
                count.set(count.get() + 1);
                let place = DownlinkSunDirection { angles: SunAngles::default(), earth_ahead: false };
                Some(SelectedSunDirection { place, clamped: true })
            });
            assert!(sun.is_clamped());
            count.get()
        };
        assert_eq!(last(Scenario::Downlink, None), 1);
        assert_eq!(last(Scenario::Downlink, None), 1);
        assert_eq!(last(Scenario::Downlink, Some(4.0)), 2);
        assert_eq!(last(Scenario::Downlink, None), 2);
        assert_eq!(last(Scenario::Downlink, Some(4.0)), 2);
        assert_eq!(last(Scenario::OrbitPhase, Some(5.0)), 3);
        assert_eq!(last(Scenario::OrbitPhase, Some(6.0)), 3);
        sun.end();
        assert!(!sun.is_clamped() && sun.selected.in_downlink().is_some());
        sun.last(Scenario::OrbitPhase, Some(6.0), || None);
        assert!(!sun.is_clamped() && sun.selected.in_downlink().is_none());
        // Science is chosen once too, and a downlink keeps its place for the slew out of it.
        let angles = SunAngles { azimuth_rad: 0.1, elevation_rad: -0.2 };
        let place = DownlinkSunDirection { angles, earth_ahead: false };
        assert!(
            sun.last_in_science(|| Some(SelectedSunDirection { place, clamped: true })) && sun.is_clamped()
        );
        assert!(!sun.last_in_science(|| None) && sun.is_clamped());
        sun.last(Scenario::OrbitPhase, Some(6.0), || None);
        assert!(!sun.is_clamped() && sun.selected.in_science() == Some(angles));
        assert!(sun.last_in_science(|| None) && !sun.is_clamped() && sun.selected.in_science().is_none());
    }
}
