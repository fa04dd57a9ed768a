//! Window of downlink or of science that unloads at a sample: the one whose direction of the Sun is selected.

use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::orbit_phase::guided::Guided;
use crate::guidance::orbit_phase::periapsis_count::PeriapsisCount;
use crate::guidance::orbit_phase::predicted_orbit::ellipse_of;
use crate::guidance::orbit_phase::schedule::{Activity, Schedule};
use crate::guidance::pointing::command::{BoresightOption, PointingCommand, Scenario};

/// Window at a sample.
pub(super) struct PresentWindow {
    /// Scenario that it belongs to: downlink or orbit phase.
    pub scenario: Scenario,
    /// Downlink, or science that unloads.
    pub activity: Activity,
    /// Windows from here on, in s past J2000 TDB.
    pub schedule: Schedule,
    /// Remaining time, in s.
    pub span_s: f64,
}

impl PresentWindow {
    /// Returns the window of a command; `None` where it has no selected direction of the Sun.
    pub(super) fn find(
        law: &Guided,
        command: &PointingCommand,
        ephemeris: &EphemerisAtTime,
        periapses: &mut PeriapsisCount,
    ) -> Option<Self> {
        let epoch_s = ephemeris.epoch_s;
        let windows = &in_present_orbit(&law.schedule, ephemeris);
        match command.scenario? {
            scenario @ Scenario::Downlink => {
                let is_free = command.boresight.option != Some(BoresightOption::PhasedArray);
                let span_s = windows.downlink_end_s - windows.downlink_start_s;
                let schedule = windows.begun_at(epoch_s);
                is_free.then_some(Self { scenario, activity: Activity::Downlink, schedule, span_s })
            }
            scenario @ Scenario::OrbitPhase => {
                let schedule = periapses.windows(windows, ephemeris);
                let window = schedule.window(epoch_s);
                let activity = window.activity;
                let is_selected = activity == Activity::Downlink || law.science.unloads();
                let span_s = window.until_s - epoch_s;
                is_selected.then_some(Self { scenario, activity, schedule, span_s })
            }
            _ => None,
        }
    }
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
