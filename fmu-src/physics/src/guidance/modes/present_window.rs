//! Window of downlink or of science that unloads at a sample: the one whose direction of the Sun is selected.

use crate::attitude::Attitude;
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::orbit_phase::downlink_sun::WindowStart;
use crate::guidance::orbit_phase::guided::Guided;
use crate::guidance::orbit_phase::periapsis_count::PeriapsisCount;
use crate::guidance::orbit_phase::predicted_orbit::ellipse_of;
use crate::guidance::orbit_phase::schedule::{Activity, Schedule};
use crate::guidance::pointing::command::{BoresightOption, PointingCommand, Scenario};

/// Returns the rest of the window of a command; `None` where it has no selected direction of the Sun.
pub(super) fn present_window<'e>(
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
