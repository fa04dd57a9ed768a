//! A time after periapsis as a file writes it: s, a string with a unit, or a share of the orbital period.

use serde::Deserialize;
use serde::de::IgnoredAny;

use crate::constants::TIME_UNITS;
use crate::spacecraft::downlinks::TimeAfterPeriapsis;

/// Latest time, in s, and greatest share.
const LATEST_S: f64 = 1e9;
const GREATEST_SHARE: f64 = 1000.0;
/// Forms of a time, for messages.
pub(crate) const ALLOWED_TIME: &str = "a time from 0 to 1e9 s: a number in s or a string with a unit (s, ms, min, h, d, a), or a share of the period (\"20 %\")";

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
        let text = match self {
            Self::Number(number) => return in_range(TimeAfterPeriapsis::Seconds(*number)),
            Self::Text(text) => text.trim(),
            Self::Other(_) => return None,
        };
        let end = text.rfind(|c: char| c.is_ascii_digit() || c == '.')? + 1;
        let (number, unit) = text.split_at_checked(end)?;
        let (number, unit): (f64, _) = (number.parse().ok()?, unit.trim());
        in_range(match unit {
            "%" => TimeAfterPeriapsis::PeriodShare(number / 100.0),
            _ => TimeAfterPeriapsis::Seconds(number * TIME_UNITS.iter().find(|(name, _)| *name == unit)?.1),
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

#[cfg(feature = "schema")]
impl schemars::JsonSchema for WrittenTime {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> std::borrow::Cow<'static, str> {
        "WrittenTime".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({ "type": ["number", "string"] })
    }
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
