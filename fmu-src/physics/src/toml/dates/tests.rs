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
fn dates_in_other_scales_and_julian_dates_are_the_same_epochs() {
    let s = |text: &str| epoch_s(text).unwrap();
    // One instant: TT is 32.184 s ahead of TAI, TAI 34 s ahead of UTC in 2009; TDB follows TT to 2 ms.
    for (text, later_s) in [
        ("2009-04-06T00:00:00Z", 0.0),
        ("2009-04-06 Z", 0.0),
        ("2009-04-06T00:00:34 TAI", 0.0),
        ("2009-04-06T00:01:06.184 TT", 0.0),
        ("JD 2454927.5 UTC", 0.0),
        ("2454927.5 JD UTC", 0.0),
        ("JD2454927.5Z", 0.0),
        ("JD 2454927.5 TAI", -34.0),
        ("JD 2454927.5 TT", -66.184),
        ("JD 2454927.5", -66.184),
        ("2454927.5 JD", -66.184),
        // A day of UTC is 86400 s, 2017 too begins at midnight, behind three more leap seconds.
        ("JD 2457754.5 UTC", (2_457_754.5 - 2_454_927.5) * 86_400.0 + 3.0),
        ("JD 2454927.500000001 UTC", 8.64e-5),
    ] {
        assert_abs_diff_eq!(s(text) - s("2009-04-06 UTC"), later_s, epsilon = 4e-3);
        assert!(looks_like_date(text), "{text}");
    }
    assert_eq!(s("JD 2457754.5 UTC"), s("2017-01-01 UTC"));
    assert_eq!(s("JD 2454927.5 TDB"), MOMENTUM_STUDY_START_S);
    assert_eq!(s("JD 2451545 TDB"), 0.0);
    assert_abs_diff_eq!(s("JD 2454927.500000001 TDB") - MOMENTUM_STUDY_START_S, 8.64e-5, epsilon = 1e-7);
    for text in ["90 min", "nadir", "5 m", "JD", "MATT", "1e3", "-2 d", "JDx"] {
        assert!(!looks_like_date(text), "{text}");
    }
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
        ("JD 2454544.5e0 TDB", DateError::Form),
        ("JD 24545440.5 TDB", DateError::Form),
        ("JD 2454544. TDB", DateError::Form),
        ("JD TDB", DateError::Form),
        ("JD 2441317.4 UTC", DateError::BeforeUtc),
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
