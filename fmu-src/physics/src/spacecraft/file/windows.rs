//! Downlink windows, hot pole, corridor of light and what wheels are sized for, from their descriptions.

use super::describe_operation::{
    ArticulationDescription, DownlinksDescription, HotPoleDescription, MomentumDescription,
};
use super::part_reader::PartReader;
use super::written_time::{ALLOWED_TIME, WrittenTime};
use crate::spacecraft::articulation::Articulation;
use crate::spacecraft::downlinks::{DownlinkWindows, TimeAfterPeriapsis};
use crate::spacecraft::hot_pole::HotPoleZone;
use crate::spacecraft::slew::SlewDemand;
use crate::spacecraft::start::StartEntry;

pub(crate) fn downlinks(
    part: &mut PartReader<'_, '_>,
    description: &DownlinksDescription,
    start: &[StartEntry],
    has_antenna: bool,
) -> DownlinkWindows {
    let mut time = |key: &str, written: &WrittenTime| {
        written.read().unwrap_or_else(|| {
            part.report(key, written.found(), ALLOWED_TIME);
            TimeAfterPeriapsis::Seconds(0.0)
        })
    };
    let (begin, end) = (time("start", &description.start), time("stop", &description.stop));
    let is_backwards = match (begin, end) {
        (TimeAfterPeriapsis::Seconds(begin), TimeAfterPeriapsis::Seconds(end))
        | (TimeAfterPeriapsis::PeriodShare(begin), TimeAfterPeriapsis::PeriodShare(end)) => end <= begin,
        _ => false,
    };
    if is_backwards && !part.has_reported("start") && !part.has_reported("stop") {
        part.report("stop", description.stop.found(), "a time after the start");
    }
    if let Some(entry) = start.iter().find(|it| !it.is_fixed && it.name.starts_with("guided.downlink")) {
        let allowed = format!("one of both: [downlinks], or {} in [start]", entry.name);
        part.check.report(&part.at, format!("[downlinks] beside {}", entry.key), allowed);
    }
    let every = description.every();
    if every > 0 && !has_antenna && !part.has_reported("every") {
        let allowed = "0, no downlink, where the spacecraft has no antenna ([[antennas]])";
        part.report("every", every, allowed);
    }
    DownlinkWindows { start: begin, stop: end, every }
}

/// Time between unloadings.
pub(crate) fn unload_every(
    part: &mut PartReader<'_, '_>,
    description: &MomentumDescription,
) -> Option<TimeAfterPeriapsis> {
    let written = description.unload_every.as_ref()?;
    let is_some = |time: &TimeAfterPeriapsis| match time {
        TimeAfterPeriapsis::Seconds(length) | TimeAfterPeriapsis::PeriodShare(length) => *length > 0.0,
    };
    let read = written.read().filter(is_some);
    if read.is_none() {
        let allowed = "a time above 0, up to 1e9 s: a number in s or a string with a unit (s, min, h, d), or a share of the \
                       period (\"100 %\")";
        part.report("unload_every", written.found(), allowed);
    }
    read
}

/// The slew that wheels are sized for.
pub(crate) fn slew(part: &mut PartReader<'_, '_>, description: &MomentumDescription) -> Option<SlewDemand> {
    let written = description.slew.as_ref()?;
    let read = SlewDemand::read(written);
    if read.is_none() {
        part.report("slew", format_args!("{written:?}"), SlewDemand::ALLOWED);
    }
    read
}

pub(crate) fn hot_pole(description: &HotPoleDescription) -> HotPoleZone {
    HotPoleZone {
        altitude_m: description.altitude_m(),
        angle_rad: description.angle_rad(),
        cone_rad: description.cone_rad(),
    }
}

pub(crate) fn articulation(
    part: &mut PartReader<'_, '_>,
    description: &ArticulationDescription,
) -> Articulation {
    let found = Articulation {
        min_suns: description.min_suns(),
        max_suns: description.max_suns(),
        target_suns: description.target_suns(),
    };
    let Articulation { min_suns, max_suns, target_suns } = found;
    if ["min_suns", "max_suns", "target_suns"].iter().any(|key| part.has_reported(key)) {
        return found;
    }
    if max_suns <= min_suns {
        part.report_across("max_suns", max_suns, format_args!("more than min_suns, {min_suns}"));
    } else if found.margin_suns(target_suns) < 0.0 {
        let allowed = format_args!("from min_suns to max_suns, {min_suns} to {max_suns}");
        part.report_across("target_suns", target_suns, allowed);
    }
    found
}
