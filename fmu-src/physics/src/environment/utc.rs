//! Universal time of an epoch: seconds, days and years as calendars and models of the Earth count them.
//!
//! Equation: UTC = TDB less 1.657 ms sin(g), 32.184 s and the leap seconds, g the Earth's mean anomaly; before 1972 as then.
//! Error measure: TDB less TT to 0.03 ms; days of UTC last 86400 s here.
//! Reference: IERS Conventions (2010), 10.1; leap seconds of hifitime.

use hifitime::leap_seconds::{LatestLeapSeconds, LeapSecond};

use super::time::midnight_s;
use crate::constants::DAY_S;
use crate::math;

/// TT less TAI, in s.
const TT_MINUS_TAI_S: f64 = 32.184;
/// From 1900-01-01 00:00 to J2000, in s.
const J2000_SINCE_1900_S: f64 = 36_524.5 * DAY_S;
/// TAI less UTC when leap seconds began, in s.
const FIRST_LEAP_SECONDS_S: f64 = 10.0;

/// TDB less UTC at an epoch in s past J2000 TDB, in s.
fn tdb_minus_utc_s(epoch_s: f64) -> f64 {
    let anomaly_rad = 6.240_060 + 1.990_970_4e-7 * epoch_s;
    let tai_s = epoch_s - 1.657e-3 * math::sin(anomaly_rad) - TT_MINUS_TAI_S;
    // The table's times are those of the clock that has leapt.
    let begun = |leap: &LeapSecond| {
        leap.announced_by_iers && leap.timestamp_tai_s <= tai_s + J2000_SINCE_1900_S - leap.delta_at
    };
    let leap_s =
        LatestLeapSeconds::default().rev().find(begun).map_or(FIRST_LEAP_SECONDS_S, |leap| leap.delta_at);
    epoch_s - tai_s + leap_s
}

/// Seconds past 2000-01-01 12:00 UTC, leap seconds left out, of an epoch in s past J2000 TDB.
pub fn utc_s(epoch_s: f64) -> f64 {
    epoch_s - tdb_minus_utc_s(epoch_s)
}

/// The first midnight of UTC after an epoch, both in s past J2000 TDB.
pub fn next_midnight_s(epoch_s: f64) -> f64 {
    let utc_s = utc_s(epoch_s);
    let days = ((utc_s + 0.5 * DAY_S) / DAY_S).floor() + 1.0;
    let midnight_utc_s = (days - 0.5) * DAY_S;
    // A leap second comes before midnight.
    midnight_utc_s + tdb_minus_utc_s(epoch_s + (midnight_utc_s - utc_s) + 2.0)
}

/// Day of the year, 1 on the first of January, and seconds of that day, UTC.
pub fn day_and_seconds(epoch_s: f64) -> (i32, f64) {
    let utc_s = utc_s(epoch_s);
    let since_new_year_s = utc_s - midnight_s(year(utc_s), 1, 1);
    let day = (since_new_year_s / DAY_S).floor();
    (day as i32 + 1, since_new_year_s - day * DAY_S)
}

/// The year with the share of it that has passed, UTC.
pub fn year_and_share(epoch_s: f64) -> f64 {
    let utc_s = utc_s(epoch_s);
    let year = year(utc_s);
    let [start_s, end_s] = [year, year + 1].map(|year| midnight_s(year, 1, 1));
    f64::from(year) + (utc_s - start_s) / (end_s - start_s)
}

/// The year of the Gregorian calendar.
fn year(utc_s: f64) -> i32 {
    let guess = (2000.0 + (utc_s / DAY_S + 0.5) / 365.2425).floor() as i32;
    [guess + 1, guess].into_iter().find(|year| midnight_s(*year, 1, 1) <= utc_s).unwrap_or(guess - 1)
}

#[cfg(test)]
mod tests {
    //! Against hifitime, which counts in whole nanoseconds, and the calendar.
    use hifitime::{Epoch, TimeScale};

    use super::*;
    use crate::toml::dates;

    #[test]
    fn universal_time_is_that_of_hifitime() {
        for (date, expected, seconds) in [
            ("1972-07-01 UTC", 183, 0.0),
            ("1999-01-01 UTC", 1, 0.0),
            ("2009-04-06T12:34:56 UTC", 96, 45_296.0),
            ("2016-12-31T23:59:59 UTC", 366, 86_399.0),
            ("2017-01-01 UTC", 1, 0.0),
            ("2026-11-27T06:00:00 UTC", 331, 21_600.0),
        ] {
            let epoch_s = dates::epoch_s(date).unwrap() + 1e-3;
            let (day, found_s) = day_and_seconds(epoch_s);
            assert!((found_s - seconds - 1e-3).abs() < 1e-4, "{date}: {found_s}");
            let (_, month, of_month, ..) = Epoch::from_tdb_seconds(epoch_s).to_gregorian(TimeScale::UTC);
            assert!(date.contains(&format!("-{month:02}-{of_month:02}")), "{date}");
            assert_eq!(day, expected, "{date}");
        }
        let (year, ..) = Epoch::from_tdb_seconds(8e8).to_gregorian(TimeScale::UTC);
        assert_eq!(super::year(utc_s(8e8)), year);
    }

    #[test]
    fn midnights_follow_one_another_over_a_leap_second() {
        let start_s = dates::epoch_s("2016-12-31T18:00:00 UTC").unwrap();
        let first_s = next_midnight_s(start_s);
        assert!((first_s - dates::epoch_s("2017-01-01 UTC").unwrap()).abs() < 1e-4);
        assert!((first_s - start_s - 21_601.0).abs() < 1e-4, "a leap second: {}", first_s - start_s);
        assert!((next_midnight_s(first_s + 1.0) - first_s - DAY_S).abs() < 1e-4);
    }

    #[test]
    fn years_have_as_many_days_as_the_calendar() {
        for (date, expected) in [
            ("2020-01-01 UTC", 2020.0),
            ("2020-07-02 UTC", 2020.0 + 183.0 / 366.0),
            ("2023-12-31 UTC", 2023.0 + 364.0 / 365.0),
        ] {
            let found = year_and_share(dates::epoch_s(date).unwrap());
            assert!((found - expected).abs() < 1e-10, "{date}: {found}");
        }
    }
}
