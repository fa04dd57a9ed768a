//! Dates as people write them: a calendar date, a time of day and the name of the time scale, to an epoch.
//!
//! `2008-03-19T19:30:00.5 UTC`: year, month and day, then, unless it is midnight, hours, minutes and possibly seconds with
//! at most nine decimals, then `UTC` or `TDB`. UTC has whole leap seconds since 1972 (as announced by the IERS), and a
//! minute that has one has a second 60. TDB differs from TT by its annual term of 1.7 ms (hifitime's, after Archinal).

use core::fmt;

use hifitime::{Epoch, TimeScale};

/// What a date looks like, for messages.
pub const ALLOWED_DATE: &str = "a date such as \"2008-03-19T19:30:00 UTC\" or \"2008-03-19 TDB\"";

/// First year of UTC with leap seconds.
const FIRST_UTC_YEAR: i32 = 1972;

/// What is wrong with a date.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DateError {
    /// It is written otherwise.
    Form,
    /// It does not end in a known time scale.
    Scale,
    /// There is no such day.
    Day,
    /// There is no such time on that day.
    Time,
    /// UTC had no leap seconds yet.
    BeforeUtc,
}

impl fmt::Display for DateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Form => "which is no date",
            Self::Scale => "which does not end in UTC or TDB",
            Self::Day => "a day that no calendar has",
            Self::Time => "a time that this day does not have",
            Self::BeforeUtc => "a year before UTC had leap seconds (1972): give TDB",
        })
    }
}

impl std::error::Error for DateError {}

/// Whether a text begins as a date does: four digits and a hyphen.
pub fn looks_like_date(text: &str) -> bool {
    let bytes = text.trim_start().as_bytes();
    bytes.len() > 4 && bytes[..4].iter().all(u8::is_ascii_digit) && bytes[4] == b'-'
}

/// The epoch of a date, in s past J2000 TDB.
///
/// # Errors
///
/// What is wrong with the text.
pub fn epoch_s(text: &str) -> Result<f64, DateError> {
    let text = text.trim();
    let (text, scale) = [("UTC", TimeScale::UTC), ("TDB", TimeScale::TDB)]
        .into_iter()
        .find_map(|(name, scale)| Some((text.strip_suffix(name)?.trim_end(), scale)))
        .ok_or(if looks_like_date(text) { DateError::Scale } else { DateError::Form })?;
    let (day, time) = text.split_once(['T', ' ']).unwrap_or((text, "00:00"));
    let [year, month, day] = numbers(day, '-', [4, 2, 2]).ok_or(DateError::Form)?;
    let (whole, fraction) = time.split_once('.').unwrap_or((time, "0"));
    let [hour, minute, second] = match (numbers(whole, ':', [2, 2]), fraction) {
        (Some([hour, minute]), "0") if whole == time => [hour, minute, 0],
        _ => numbers(whole, ':', [2, 2, 2]).ok_or(DateError::Form)?,
    };
    let nanoseconds = match fraction.len() {
        digits @ 1..=9 => number(fraction, digits).ok_or(DateError::Form)? * 10_u32.pow(9 - digits as u32),
        _ => return Err(DateError::Form),
    };
    let small = |number: u32| u8::try_from(number).unwrap_or(u8::MAX);
    let (year, month, day) = (year as i32, small(month), small(day));
    let epoch = |hour: u32, minute: u32, second: u32| {
        let (hour, minute, second) = (small(hour), small(minute), small(second));
        Epoch::maybe_from_gregorian(year, month, day, hour, minute, second, nanoseconds, scale)
    };
    epoch(0, 0, 0).map_err(|_| DateError::Day)?;
    if scale == TimeScale::UTC && year < FIRST_UTC_YEAR {
        return Err(DateError::BeforeUtc);
    }
    if hour > 23 {
        return Err(DateError::Time);
    }
    let found = epoch(hour, minute, second).map_err(|_| DateError::Time)?;
    if second < 60 {
        return Ok(found.to_tdb_seconds());
    }
    // In a count of UTC seconds a leap second falls together with the one before.
    let before = epoch(hour, minute, 59).map_err(|_| DateError::Time)?;
    Ok(before.to_tdb_seconds() + 1.0)
}

/// The UTC date of an epoch after 1972, to the millisecond, as [`epoch_s`] reads it.
pub fn utc(epoch_s: f64) -> String {
    // Half a millisecond more, for what follows is cut off.
    let gregorian =
        |later_s: f64| Epoch::from_tdb_seconds(epoch_s + later_s + 5e-4).to_gregorian(TimeScale::UTC);
    let written = |(year, month, day, hour, minute, second, nanoseconds): (i32, u8, u8, u8, u8, u8, u32)| {
        let fraction = match nanoseconds / 1_000_000 {
            0 => String::new(),
            milliseconds => format!(".{milliseconds:03}"),
        };
        format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}{fraction} UTC")
    };
    let is_right = |date: &String| self::epoch_s(date).is_ok_and(|read_s| (read_s - epoch_s).abs() < 0.5);
    let found = gregorian(0.0);
    // Two seconds too early the new offset is taken; the leap second itself has no number there.
    let leap = (found.0, found.1, found.2, found.3, found.4, found.5 + 1, found.6);
    let dates = [written(found), written(gregorian(1.0)), written(leap)];
    dates.iter().find(|date| is_right(date)).unwrap_or(&dates[0]).clone()
}

/// Numbers of so many digits between separators.
fn numbers<const N: usize>(text: &str, separator: char, digits: [usize; N]) -> Option<[u32; N]> {
    let mut parts = text.split(separator);
    let mut found = [0; N];
    for (slot, digits) in found.iter_mut().zip(digits) {
        *slot = number(parts.next()?, digits)?;
    }
    parts.next().is_none().then_some(found)
}

/// A number of so many digits.
fn number(text: &str, digits: usize) -> Option<u32> {
    let is_number = text.len() == digits && text.bytes().all(|byte| byte.is_ascii_digit());
    if is_number { text.parse().ok() } else { None }
}

#[cfg(test)]
mod tests {
    //! Dates are epochs that were published or follow by hand; what is no date is reported.

    use approx::assert_abs_diff_eq;

    use super::*;
    use crate::environment::time::{MOMENTUM_STUDY_START_S, midnight_s};

    /// TDB - TT in s by the two largest terms of Fairhead and Bretagnon (1990), good to 0.1 ms in these decades.
    fn tdb_minus_tt_s(epoch_s: f64) -> f64 {
        let years = epoch_s / (365.25 * 86_400.0);
        0.001_656_67 * (6.283_075_85 * years + 6.240_054).sin()
            + 0.000_022_4 * (5.753_384_9 * years + 4.296_977).sin()
    }

    #[test]
    fn tdb_counts_from_j2000() {
        assert_eq!(epoch_s("2000-01-01T12:00:00 TDB"), Ok(0.0));
        assert_eq!(epoch_s("2009-04-06 TDB"), Ok(MOMENTUM_STUDY_START_S));
        assert_eq!(MOMENTUM_STUDY_START_S, 292_248_000.0);
        assert_eq!(epoch_s("2009-04-06 00:00 TDB"), epoch_s(" 2009-04-06T00:00:00.000  TDB "));
        assert_eq!(epoch_s("2000-01-01T12:00:00.25 TDB"), Ok(0.25));
        for (year, month, day) in [(1900, 1, 1), (1999, 12, 31), (2000, 2, 29), (2100, 3, 1), (2399, 6, 30)] {
            let date = format!("{year}-{month:02}-{day:02} TDB");
            assert_eq!(epoch_s(&date), Ok(midnight_s(year, month, day)), "{date}");
        }
    }

    #[test]
    fn utc_adds_leap_seconds_and_32_184_s() {
        // Leap seconds announced by the IERS (Bulletin C).
        for (year, month, leap_seconds) in [
            (1972, 1, 10.0),
            (1972, 7, 11.0),
            (1980, 1, 19.0),
            (1999, 1, 32.0),
            (2006, 1, 33.0),
            (2009, 1, 34.0),
            (2012, 7, 35.0),
            (2015, 7, 36.0),
            (2017, 1, 37.0),
            (2026, 1, 37.0),
        ] {
            let tt_s = midnight_s(year, month, 1) + leap_seconds + 32.184;
            let found_s = epoch_s(&format!("{year}-{month:02}-01 UTC")).unwrap();
            assert_abs_diff_eq!(found_s, tt_s + tdb_minus_tt_s(tt_s), epsilon = 1e-4);
        }
        // 33 leap seconds until 2009.
        let tt_s = midnight_s(2008, 3, 19) + 19.5 * 3600.0 + 33.0 + 32.184;
        let found_s = epoch_s("2008-03-19T19:30:00 UTC").unwrap();
        assert_abs_diff_eq!(found_s, tt_s + tdb_minus_tt_s(tt_s), epsilon = 1e-4);
    }

    #[test]
    fn leap_seconds_are_seconds_of_their_own() {
        let s = |text: &str| epoch_s(text).unwrap();
        for (before, leap, after) in [
            ("2016-12-31T23:59:59 UTC", "2016-12-31T23:59:60 UTC", "2017-01-01T00:00:00 UTC"),
            ("2012-06-30T23:59:59 UTC", "2012-06-30T23:59:60 UTC", "2012-07-01T00:00:00 UTC"),
            ("1972-06-30T23:59:59 UTC", "1972-06-30T23:59:60 UTC", "1972-07-01T00:00:00 UTC"),
        ] {
            assert_abs_diff_eq!(s(leap) - s(before), 1.0, epsilon = 1e-6);
            assert_abs_diff_eq!(s(after) - s(leap), 1.0, epsilon = 1e-6);
        }
        assert_abs_diff_eq!(
            s("2016-12-31T23:59:60.75 UTC") - s("2016-12-31T23:59:59.5 UTC"),
            1.25,
            epsilon = 1e-6
        );
        // A midnight without one.
        assert_abs_diff_eq!(s("2018-01-01T00:00:00 UTC") - s("2017-12-31T23:59:59 UTC"), 1.0, epsilon = 1e-6);
    }

    #[test]
    fn a_date_is_written_as_it_was_read() {
        for date in [
            "1972-01-01T00:00:00 UTC",
            "2008-03-19T19:30:00 UTC",
            "2016-12-31T23:59:58 UTC",
            "2016-12-31T23:59:59.250 UTC",
            "2016-12-31T23:59:60.500 UTC",
            "2017-01-01T00:00:00 UTC",
            "2099-12-31T23:59:59.999 UTC",
        ] {
            assert_eq!(utc(epoch_s(date).unwrap()), date);
        }
    }

    #[test]
    fn what_is_no_date_is_reported() {
        for (text, error) in [
            ("2008-03-19T19:30:00", DateError::Scale),
            ("2008-03-19T19:30:00Z", DateError::Scale),
            ("2008-03-19T19:30:00 GPS", DateError::Scale),
            ("90 min", DateError::Form),
            ("UTC", DateError::Form),
            ("", DateError::Form),
            ("19.3.2008 UTC", DateError::Form),
            ("2008-3-19 UTC", DateError::Form),
            ("2008-03-19T7:30 UTC", DateError::Form),
            ("2008-03-19T19 UTC", DateError::Form),
            ("2008-03-19T19:30.5 UTC", DateError::Form),
            ("2008-03-19T19:30:00. UTC", DateError::Form),
            ("2008-03-19T19:30:00.0123456789 UTC", DateError::Form),
            ("2008-03-19T19:30:+1 UTC", DateError::Form),
            ("2008-03-19-01 UTC", DateError::Form),
            ("2008-13-01 UTC", DateError::Day),
            ("2008-00-01 TDB", DateError::Day),
            ("2009-02-29 TDB", DateError::Day),
            ("2008-04-31 UTC", DateError::Day),
            ("1900-02-29 TDB", DateError::Day),
            ("2008-04-30T24:00:00 UTC", DateError::Time),
            ("2008-04-30T23:60:00 UTC", DateError::Time),
            ("2008-04-30T23:59:60 UTC", DateError::Time),
            ("2017-12-31T23:59:60 UTC", DateError::Time),
            ("2016-12-31T23:59:60 TDB", DateError::Time),
            ("2016-12-31T23:59:61 UTC", DateError::Time),
            ("1971-12-31 UTC", DateError::BeforeUtc),
        ] {
            assert_eq!(epoch_s(text), Err(error), "{text}");
        }
    }
}
