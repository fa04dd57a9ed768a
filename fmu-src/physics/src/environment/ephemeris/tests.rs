//! The planets stand where VSOP87's authors, the observed transits and Kepler's laws put them.

use super::*;
use crate::tests::short_or_long;
use crate::{constants::GM_SUN_M3_S2, environment::time::MOMENTUM_STUDY_START_S};

const CENTURY_S: f64 = 36_525.0 * DAY_S;

fn epoch_s(text: &str) -> f64 {
    text.parse::<hifitime::Epoch>().unwrap().to_tdb_seconds()
}

/// Scattered epochs between 1900 and 2100, the same every run.
fn scattered(count: u32) -> impl Iterator<Item = f64> {
    (0..count).map(|i| ((f64::from(i) * 0.618_033_988_75).fract() * 2.0 - 1.0) * CENTURY_S)
}

#[test]
fn rotation_is_the_published_one() {
    let dcm = eme2000_from_vsop87();
    let published = Matrix3::new(
        1.0,
        0.000_000_440_360,
        -0.000_000_190_919,
        -0.000_000_479_966,
        0.917_482_137_087,
        -0.397_776_982_902,
        0.0,
        0.397_776_982_902,
        0.917_482_137_087,
    );
    assert!((dcm - published).abs().max() < 1.1e-12);
    assert!((dcm * dcm.transpose() - Matrix3::identity()).norm() < 1e-14);
}

#[test]
fn check_values_of_the_authors() {
    // vsop87.chk, VSOP87A at JD 2451545.0 and 2415020.0, AU.
    let mut ephemeris = Ephemeris::default();
    for (body, day, x, y) in [
        (Body::Mercury, 0.0, -0.130_093_411_5, -0.447_287_671_6),
        (Body::Mercury, -36_525.0, -0.389_724_693_1, -0.150_224_219_9),
        (Body::Venus, 0.0, -0.718_302_279_7, -0.032_654_601_7),
        (Body::Earth, 0.0, -0.177_135_458_6, 0.967_241_623_7),
        (Body::Mars, 0.0, 1.390_715_926_4, -0.013_415_704_3),
        (Body::Jupiter, 0.0, 4.001_174_026_8, 2.938_581_007_7),
    ] {
        let position = ephemeris.state(body, day * DAY_S).position_m;
        let ecliptic = eme2000_from_vsop87().transpose() * position / ASTRONOMICAL_UNIT_M;
        let tolerance = match body {
            Body::Mercury => 2e-9,
            Body::Mars => 1e-7,
            Body::Jupiter => 1e-6,
            _ => 3e-8,
        };
        assert!((ecliptic.x - x).abs() < tolerance, "{body:?} {ecliptic}");
        assert!((ecliptic.y - y).abs() < tolerance, "{body:?} {ecliptic}");
    }
}

#[test]
fn fit_error_stays_below_the_stated() {
    // What is fitted, and the authors' rectangular series, which they cut off elsewhere.
    let elements = |body, jd| match body {
        Body::Mercury => Some(vsop87::mercury(jd)),
        Body::Venus => Some(vsop87::venus(jd)),
        Body::Mars => Some(vsop87::mars(jd)),
        Body::Jupiter => Some(vsop87::jupiter(jd)),
        Body::Sun | Body::Earth | Body::Custom => None,
    };
    let rectangular = |body, jd| match body {
        Body::Mercury => vsop87::vsop87a::mercury(jd),
        Body::Venus => vsop87::vsop87a::venus(jd),
        Body::Mars => vsop87::vsop87a::mars(jd),
        Body::Jupiter => vsop87::vsop87a::jupiter(jd),
        Body::Sun | Body::Earth | Body::Custom => vsop87::vsop87a::earth(jd),
    };
    let mut ephemeris = Ephemeris::default();
    for (body, fit_m, apart_m) in [
        (Body::Mercury, 100.0, 300.0),
        (Body::Venus, 10.0, 2500.0),
        (Body::Mars, 20.0, 30_000.0),
        (Body::Jupiter, 20.0, 300_000.0),
        (Body::Earth, 1.0, 1.0),
    ] {
        for epoch_s in scattered(short_or_long(60, 200)) {
            // At a date that is a Julian one to the last place.
            let epoch_s = epoch_s - julian_date_rounding_s(epoch_s);
            let found = ephemeris.state(body, epoch_s).position_m;
            let jd = julian_date(epoch_s);
            if let Some(e) = elements(body, jd) {
                let error_m = (found - from_elements([e.a, e.l, e.k, e.h, e.q, e.p])).norm();
                assert!(error_m < fit_m, "{body:?}: {error_m} m");
            }
            let error_m = (found - from_rectangular(rectangular(body, jd))).norm();
            assert!(error_m < apart_m, "{body:?}: {error_m} m from VSOP87A");
        }
    }
}

#[test]
fn segments_meet_at_their_edges() {
    // Of positions and of elements, between 1900 and 2100; the elements' 32 d are edges of all.
    let mut ephemeris = Ephemeris::default();
    for body in [Body::Mercury, Body::Venus, Body::Earth, Body::Mars, Body::Jupiter] {
        let (mut gap_m, mut gap_m_s) = (0.0_f64, 0.0_f64);
        for number in (-1140..1140).step_by(38) {
            let long_s = f64::from(number) * LONG_S;
            for offset_s in [0.0, SHORT_S, MIDDLE_S, INTERPOLATION_S] {
                let edge_s = long_s + offset_s;
                let before = ephemeris.state(body, edge_s.next_down());
                let after = ephemeris.state(body, edge_s);
                gap_m = gap_m.max((after.position_m - before.position_m).norm());
                gap_m_s = gap_m_s.max((after.velocity_m_s - before.velocity_m_s).norm());
            }
        }
        assert!(gap_m < 0.1 && gap_m_s < 1e-5, "{body:?}: {gap_m} m, {gap_m_s} m/s");
    }
}

#[test]
fn moon_goes_round_the_earth_as_the_almanac_says() {
    // Distance 356,400 to 406,720 km, inclination to the ecliptic 4.98 to 5.31 deg, 27.3217 d a revolution on the mean.
    let mut ephemeris = Ephemeris::default();
    let to_ecliptic = eme2000_from_vsop87().transpose();
    let (mut nearest_m, mut farthest_m, mut turned_rad) = (f64::INFINITY, 0.0_f64, 0.0);
    let mut last_rad = None;
    let days = 6_793;
    for day in 0..=days {
        let epoch_s = f64::from(day) * DAY_S;
        let moon = ephemeris.moon_from_earth(epoch_s);
        let (distance_m, ecliptic) = (moon.position_m.norm(), to_ecliptic * moon.position_m);
        (nearest_m, farthest_m) = (nearest_m.min(distance_m), farthest_m.max(distance_m));
        let normal = (to_ecliptic * moon.position_m.cross(&moon.velocity_m_s)).normalize();
        assert!((4.9..5.4).contains(&normal.z.acos().to_degrees()), "{normal}");
        let longitude_rad = ecliptic.y.atan2(ecliptic.x);
        turned_rad += last_rad.map_or(0.0, |last_rad: f64| (longitude_rad - last_rad).rem_euclid(TAU));
        last_rad = Some(longitude_rad);
    }
    assert!((3.560e8..3.575e8).contains(&nearest_m) && (4.06e8..4.075e8).contains(&farthest_m));
    let month_d = f64::from(days) * TAU / turned_rad;
    assert!((month_d - 27.3217).abs() < 0.005, "{month_d}");
}

#[test]
fn new_moon_of_an_eclipse_stands_before_the_sun() {
    // Greatest eclipse 2017-08-21 18:25:32 UT (NASA), the axis of the shadow 0.4367 Earth radii from the Earth's centre.
    let epoch_s = epoch_s("2017-08-21T18:25:32 UTC");
    let mut ephemeris = Ephemeris::default();
    let moon_m = ephemeris.moon_from_earth(epoch_s).position_m;
    let sun_m = -ephemeris.state(Body::Earth, epoch_s - 499.0).position_m;
    let axis = (moon_m - sun_m).normalize();
    let apart_radii = (moon_m - axis * moon_m.dot(&axis)).norm() / 6.378_137e6;
    assert!((apart_radii - 0.4367).abs() < 0.05, "{apart_radii}");
}

#[test]
fn observed_transits_across_the_sun() {
    // NASA's catalogue of transits: time of greatest transit (UT) and least distance of the planet from the Sun's
    // centre in arc seconds. Light from the planet left earlier by its light time.
    for (body, text, published_arcsec) in [
        (Body::Mercury, "2003-05-07T07:52", 708.3),
        (Body::Mercury, "2006-11-08T21:41", 422.9),
        (Body::Mercury, "2016-05-09T14:57", 318.5),
        (Body::Mercury, "2019-11-11T15:20", 75.9),
        (Body::Venus, "2004-06-08T08:20", 626.9),
        (Body::Venus, "2012-06-06T01:29", 554.4),
    ] {
        let mut ephemeris = Ephemeris::default();
        let mut separation_arcsec = |epoch_s: f64| {
            let earth = ephemeris.state(Body::Earth, epoch_s).position_m;
            let mut planet = ephemeris.state(body, epoch_s).position_m;
            for _ in 0..3 {
                let light_time_s = (planet - earth).norm() / crate::constants::SPEED_OF_LIGHT_M_S;
                planet = ephemeris.state(body, epoch_s - light_time_s).position_m;
            }
            (planet - earth).angle(&-earth).to_degrees() * 3600.0
        };
        let greatest_s = epoch_s(text);
        let (mut least, mut at_minute) = (f64::INFINITY, 0_i32);
        for minute in -20_i32..=20 {
            let separation = separation_arcsec(greatest_s + f64::from(minute) * 60.0);
            if separation < least {
                (least, at_minute) = (separation, minute);
            }
        }
        assert!((least - published_arcsec).abs() < 0.5, "{text}: {least} arc seconds");
        assert!(at_minute.abs() <= 1, "{text}: {at_minute} min");
    }
}

#[test]
fn keplers_laws() {
    // Semi-major axes 0.38710 and 0.72333 AU: vis-viva energy, within what other planets do to it.
    let mut ephemeris = Ephemeris::default();
    let semi_major_axis_au = |state: CartesianState| {
        let inverse = 2.0 / state.position_m.norm() - state.velocity_m_s.norm_squared() / GM_SUN_M3_S2;
        1.0 / (inverse * ASTRONOMICAL_UNIT_M)
    };
    let (mut nearest, mut farthest) = (f64::INFINITY, 0.0_f64);
    for day in 0..200 {
        let at_s = MOMENTUM_STUDY_START_S + f64::from(day) * DAY_S;
        let mercury = ephemeris.state(Body::Mercury, at_s);
        assert!((semi_major_axis_au(mercury) - 0.387_098).abs() < 5e-6);
        assert!((semi_major_axis_au(ephemeris.state(Body::Venus, at_s)) - 0.723_330).abs() < 2e-5);
        let distance = mercury.position_m.norm() / ASTRONOMICAL_UNIT_M;
        (nearest, farthest) = (nearest.min(distance), farthest.max(distance));
    }
    assert!((nearest - 0.307_5).abs() < 1e-4 && (farthest - 0.466_7).abs() < 1e-4);
}

#[test]
fn work_is_counted_by_what_is_requested_alone() {
    let count = short_or_long(20, 60);
    let epochs: Vec<f64> = (0..count).map(|i| f64::from(i * 7919 % count) * 5.3 * DAY_S - 1e8).collect();
    let mut used = Ephemeris::default();
    for &epoch_s in &epochs {
        let mut fresh = Ephemeris::default();
        used.count_from_here();
        let before = used.evaluations();
        for days in [0.0, 3.0, 40.0, 0.0, 71.0, 40.0] {
            for body in Body::ALL {
                let at_s = epoch_s + days * DAY_S;
                assert_eq!(used.state(body, at_s), fresh.state(body, at_s));
            }
            assert_eq!(used.evaluations() - before, fresh.evaluations());
        }
        // 40 and 71 days later are other segments than the first, for five planets; each time may be another segment than
        // the one before it.
        let planets = 4 * ELEMENT_EVALUATIONS + EARTH_TERMS as u64;
        assert!((2 * planets..=5 * planets).contains(&fresh.evaluations()), "{}", fresh.evaluations());
    }
}

#[test]
fn history_leaves_no_trace() {
    let epochs: Vec<f64> = (0..40).map(|i| f64::from(i * 7919 % 40) * 5.3 * DAY_S - 1e8).collect();
    let mut used = Ephemeris::default();
    for &epoch_s in &epochs {
        for body in Body::ALL {
            assert_eq!(used.state(body, epoch_s), Ephemeris::default().state(body, epoch_s));
        }
    }
    assert!(used.state(Body::Mercury, f64::NAN).position_m.x.is_nan());
}

#[test]
fn a_shared_cache_changes_no_bit() {
    let (start_s, days) = (-1e8, 400);
    let cache = EphemerisCache::default();
    let [mut first, mut second] = [(); 2].map(|()| Ephemeris::with_cache(&cache));
    let mut alone = Ephemeris::default();
    for day in (0..=days).chain((0..=days).rev()) {
        let epoch_s = start_s + f64::from(day) * DAY_S;
        let sharing = if day % 100 < 50 { &mut first } else { &mut second };
        for body in Body::ALL.into_iter().filter(|body| *body != Body::Custom) {
            assert_eq!(sharing.state(body, epoch_s), alone.state(body, epoch_s));
        }
        assert_eq!(sharing.moon_from_earth(epoch_s), alone.moon_from_earth(epoch_s));
    }
    let touched = |length_s: f64| {
        let [first, last] =
            [start_s, start_s + f64::from(days) * DAY_S].map(|at_s| (at_s / length_s).floor());
        1 + (last - first) as usize
    };
    fn held<const D: usize, const N: usize>(slots: &Option<SegmentCache<D, N>>) -> usize {
        slots.iter().flat_map(|slots| &slots.held).flatten().count()
    }
    let all = cache.0.lock().unwrap();
    for body in [Body::Mercury, Body::Venus, Body::Mars, Body::Jupiter] {
        assert_eq!(held(&all.elements[body as usize]), touched(LONG_S));
    }
    assert_eq!([held(&all.earth), held(&all.moon)], [touched(MIDDLE_S); 2]);
}

#[test]
fn a_cached_segment_is_not_evaluated_again() {
    let cache = EphemerisCache::default();
    let _ = Ephemeris::with_cache(&cache).state(Body::Earth, 0.0);
    // A wrong one, so that its use shows.
    let wrong = Segment::<3, EARTH_TERMS>::from_samples(0.0, MIDDLE_S, &[Vector3::repeat(7.0); EARTH_TERMS]);
    cache.0.lock().unwrap().earth.as_mut().unwrap().held[0] = Some((0, wrong));
    let taken_m = Ephemeris::with_cache(&cache).state(Body::Earth, 0.0).position_m;
    assert!((taken_m - Vector3::repeat(7.0)).norm() < 1e-12, "{taken_m}");
}
