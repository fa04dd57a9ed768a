//! The scan of a command: a scenario that has scans, numbers of its frame, motions that last, an aimpoint that its frame goes with.

use super::commands::named;
use super::description::{CommandDescription, ScanDescription};
use super::quantity::{RATE, SPEED, TIME, three};
use super::reads::{scan_keys, tables};
use crate::guidance::pointing::aimpoint::{self, AimpointKind};
use crate::guidance::pointing::command::{AimpointOption, PointingCommand, ScanCommand, Scenario};
use crate::guidance::pointing::scan::ScanCompatibility;
use crate::toml::Place;

/// Greatest number of segments.
const MOST_SEGMENTS: u32 = 1_000_000;

/// The scan of a command; none where there is none or its scenario has none, which is reported elsewhere.
pub(super) fn scan(
    at: &Place<'_>,
    description: &CommandDescription,
    command: &PointingCommand,
) -> ScanCommand {
    let scenario = command.scenario.filter(|scenario| tables(*scenario).has("scan"));
    let (Some(given), Some(scenario)) = (&description.scan, scenario) else { return ScanCommand::default() };
    let at = at.key("scan");
    if !at.key("frame").is_stand_in() {
        let known = &["reference", "rate", "speed", "duration", "pause", "segments", "reverse"];
        scan_keys(given.frame).check(&at, known, &named("the frame", given.frame));
        let kind = aimpoint_kind(scenario, command.aimpoint.option);
        if kind.is_some_and(|kind| !ScanCompatibility::default().allows(given.frame, kind)) {
            let found = named("the frame", given.frame) + ", which does not go with this aimpoint";
            at.key("frame").report(found, "a frame that does: body, inertialRotation ...");
        }
    }
    let three = |key: &str, given: &Option<_>, kind| three(&at.key(key), given.as_ref(), kind);
    let scan = ScanCommand {
        frame: Some(given.frame),
        reference: given.reference,
        rate_rad_s: three("rate", &given.rate, &RATE),
        speed_m_s: three("speed", &given.speed, &SPEED),
        duration_s: three("duration", &given.duration, &TIME),
        pause_s: three("pause", &given.pause, &TIME),
        segments: given.segments.unwrap_or_default(),
        reverse: given.reverse.unwrap_or_default(),
    };
    check_motions(&at, given, &scan);
    scan
}

/// An axis moves, every axis that does for a time, and no time is negative.
fn check_motions(at: &Place<'_>, given: &ScanDescription, scan: &ScanCommand) {
    for (key, times_s) in [("duration", scan.duration_s), ("pause", scan.pause_s)] {
        for (axis, time_s) in times_s.into_iter().enumerate().filter(|(_, time_s)| *time_s < 0.0) {
            at.key(key).item(axis).report(format_args!("{time_s} s"), "a time from 0 s");
        }
    }
    for (axis, segments) in scan.segments.into_iter().enumerate() {
        if segments > MOST_SEGMENTS {
            let allowed = format!("0 (without end) to {MOST_SEGMENTS}");
            at.key("segments").item(axis).report(segments, allowed);
        }
    }
    for (key, rates) in [("rate", scan.rate_rad_s), ("speed", scan.speed_m_s)] {
        if !at.key(key).is_written() || at.key(key).has_reported() {
            continue;
        }
        if rates == [0.0; 3] {
            at.key(key).report("zero on every axis", "an axis that moves, or no scan");
        }
        for (axis, _) in rates.into_iter().enumerate().filter(|(_, rate)| *rate != 0.0) {
            if given.duration.is_some() && scan.duration_s[axis] == 0.0 {
                let place = at.key("duration").item(axis);
                place.report_across("0 s for an axis that moves", "a time above 0 s");
            }
        }
    }
}

/// Kind of the aimpoint of a scenario; `None` where no aimpoint is given.
fn aimpoint_kind(scenario: Scenario, aimpoint: Option<AimpointOption>) -> Option<AimpointKind> {
    match scenario {
        Scenario::Nadir | Scenario::LimbTerminator | Scenario::LimbGeneric => Some(AimpointKind::PlanetPoint),
        Scenario::Downlink | Scenario::Burn | Scenario::OrbitPhase => None,
        Scenario::Generic | Scenario::PlusZ | Scenario::Gimbal | Scenario::DoubleTarget => {
            aimpoint.map(aimpoint::aimpoint_kind)
        }
    }
}
