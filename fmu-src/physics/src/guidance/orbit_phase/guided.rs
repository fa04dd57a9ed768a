//! The guided attitude over a whole orbit phase: science, downlink, and the slews between them.

use serde::{Deserialize, Serialize};

use crate::attitude::{MovingFrame, SunAngles};

use super::attitudes::{
    AttitudeCommand, LinesOfSight, ScienceRule, Sight, downlink, downlink_toward, downlink_with, science,
    sun_pointing,
};
use super::schedule::{Activity, Schedule, Window};
use crate::guidance::constraints::keep_in::KeepIn;
use crate::guidance::constraints::slew::{Slew, SlewStart, SlewedFrame};
use crate::guidance::downlink::default_downlink::DefaultDownlink;
use crate::guidance::downlink::sun_direction::{DownlinkSunDirection, SelectedSunDirections, SunRequest};

/// The guidance law of the orbital phase.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guided {
    /// Science and downlink windows.
    pub schedule: Schedule,
    /// Pitch during science.
    pub science: ScienceRule,
    /// Keep-in limit of the Sun's elevation, in rad.
    pub elevation_limit_rad: f64,
    /// Turn rate between the two attitudes, in rad/s; 0 = at once, as in paper 000.
    pub slew_rate_rad_s: f64,
    /// Zone that turns do not leave where it holds both ends; `None`: they go about one axis.
    pub keep_in: Option<KeepIn>,
    /// Direction of the Sun during the present downlink, and during the slew out of it; `None`: on -Y.
    pub sun_direction: Option<DownlinkSunDirection>,
    /// Requested direction of the Sun in downlinks without a selected one, and whether they are turned about the Sun line.
    pub requested: SunRequest,
    /// Whether that direction is selected anew where a downlink begins, and that of science where it unloads.
    pub managed: bool,
}

/// The guided attitude at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GuidedAttitude {
    /// Body frame and rate.
    pub frame: MovingFrame,
    /// Present window: the activity, its begin and its end.
    pub window: Window,
    /// The timeline's command, from 1, whose window it is; 0 of none.
    pub row: usize,
    /// Whether it is turning from one attitude to the other.
    pub slewing: bool,
    /// See [`AttitudeCommand::margins`].
    pub margins: [f64; 2],
    /// Whether a place of the Sun that was requested is not allowed.
    pub clamped: bool,
    /// Whether a substitute stands in for a target on one line with the other.
    pub degenerate: bool,
    /// When the next motion of a scan begins or ends, in the schedule's time scale; infinite without one.
    pub corner_s: f64,
    /// When window or slew ends, in the schedule's time scale; infinite where nothing ends. Until then the attitude is
    /// smooth between two roots of the margins.
    pub until_s: f64,
}

impl GuidedAttitude {
    /// Returns a commanded attitude that is kept through its window, up to the next corner of a scan.
    pub fn held(command: AttitudeCommand, window: Window) -> Self {
        let AttitudeCommand { frame, margins, clamped, degenerate, corner_s } = command;
        let until_s = window.until_s.min(corner_s);
        Self { frame, window, row: 0, slewing: false, margins, clamped, degenerate, corner_s, until_s }
    }
}

/// Status of a downlink, as the outputs report it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct DownlinkStatus {
    /// Whether one lasts, the turn to it done.
    pub active: bool,
    /// Whether Sun, Earth and antennas keep the Sun from the place that it was to have.
    pub clamped: bool,
}

impl DownlinkStatus {
    /// Status of the downlink in a guided attitude.
    pub fn from_attitude(guided: &GuidedAttitude) -> Self {
        let active = guided.window.activity == Activity::Downlink && !guided.slewing;
        Self { active, clamped: active && guided.clamped }
    }
}

impl Guided {
    /// Returns the law with these directions of the Sun in downlink and in science that unloads; on -Y without one.
    #[must_use]
    pub fn with_sun_directions(self, selected: &SelectedSunDirections) -> Self {
        let science = self.science.with_sun(selected.in_science().unwrap_or_default());
        Self { sun_direction: selected.in_downlink(), science, ..self }
    }
}

/// Guidance of the orbit phase with the default downlink of the spacecraft's antennas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrbitPhaseLaw<'a> {
    /// Settings.
    pub guided: Guided,
    /// Downlink without a requested direction of the Sun.
    pub default_downlink: &'a DefaultDownlink,
}

impl OrbitPhaseLaw<'_> {
    /// Attitude at `time_s` (time scale of the schedule). `sight_at` gives what surrounds the spacecraft at any time.
    pub fn at<S: Sight>(&self, time_s: f64, sight_at: impl FnMut(f64) -> S) -> GuidedAttitude {
        self.within(self.guided.schedule.window(time_s), time_s, sight_at)
    }

    /// The same in a window found by other means than the schedule's own counting.
    pub fn within<S: Sight>(
        &self,
        window: Window,
        time_s: f64,
        mut sight_at: impl FnMut(f64) -> S,
    ) -> GuidedAttitude {
        let sight = sight_at(time_s);
        let Guided { slew_rate_rad_s, keep_in, .. } = &self.guided;
        let target = self.command(window.activity, &sight);
        let held = GuidedAttitude::held(target, window);
        if slew_rate_rad_s.is_nan() || *slew_rate_rad_s <= 0.0 || !window.since_s.is_finite() {
            return held;
        }
        let longest_s = Slew::longest_rad(keep_in.as_ref()) / slew_rate_rad_s;
        if time_s - window.since_s >= longest_s {
            return held;
        }
        let before = match window.activity {
            Activity::Science => Activity::Downlink,
            Activity::Downlink => Activity::Science,
        };
        let sight_then = sight_at(window.since_s);
        let from = self.command(before, &sight_then).frame;
        let to = self.command(window.activity, &sight_then).frame;
        let lines_then = sight_then.lines();
        let start = SlewStart {
            from: &from,
            to: &to,
            to_sun: lines_then.sun.direction,
            sun_drift_rad_s: self.sun_drift_rad_s(window.activity, &lines_then, &to),
        };
        let slew = Slew::between(&start, keep_in.as_ref(), *slew_rate_rad_s);
        let sun = sight.lines().sun;
        let slewed = slew.at(window.since_s, time_s, &target.frame, &sun, *slew_rate_rad_s);
        slewed.map_or(held, |SlewedFrame { frame, end_s }| GuidedAttitude {
            frame,
            slewing: true,
            until_s: held.until_s.min(end_s),
            ..held
        })
    }

    /// Bound of the rate at which the Sun moves in the body frame during a turn to an attitude, in rad/s: twice what the lines
    /// of sight allow where the turn begins.
    fn sun_drift_rad_s(&self, activity: Activity, lines: &LinesOfSight, to: &MovingFrame) -> f64 {
        let is_default = self.guided.sun_direction.is_none();
        let gain = match (activity, self.guided.science) {
            (Activity::Downlink, _) if is_default && self.default_downlink.moves_the_sun() => {
                return 2.0 * (lines.earth.rate_1_s.norm() + lines.sun.rate_1_s.norm());
            }
            (Activity::Downlink, _) | (Activity::Science, ScienceRule::Unloading { .. }) => return 0.0,
            (Activity::Science, ScienceRule::Scaled { gain }) => gain.abs(),
            (Activity::Science, ScienceRule::Nadir | ScienceRule::PlanetOrbit) => 1.0,
            (Activity::Science, ScienceRule::Aligned { .. }) => {
                let to_body = to.inertial_from_body.inverse();
                let turning = to.rate_body_rad_s.cross(&(to_body * lines.sun.direction));
                return 2.0 * (to_body * lines.sun.rate_1_s - turning).norm();
            }
        };
        let planet_rad_s = lines.planet.map_or(0.0, |planet| planet.rate_1_s.norm());
        2.0 * gain * (planet_rad_s + lines.sun.rate_1_s.norm())
    }

    fn command(&self, activity: Activity, sight: &impl Sight) -> AttitudeCommand {
        let lines = &sight.lines();
        let Guided { science: rule, elevation_limit_rad, sun_direction, requested, .. } = &self.guided;
        let SunRequest { sun, alternate, .. } = *requested;
        let found = match (activity, sun_direction) {
            (Activity::Science, _) => science(lines, || sight.ephemeris(), *rule, *elevation_limit_rad),
            (Activity::Downlink, Some(place)) => downlink_toward(lines, place),
            (Activity::Downlink, None) if sun != SunAngles::default() => {
                downlink_with(lines, sun, self.default_downlink.antennas())
            }
            (Activity::Downlink, None) => downlink(lines, self.default_downlink),
        };
        let command = found.unwrap_or_else(|| sun_pointing(lines));
        // Turned by 180 deg about the Sun line: the Sun stays in its place.
        let is_turned = alternate && activity == Activity::Downlink;
        let frame = if is_turned { command.frame.half_turned(&lines.sun) } else { command.frame };
        AttitudeCommand { frame, ..command }
    }
}

#[cfg(test)]
mod tests;
