//! Dates as people write them: a calendar date and a time of day, or a Julian date, and the name of the time scale, to an epoch.
//!
//! `2008-03-19T19:30:00.5 UTC`: year, month and day, then, unless it is midnight, hours, minutes and possibly seconds with
//! at most nine decimals, then `UTC` or `Z`, `TDB`, `TT` or `TAI`. `JD 2454545.3125 UTC`: days of 86400 s of that scale since noon
//! of 4713-11-24 BC; without a scale Terrestrial Time, as resolution B1 of the IAU (1997) has it. UTC has whole leap seconds since
//! 1972 (as announced by the IERS), and a minute that has one has a second 60. TDB differs from TT by its annual term of 1.7 ms
//! (hifitime's, after Archinal).

use hifitime::{Epoch, TimeScale, Unit};

use crate::constants::DAY_S;

/// Examples of a date, for messages.
pub const ALLOWED_DATE: &str = "a date such as \"2008-03-19T19:30:00 UTC\" or \"JD 2454544.5 TDB\"";

/// Endings of a date and the time scales they name.
const SCALES: [(&str, TimeScale); 5] = [
    ("UTC", TimeScale::UTC),
    ("Z", TimeScale::UTC),
    ("TDB", TimeScale::TDB),
    ("TT", TimeScale::TT),
    ("TAI", TimeScale::TAI),
];
/// Mark before or after a Julian date.
const JULIAN: &str = "JD";
/// Julian date of 2000-01-01 12:00.
const J2000_JULIAN_DAY: i64 = 2_451_545;
/// Julian dates from 4713 BC to the year 22666: no other number is meant.
const MOST_JULIAN_DIGITS: usize = 7;
/// First year of UTC with leap seconds.
const FIRST_UTC_YEAR: i32 = 1972;

/// Reason why a text is not a date.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DateError {
    /// The text does not have the form of a date.
    #[error("which is no date")]
    Form,
    /// The text does not end in a known time scale.
    #[error("which does not end in UTC, Z, TDB, TT or TAI")]
    Scale,
    /// The calendar has no such day.
    #[error("a day that no calendar has")]
    Day,
    /// The day has no such time.
    #[error("a time that this day does not have")]
    Time,
    /// UTC had no leap seconds yet.
    #[error("a time before UTC had leap seconds (1972): give TDB")]
    BeforeUtc,
}

/// Whether a text is meant as a date: it begins with four digits and a hyphen, ends in the name of a time scale after a digit or a
/// blank, or has `JD` on either side.
pub fn looks_like_date(text: &str) -> bool {
    let text = text.trim();
    let bytes = text.as_bytes();
    let is_calendar = bytes.len() > 4 && bytes[..4].iter().all(u8::is_ascii_digit) && bytes[4] == b'-';
    let ends = |name: &str| {
        let before = text.strip_suffix(name).and_then(|it| it.chars().next_back());
        before.is_some_and(|last| last.is_ascii_digit() || last.is_whitespace())
    };
    is_calendar || SCALES.iter().any(|(name, _)| ends(name)) || julian(text).is_some()
}

/// Returns the number before or after `JD`.
fn julian(text: &str) -> Option<&str> {
    let number = text.strip_prefix(JULIAN).or_else(|| text.strip_suffix(JULIAN))?.trim();
    number.starts_with(|first: char| first.is_ascii_digit()).then_some(number)
}

/// The epoch of a date, in s past J2000 TDB.
///
/// # Errors
///
/// What is wrong with the text.
pub fn epoch_s(text: &str) -> Result<f64, DateError> {
    let text = text.trim();
    let scaled =
        SCALES.into_iter().find_map(|(name, scale)| Some((text.strip_suffix(name)?.trim_end(), scale)));
    if let Some(days) = julian(scaled.map_or(text, |(text, _)| text)) {
        return julian_epoch_s(days, scaled.map_or(TimeScale::TT, |(_, scale)| scale));
    }
    let (text, scale) =
        scaled.ok_or(if looks_like_date(text) { DateError::Scale } else { DateError::Form })?;
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
    if is_before_utc(year, scale) {
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

/// Returns the epoch of a Julian date. Its decimals are read apart from the whole days, so that 1e-9 d (0.1 ms) is kept.
fn julian_epoch_s(text: &str, scale: TimeScale) -> Result<f64, DateError> {
    let (whole, decimals) = text.split_once('.').unwrap_or((text, "0"));
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    if !is_number(whole) || !is_number(decimals) || whole.len() > MOST_JULIAN_DIGITS {
        return Err(DateError::Form);
    }
    let days = whole.parse::<i64>().map_err(|_| DateError::Form)? - J2000_JULIAN_DAY;
    let share = format!("0.{decimals}").parse::<f64>().map_err(|_| DateError::Form)?;
    if scale == TimeScale::TDB {
        return Ok((days as f64 + share) * DAY_S);
    }
    // Days of a scale have 86400 s of it: a leap second of UTC is not counted.
    let noon = Epoch::maybe_from_gregorian(2000, 1, 1, 12, 0, 0, 0, scale).map_err(|_| DateError::Day)?;
    let found = noon + days * Unit::Day + share * Unit::Day;
    if is_before_utc(found.to_gregorian(scale).0, scale) {
        return Err(DateError::BeforeUtc);
    }
    Ok(found.to_tdb_seconds())
}

fn is_before_utc(year: i32, scale: TimeScale) -> bool {
    scale == TimeScale::UTC && year < FIRST_UTC_YEAR
}

/// The time from one epoch to another, in s: whole seconds of UTC are whole seconds, although TDB runs up to 1.7 ms ahead of TT or
/// behind it in the course of a year, and a step of less than that would be left over.
pub fn span_s(from_epoch_s: f64, to_epoch_s: f64) -> f64 {
    const ANNUAL_TERMS_S: f64 = 4e-3;
    let span_s = to_epoch_s - from_epoch_s;
    let rounded_s = span_s.round();
    if (span_s - rounded_s).abs() < ANNUAL_TERMS_S { rounded_s } else { span_s }
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

/// Returns the numbers between separators, each with the given count of digits.
fn numbers<const N: usize>(text: &str, separator: char, digits: [usize; N]) -> Option<[u32; N]> {
    let mut parts = text.split(separator);
    let mut found = [0; N];
    for (slot, digits) in found.iter_mut().zip(digits) {
        *slot = number(parts.next()?, digits)?;
    }
    parts.next().is_none().then_some(found)
}

/// Returns the number if the text has exactly this count of digits.
fn number(text: &str, digits: usize) -> Option<u32> {
    let is_number = text.len() == digits && text.bytes().all(|byte| byte.is_ascii_digit());
    if is_number { text.parse().ok() } else { None }
}

#[cfg(test)]
mod tests;
