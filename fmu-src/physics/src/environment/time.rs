//! Epochs: seconds past J2000 (2000-01-01 12:00) in barycentric dynamical time, as plain `f64`.
//!
//! One second past J2000 in this century is resolved to 6e-8 s or better. TDB runs 32.184 s plus the leap seconds
//! ahead of UTC (66.184 s in 2009); whoever has a UTC date adds that.

use core::fmt;

use thiserror::Error;

use crate::constants::DAY_S;

/// Julian date (TDB) of J2000.
pub const J2000_JULIAN_DATE: f64 = 2_451_545.0;
/// Start of the 90-day momentum study of paper 000, 2009-04-06 00:00.
pub const MOMENTUM_STUDY_START_S: f64 = midnight_s(2009, 4, 6);
/// Midnight of MESSENGER's arrival in orbit about Mercury, 2011-03-18 00:00.
pub const MERCURY_ORBIT_INSERTION_DAY_S: f64 = midnight_s(2011, 3, 18);
/// Start of the arc between the flybys of paper 003, 2008-03-19 00:00.
pub const FLYBY_ARC_START_S: f64 = midnight_s(2008, 3, 19);
/// End of the arc between the flybys of paper 003 (second flyby), 2008-10-06 00:00.
pub const FLYBY_ARC_END_S: f64 = midnight_s(2008, 10, 6);

/// Seconds past J2000 of 00:00 on a day of the proleptic Gregorian calendar; month and day may overflow.
pub const fn midnight_s(year: i32, month: u32, day: u32) -> f64 {
    (days_from_civil(year as i64, month, day) as f64 - 0.5) * DAY_S
}

/// The Julian date (TDB) of an epoch; resolves 4e-5 s.
pub fn julian_date(epoch_s: f64) -> f64 {
    J2000_JULIAN_DATE + epoch_s / DAY_S
}

/// A date and time of day, proleptic Gregorian calendar, TDB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Calendar {
    /// Year, astronomical numbering.
    pub year: i32,
    /// Month, 1 to 12.
    pub month: u32,
    /// Day of the month, from 1.
    pub day: u32,
    /// Hour, 0 to 23.
    pub hour: u32,
    /// Minute, 0 to 59.
    pub minute: u32,
    /// Second, 0 to below 60.
    pub second: f64,
}

/// A date that does not exist.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CalendarError {
    /// A field outside its range.
    #[error("{field} is {found}, allowed is {allowed}")]
    OutOfRange {
        /// Which field.
        field: &'static str,
        /// What it was.
        found: f64,
        /// What it may be.
        allowed: &'static str,
    },
    /// Text that is no date.
    #[error("\"{found}\" is no date: write 2009-04-06 or 2009-04-06T12:30:00.5 (TDB)")]
    Unreadable {
        /// The text.
        found: String,
    },
}

impl Calendar {
    /// Seconds past J2000 TDB.
    ///
    /// # Errors
    /// [`CalendarError::OutOfRange`] names the first field that does not exist in the calendar.
    pub fn epoch_s(&self) -> Result<f64, CalendarError> {
        let check = |field, found: f64, ok: bool, allowed| {
            if ok { Ok(()) } else { Err(CalendarError::OutOfRange { field, found, allowed }) }
        };
        check("year", self.year.into(), self.year.abs() <= 100_000, "-100000 to 100000")?;
        check("month", self.month.into(), (1..=12).contains(&self.month), "1 to 12")?;
        let year = i64::from(self.year);
        let (next_year, next_month) = if self.month == 12 { (year + 1, 1) } else { (year, self.month + 1) };
        let days_in_month = days_from_civil(next_year, next_month, 1) - days_from_civil(year, self.month, 1);
        let day_exists = self.day >= 1 && i64::from(self.day) <= days_in_month;
        check("day", self.day.into(), day_exists, "1 to the length of the month")?;
        check("hour", self.hour.into(), self.hour < 24, "0 to 23")?;
        check("minute", self.minute.into(), self.minute < 60, "0 to 59")?;
        check("second", self.second, (0.0..60.0).contains(&self.second), "0 to below 60")?;
        let whole_s = f64::from(self.hour * 3600 + self.minute * 60);
        Ok(midnight_s(self.year, self.month, self.day) + whole_s + self.second)
    }

    /// The calendar date of an epoch; `None` if it is not finite or beyond the year 100000.
    pub fn from_epoch_s(epoch_s: f64) -> Option<Self> {
        if epoch_s.is_nan() || epoch_s.abs() > 3.1e12 {
            return None;
        }
        let since_midnight_s = epoch_s + 0.5 * DAY_S;
        let days = (since_midnight_s / DAY_S).floor();
        let of_day_s = (since_midnight_s - days * DAY_S).clamp(0.0, DAY_S.next_down());
        let (year, month, day) = civil_from_days(days as i64);
        let whole = of_day_s.floor() as u32;
        Some(Self {
            year: year as i32,
            month,
            day,
            hour: whole / 3600,
            minute: whole / 60 % 60,
            second: f64::from(whole % 60) + of_day_s.fract(),
        })
    }
}

impl fmt::Display for Calendar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Cut, not rounded: 59.9999 must not print as 60.
        let second = (self.second * 1000.0).floor() / 1000.0;
        let sign = if self.year < 0 { "-" } else { "" };
        write!(
            f,
            "{sign}{:04}-{:02}-{:02}T{:02}:{:02}:{second:06.3}",
            self.year.unsigned_abs(),
            self.month,
            self.day,
            self.hour,
            self.minute
        )
    }
}

impl core::str::FromStr for Calendar {
    type Err = CalendarError;

    /// Reads `2009-04-06`, `2009-04-06T12:30` or `2009-04-06T12:30:00.5`, a blank in place of `T` allowed.
    fn from_str(text: &str) -> Result<Self, CalendarError> {
        let unreadable = || CalendarError::Unreadable { found: text.chars().take(60).collect() };
        let (date, time) = match text.trim().split_once(['T', ' ']) {
            Some((date, time)) => (date, Some(time)),
            None => (text.trim(), None),
        };
        let (negative, date) = date.strip_prefix('-').map_or((false, date), |rest| (true, rest));
        let mut fields = date.split('-');
        let mut number = || fields.next().and_then(|f| f.parse::<u32>().ok()).ok_or_else(unreadable);
        let (year, month, day) = (number()?, number()?, number()?);
        let year = i32::try_from(year).map_err(|_| unreadable())?;
        let mut calendar =
            Self { year: if negative { -year } else { year }, month, day, hour: 0, minute: 0, second: 0.0 };
        if fields.next().is_some() {
            return Err(unreadable());
        }
        if let Some(time) = time {
            let mut fields = time.split(':');
            let mut number = || fields.next().and_then(|f| f.parse::<u32>().ok()).ok_or_else(unreadable);
            (calendar.hour, calendar.minute) = (number()?, number()?);
            if let Some(second) = fields.next() {
                calendar.second = second.parse().map_err(|_| unreadable())?;
            }
            if fields.next().is_some() {
                return Err(unreadable());
            }
        }
        calendar.epoch_s()?;
        Ok(calendar)
    }
}

/// Days from 2000-01-01. Years begin in March, so that the leap day comes last; 400 years have 146097 days.
const fn days_from_civil(year: i64, month: u32, day: u32) -> i64 {
    let year = if month <= 2 { year - 1 } else { year };
    let era = year.div_euclid(400);
    let year_of_era = year.rem_euclid(400);
    let month_from_march = (month as i64 + 9) % 12;
    let day_of_year = (153 * month_from_march + 2) / 5 + day as i64 - 1;
    era * 146_097 + year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year - 730_425
}

fn civil_from_days(days: i64) -> (i64, u32, u32) {
    let shifted = days + 730_425;
    let era = shifted.div_euclid(146_097);
    let day_of_era = shifted.rem_euclid(146_097);
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month_from_march = (5 * day_of_year + 2) / 153;
    let day = (day_of_year - (153 * month_from_march + 2) / 5 + 1) as u32;
    let month = if month_from_march < 10 { month_from_march + 3 } else { month_from_march - 9 } as u32;
    (era * 400 + year_of_era + i64::from(month <= 2), month, day)
}

#[cfg(test)]
mod tests {
    //! Calendar dates and epochs agree with published Julian dates, and with counting days one by one.

    use super::*;

    #[test]
    fn published_julian_dates() {
        // Meeus, Astronomical Algorithms, chapter 7; the MJD origin; noon of J2000.
        for (text, jd) in [
            ("2000-01-01T12:00", 2_451_545.0),
            ("1999-01-01", 2_451_179.5),
            ("1987-01-27", 2_446_822.5),
            ("1988-06-19T12:00", 2_447_332.0),
            ("1900-01-01", 2_415_020.5),
            ("1600-01-01", 2_305_447.5),
            ("1858-11-17", 2_400_000.5),
            ("2009-04-06", 2_454_927.5),
        ] {
            let epoch_s = text.parse::<Calendar>().unwrap().epoch_s().unwrap();
            assert_eq!(julian_date(epoch_s), jd, "{text}");
        }
        assert_eq!(MOMENTUM_STUDY_START_S, (2_454_927.5 - 2_451_545.0) * 86_400.0);
    }

    #[test]
    fn counting_days_one_by_one() {
        let leap = |y: i32| y % 4 == 0 && (y % 100 != 0 || y % 400 == 0);
        let mut epoch_s = "1896-01-01".parse::<Calendar>().unwrap().epoch_s().unwrap();
        for year in 1896..2110 {
            for month in 1..=12 {
                let february = if leap(year) { 29 } else { 28 };
                for day in 1..=[31, february, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31][month as usize - 1] {
                    let calendar = Calendar { year, month, day, hour: 0, minute: 0, second: 0.0 };
                    assert_eq!(calendar.epoch_s().unwrap(), epoch_s);
                    assert_eq!(Calendar::from_epoch_s(epoch_s).unwrap(), calendar);
                    epoch_s += 86_400.0;
                }
            }
        }
    }

    #[test]
    fn prints_what_it_reads() {
        for text in ["2009-04-06T12:30:59.125", "-0004-02-29T00:00:00.000", "1969-12-31T23:59:59.000"] {
            let calendar: Calendar = text.parse().unwrap();
            assert_eq!(calendar.to_string(), text);
            assert_eq!(Calendar::from_epoch_s(calendar.epoch_s().unwrap()).unwrap(), calendar);
        }
    }

    #[test]
    fn dates_that_do_not_exist_are_named() {
        for (text, part) in [
            ("2009-02-29", "day is 29"),
            ("2009-13-01", "month is 13, allowed is 1 to 12"),
            ("2009-04-06T24:00", "hour is 24"),
            ("2009-04-06T12:00:60", "second is 60"),
            ("2009-04-06T12:00:NaN", "second is NaN"),
            ("yesterday", "\"yesterday\" is no date"),
            ("2009-04", "is no date"),
            ("2009-04-06-01", "is no date"),
        ] {
            let error = text.parse::<Calendar>().unwrap_err().to_string();
            assert!(error.contains(part), "{text}: {error}");
        }
        assert_eq!(Calendar::from_epoch_s(f64::NAN), None);
        assert_eq!(Calendar::from_epoch_s(1e300), None);
    }
}
