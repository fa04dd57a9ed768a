//! The attitude that a timeline commands as a function of time: its scenarios, scans and keep-in zone by Guidance's own laws, whose
//! clocks count from the beginning of a command.
//!
//! Between two edges ([`Slot`]) and two corners of a scan the attitude is smooth but where the keep-in zone begins to act, which is a
//! root of the margin. Where nothing is commanded, or what is has no direction, the orbit phase's own law rules.

use super::build::Timeline;
use super::entry::{TimelineEntry, simulation_time_s};
use crate::bodies::Body;
use crate::guidance::constraints::keep_in::{KeepIn, within_zone};
use crate::guidance::geometry::ephemeris_at_time::{EphemerisAtTime, TargetPlanet};
use crate::guidance::geometry::moving::value;
use crate::guidance::orbit_phase::attitudes::AttitudeCommand;
use crate::guidance::orbit_phase::guided::Guided;
use crate::guidance::pointing::command::{AimpointOption, PointingCommand};
use crate::guidance::pointing::scan::{ScanTime, next_corner_s};
use crate::guidance::scenario::{GuidanceHardware, PointingProgress, pointing_solution};
use crate::numerics::spacing::spacing;

/// Settings by parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimelineSettings {
    /// The keep-in zone, in force or not.
    pub keep_in: KeepIn,
    /// Whether it is in force where the timeline does not say so.
    pub keep_in_is_enabled: bool,
    /// The planet that is orbited.
    pub planet: TargetPlanet,
    /// The clock of the timeline minus the time of the simulation, in s.
    pub clock_minus_time_s: f64,
}

impl TimelineSettings {
    /// The keep-in zone in force under a command this far from the Sun.
    pub fn keep_in(&self, entry: &TimelineEntry, sun_distance_m: f64) -> Option<KeepIn> {
        let zone = entry.keep_in.applied(&self.keep_in, self.keep_in_is_enabled);
        zone.filter(|zone| sun_distance_m <= zone.distance_m)
    }
}

/// A timeline with what its scenarios point.
#[derive(Clone, Copy, Debug)]
pub struct TimelineLaw<'a> {
    /// The commands.
    pub timeline: &'a Timeline,
    /// Instruments, gimbal, antennas.
    pub hardware: GuidanceHardware<'a>,
}

/// Bodies that a command aims at.
pub fn bodies_of(command: &PointingCommand) -> impl Iterator<Item = Body> + '_ {
    let aimpoints = [&command.aimpoint, &command.second_aimpoint].into_iter();
    aimpoints.filter(|it| it.option == Some(AimpointOption::Body)).filter_map(|it| it.body)
}

impl TimelineLaw<'_> {
    /// The attitude of a command at `time_s` of the simulation, the Sun of its downlinks in the direction that `guided` selects or requests;
    /// `None` where it has no scenario of its own, or boresight, aimpoint or Sun no direction.
    pub fn attitude(
        &self,
        settings: &TimelineSettings,
        entry: &TimelineEntry,
        time_s: f64,
        ephemeris: &EphemerisAtTime,
        guided: &Guided,
    ) -> Option<AttitudeCommand> {
        let begin_s = simulation_time_s(entry.at_s, settings.clock_minus_time_s);
        let elapsed_s = time_s - begin_s;
        let scan = ScanTime { elapsed_s, tolerance_s: 4.0 * (spacing(entry.at_s) + spacing(time_s)) };
        let to_sun = ephemeris.to_sun();
        let keep_in = settings.keep_in(entry, value(&to_sun).norm());
        let requested = guided.requested.within(keep_in.as_ref());
        let progress = PointingProgress {
            scan: entry.command.scan.frame.map(|_| scan),
            limb_elapsed_s: elapsed_s,
            downlink_sun: guided.sun_direction.filter(|_| entry.downlink.sun.is_none()),
            requested,
            burn: None,
        };
        let solution = pointing_solution(&entry.command, &self.hardware, ephemeris, &progress)?;
        let is_held = requested.is_moved || solution.downlink.active;
        let kept = within_zone(&solution.vectors, keep_in.as_ref(), &to_sun, is_held)?;
        let corner_s = next_corner_s(&entry.command.scan, scan).map_or(f64::INFINITY, |it| it + begin_s);
        let [form, bound] = solution.margins;
        Some(AttitudeCommand {
            clamped: solution.downlink.clamped || requested.is_moved || kept.is_moved,
            degenerate: kept.pointing.degenerate,
            corner_s,
            ..AttitudeCommand::new(kept.pointing.frame(), [kept.margin.min(bound), form])
        })
    }
}
