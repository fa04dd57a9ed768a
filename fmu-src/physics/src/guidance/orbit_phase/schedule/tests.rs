//! Over a whole cycle the share of downlink is the window's share, and edges stand where they are counted.
use super::*;

const HOUR_S: f64 = 3600.0;

fn paper() -> Schedule {
    Schedule {
        periapsis_s: 0.0,
        period_s: 12.0 * HOUR_S,
        downlink_start_s: 2.0 * HOUR_S,
        downlink_end_s: 10.0 * HOUR_S,
        period_shares: [None; 2],
        every: 2,
        once: false,
        throughout: false,
    }
}

#[test]
fn eight_of_twenty_four_hours_are_downlink() {
    let minutes = (0..90 * 24 * 60)
        .filter(|minute| paper().window(f64::from(*minute) * 60.0).activity == Activity::Downlink)
        .count();
    assert_eq!(minutes, 90 * 8 * 60);
}

#[test]
fn edges_belong_to_what_follows() {
    let window = paper().window(2.0 * HOUR_S);
    let end = |window: Window| (window.activity, window.since_s, window.until_s);
    assert_eq!(end(window), (Activity::Downlink, 2.0 * HOUR_S, 10.0 * HOUR_S));
    let window = paper().window(10.0 * HOUR_S);
    assert_eq!(end(window), (Activity::Science, 10.0 * HOUR_S, 26.0 * HOUR_S));
    let window = paper().window(2.0 * HOUR_S - 1e-6);
    assert_eq!(end(window), (Activity::Science, -14.0 * HOUR_S, 2.0 * HOUR_S));
}

#[test]
fn periapses_met_on_time_give_the_computed_windows() {
    for minute in 0..6 * 24 * 60 {
        let time_s = f64::from(minute) * 60.0 + 30.0;
        let last = (time_s / 86_400.0).floor();
        let met_s = [0.0, 1.0, 2.0].map(|back| (last - back) * 86_400.0);
        let (met, computed) = (paper().window_after(&met_s, time_s), paper().window(time_s));
        assert_eq!((met.activity, met.since_s), (computed.activity, computed.since_s));
        // The next window belongs to a periapsis that has not been met.
        let known = met.activity == Activity::Downlink || time_s < met_s[0] + 2.0 * HOUR_S;
        assert!(!known || met.until_s == computed.until_s, "{met:?} {computed:?}");
    }
    let before = paper().window_after(&[50_000.0], 50_000.0);
    assert_eq!((before.activity, before.since_s), (Activity::Science, f64::NEG_INFINITY));
    assert_eq!(before.until_s, 50_000.0 + 2.0 * HOUR_S);
}

#[test]
fn no_orbit_or_no_window_is_all_science() {
    for schedule in [
        Schedule { period_s: f64::INFINITY, ..paper() },
        Schedule { every: 0, ..paper() },
        Schedule { downlink_end_s: 2.0 * HOUR_S, ..paper() },
    ] {
        assert_eq!(schedule.window(3.0 * HOUR_S).activity, Activity::Science);
    }
}

#[test]
fn one_window_is_the_only_one() {
    let schedule = Schedule { once: true, period_s: f64::INFINITY, every: 1, ..paper() };
    let downlink = |hour: i32| schedule.window(f64::from(hour) * HOUR_S).activity == Activity::Downlink;
    assert!((-100..100).all(|hour| downlink(hour) == (2..10).contains(&hour)));
    assert_eq!(schedule.window(11.0 * HOUR_S).since_s, 10.0 * HOUR_S);
    assert_eq!(schedule.window(0.0).until_s, 2.0 * HOUR_S);
}

#[test]
fn a_window_longer_than_its_cycle_never_ends() {
    let schedule = Schedule { downlink_end_s: 40.0 * HOUR_S, ..paper() };
    assert!((0..100).all(|hour| schedule.window(f64::from(hour) * HOUR_S).activity == Activity::Downlink));
}

#[test]
fn a_window_begun_now_lasts_its_length() {
    for (now_s, start_s) in [(0.0, 7200.0), (2.9e8, 7200.0), (10.0, 1e9), (-3.1e8, 0.1)] {
        let windows = Schedule {
            periapsis_s: 17.0,
            period_s: 12.0 * HOUR_S,
            downlink_start_s: start_s,
            downlink_end_s: start_s + 8.0 * HOUR_S,
            period_shares: [None; 2],
            every: 2,
            once: false,
            throughout: false,
        };
        let begun = windows.begun_at(now_s);
        let window = begun.window(now_s);
        assert_eq!(window.activity, Activity::Downlink);
        assert!(
            (window.since_s - now_s).abs() < 1e-6 && (window.until_s - now_s - 8.0 * HOUR_S).abs() < 1e-6
        );
        assert_eq!(begun.cycle_s(), 24.0 * HOUR_S);
        assert_eq!(begun.window(now_s + 8.0 * HOUR_S + 1.0).activity, Activity::Science);
    }
}
