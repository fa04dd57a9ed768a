//! Epochs: seconds past J2000 (2000-01-01 12:00) in barycentric dynamical time, as plain `f64`.
//!
//! One second past J2000 in this century is resolved to 6e-8 s or better. TDB runs 32.184 s plus the leap seconds
//! ahead of UTC (66.184 s in 2009), and a periodic term of 1.7 ms; [`crate::toml::dates`] reads dates with all three.

use crate::constants::DAY_S;

/// Julian date (TDB) of J2000.
pub const J2000_JULIAN_DATE: f64 = 2_451_545.0;
/// Start of the 90-day momentum study of paper 000, 2009-04-06 00:00.
pub const MOMENTUM_STUDY_START_S: f64 = midnight_s(2009, 4, 6);

/// Seconds past J2000 of 00:00 on a day of the proleptic Gregorian calendar; month and day may overflow.
pub const fn midnight_s(year: i32, month: u32, day: u32) -> f64 {
    (days_from_civil(year as i64, month, day) as f64 - 0.5) * DAY_S
}

/// Difference of epoch and time of a flight, in s: at `time_s` the epoch is `epoch_s`.
pub fn epoch_minus_time_s(epoch_s: f64, time_s: f64) -> f64 {
    epoch_s - time_s
}

/// The epoch at a time of a flight, in s; see [`epoch_minus_time_s`].
pub fn epoch_at_s(time_s: f64, epoch_minus_time_s: f64) -> f64 {
    time_s + epoch_minus_time_s
}

/// The Julian date (TDB) of an epoch; resolves 4e-5 s.
pub fn julian_date(epoch_s: f64) -> f64 {
    J2000_JULIAN_DATE + epoch_s / DAY_S
}

/// How much later `epoch_s` is than its [`julian_date`], in s: what that is rounded by.
pub fn julian_date_rounding_s(epoch_s: f64) -> f64 {
    epoch_s - (julian_date(epoch_s) - J2000_JULIAN_DATE) * DAY_S
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

#[cfg(test)]
mod tests {
    //! Midnights and Julian dates agree with published ones, and with hifitime day by day.

    use hifitime::{Epoch, TimeScale};

    use super::*;

    #[test]
    fn published_julian_dates() {
        // Meeus, Astronomical Algorithms, chapter 7; the MJD origin.
        for ((year, month, day), jd) in [
            ((2000, 1, 1), 2_451_544.5),
            ((1999, 1, 1), 2_451_179.5),
            ((1987, 1, 27), 2_446_822.5),
            ((1988, 6, 19), 2_447_331.5),
            ((1900, 1, 1), 2_415_020.5),
            ((1600, 1, 1), 2_305_447.5),
            ((1858, 11, 17), 2_400_000.5),
            ((2009, 4, 6), 2_454_927.5),
        ] {
            assert_eq!(julian_date(midnight_s(year, month, day)), jd, "{year}-{month}-{day}");
        }
        assert_eq!(MOMENTUM_STUDY_START_S, (2_454_927.5 - 2_451_545.0) * 86_400.0);
    }

    #[test]
    fn midnights_are_those_of_hifitime() {
        for days in 0..78_000 {
            let epoch_s = midnight_s(1896, 1, 1) + f64::from(days) * DAY_S;
            let (year, month, day, ..) = Epoch::from_tdb_seconds(epoch_s).to_gregorian(TimeScale::TDB);
            assert_eq!(midnight_s(year, month.into(), day.into()), epoch_s, "{year}-{month}-{day}");
        }
    }
}
