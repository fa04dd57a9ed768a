//! Clocks of a command: begins of its scan and limb scenario, and the timeline's entries that they follow.

use serde::{Deserialize, Serialize};

use super::sample_inputs::TimedEntries;
use crate::guidance::pointing::command::{PointingCommand, ScanCommand, Scenario};
use crate::guidance::pointing::scan::ScanTime;
use crate::numerics::spacing::spacing;

/// Begins of scan and limb scenario.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct CommandTimers {
    /// Timeline's entries at the last sample.
    pub entries: TimedEntries,
    /// Scan and the time since when it is commanded, in s.
    scan: Option<(ScanCommand, f64)>,
    /// Limb scenario and the time since when it is commanded, in s.
    limb: Option<(Scenario, f64)>,
}

impl CommandTimers {
    /// Whether these entries begin a scenario of the timeline.
    pub(super) fn is_new_scenario(&self, entries: &TimedEntries) -> bool {
        entries.scenario.is_some() && entries.scenario != self.entries.scenario
    }

    /// Begins a scan where it is first commanded or changes, a limb scenario where it is; one of a timeline with its entry.
    pub(super) fn update(&mut self, command: &PointingCommand, entries: TimedEntries, time_s: f64) {
        if entries.scan != self.entries.scan {
            self.scan = None;
        }
        if entries.scenario != self.entries.scenario {
            self.limb = None;
        }
        self.entries = entries;
        self.scan = since(self.scan, command.scan.frame.map(|_| command.scan), time_s);
        let limb =
            command.scenario.filter(|it| matches!(it, Scenario::LimbTerminator | Scenario::LimbGeneric));
        self.limb = since(self.limb, limb, time_s);
    }

    /// Time of the scan at `time_s`; `None` while there is none.
    pub(super) fn scan_time(&self, time_s: f64) -> Option<ScanTime> {
        self.scan
            .map(|(_, since_s)| ScanTime { elapsed_s: time_s - since_s, tolerance_s: 4.0 * spacing(time_s) })
    }

    /// Time since the limb scenario began, in s; 0 without one.
    pub(super) fn limb_elapsed_s(&self, time_s: f64) -> f64 {
        self.limb.map_or(0.0, |(_, since_s)| time_s - since_s)
    }
}

/// The present command with the time since when, in s: that of the last sample where it is the same.
fn since<T: PartialEq>(last: Option<(T, f64)>, now: Option<T>, time_s: f64) -> Option<(T, f64)> {
    let since_s = last.filter(|(before, _)| now.as_ref() == Some(before)).map(|(_, since_s)| since_s);
    now.map(|now| (now, since_s.unwrap_or(time_s)))
}
