//! Downlink windows of a spacecraft's file, counted from periapsis.

use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};

use super::part_reader::PartReader;
use super::start::StartEntry;
use crate::constants::TIME_UNITS;
use crate::toml::{Orbits, in_units, tables, type_schema, with_unit};

tables! {
/// When an antenna looks at the Earth, counted from periapsis; left out, there are no downlinks. The start values of
/// `guided.downlinkStart`, `guided.downlinkEnd`, `guided.downlinkEvery`, which `[start]` does not have beside it.
struct DownlinksDescription {
    /// Begin after periapsis: s, a string with a unit ("2 h"), or a share of the orbital period ("20 %").
    start: WrittenTime,
    /// End, after the begin, likewise.
    stop: WrittenTime,
    /// A downlink after every how many periapses; 0 is none.
    every: Orbits = 0,
}
}

/// A time after periapsis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum TimeAfterPeriapsis {
    /// In s.
    Seconds(f64),
    /// As a share of the orbital period.
    PeriodShare(f64),
}

/// When an antenna looks at the Earth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct DownlinkWindows {
    /// Begin.
    pub start: TimeAfterPeriapsis,
    /// End.
    pub stop: TimeAfterPeriapsis,
    /// A downlink after every how many periapses; 0 is none.
    pub every: u32,
}

impl TimeAfterPeriapsis {
    /// In an orbit of this period, in s.
    pub fn in_orbit_s(self, period_s: f64) -> f64 {
        match self {
            Self::Seconds(time_s) => time_s,
            Self::PeriodShare(share) => share * period_s,
        }
    }

    /// The share; `None` where it is no share.
    pub fn period_share(self) -> Option<f64> {
        let Self::PeriodShare(share) = self else { return None };
        Some(share)
    }
}

/// Latest time, in s, and greatest share.
const LATEST_S: f64 = 1e9;
const GREATEST_SHARE: f64 = 1000.0;
/// Forms of a time, for messages.
const ALLOWED_TIME: &str = "a time from 0 to 1e9 s: a number in s or a string with a unit (s, ms, min, h, d, a), or a share of the period (\"20 %\")";

/// A time after periapsis as it is written.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub(crate) enum WrittenTime {
    /// A number, s.
    Number(f64),
    /// A string.
    Text(String),
    /// A value that is neither a number nor a string.
    Other(IgnoredAny),
}

impl WrittenTime {
    /// The time; `None` where this is none.
    pub(crate) fn read(&self) -> Option<TimeAfterPeriapsis> {
        in_range(match self {
            Self::Number(number) => TimeAfterPeriapsis::Seconds(*number),
            Self::Text(text) => match with_unit(text)? {
                (number, "%") => TimeAfterPeriapsis::PeriodShare(number / 100.0),
                _ => TimeAfterPeriapsis::Seconds(in_units(text, &TIME_UNITS)?),
            },
            Self::Other(_) => return None,
        })
    }

    /// Returns the value as messages show it.
    pub(crate) fn found(&self) -> String {
        match self {
            Self::Number(number) => number.to_string(),
            Self::Text(text) => format!("{text:?}"),
            Self::Other(_) => "neither a number nor a string".to_owned(),
        }
    }
}

fn in_range(time: TimeAfterPeriapsis) -> Option<TimeAfterPeriapsis> {
    let is_in = match time {
        TimeAfterPeriapsis::Seconds(time_s) => (0.0..=LATEST_S).contains(&time_s),
        TimeAfterPeriapsis::PeriodShare(share) => (0.0..=GREATEST_SHARE).contains(&share),
    };
    is_in.then_some(time)
}

type_schema!([] WrittenTime, inline: true, "WrittenTime", |_| {
    schemars::json_schema!({ "type": ["number", "string"] })
});

/// Reads the windows.
pub(super) fn downlinks(
    part: &PartReader<'_>,
    description: &DownlinksDescription,
    start: &[StartEntry],
    has_antenna: bool,
) -> DownlinkWindows {
    let time = |key: &str, written: &WrittenTime| {
        let read = part.key(key).known(written.read(), written.found(), ALLOWED_TIME);
        read.unwrap_or(TimeAfterPeriapsis::Seconds(0.0))
    };
    let (begin, end) = (time("start", &description.start), time("stop", &description.stop));
    let are_alike = begin.period_share().is_some() == end.period_share().is_some();
    let is_backwards = are_alike && end.in_orbit_s(1.0) <= begin.in_orbit_s(1.0);
    if is_backwards && !part.key("start").has_reported() && !part.key("stop").has_reported() {
        part.key("stop").report(description.stop.found(), "a time after the start");
    }
    if let Some(entry) = start.iter().find(|it| !it.is_fixed && it.name.starts_with("guided.downlink")) {
        let allowed = format!("one of both: [downlinks], or {} in [start]", entry.name);
        part.report(format!("[downlinks] beside {}", entry.key), allowed);
    }
    let every = description.every();
    if every > 0 && !has_antenna && !part.key("every").has_reported() {
        let allowed = "0, no downlink, where the spacecraft has no antenna ([[antennas]])";
        part.key("every").report(every, allowed);
    }
    DownlinkWindows { start: begin, stop: end, every }
}

#[cfg(test)]
mod tests {
    //! Units are converted; what is no time is none.

    use super::*;

    #[test]
    fn times_and_shares_are_read() {
        use TimeAfterPeriapsis::{PeriodShare, Seconds};
        let read = |text: &str| WrittenTime::Text(text.to_owned()).read();
        for (text, expected) in [
            ("2 h", Seconds(7_200.0)),
            ("1.5min", Seconds(90.0)),
            ("3 d", Seconds(259_200.0)),
            ("40 s", Seconds(40.0)),
            ("2 a", Seconds(63_115_200.0)),
            ("20 %", PeriodShare(0.2)),
            ("0%", PeriodShare(0.0)),
        ] {
            assert_eq!(read(text), Some(expected), "{text}");
        }
        for text in ["", "h", "2", "2 km", "-1 h", "inf s", "2e9 s", "200001 %", "%"] {
            assert_eq!(read(text), None, "{text}");
        }
        assert_eq!(WrittenTime::Number(30.0).read(), Some(Seconds(30.0)));
        assert_eq!(WrittenTime::Number(-30.0).read(), None);
    }
}
