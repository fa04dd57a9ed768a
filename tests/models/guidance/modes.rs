//! Modes: demotion by lost attitude and by the monitor, promotion by request alone, what each mode obeys.

use models::Guidance;
use nalgebra::Vector3;

use super::super::named_model::{NamedModel, assert_same};
use super::{GuidanceInstance, PLACED, to_inertial, with};

const OPERATIONAL: i32 = 1;
const SAFE_HOLD: i32 = 2;
const EARTH_ACQUISITION: i32 = 3;
const ATTITUDE: i32 = 1;
const ERROR_QUATERNION: i32 = 2;
const RATE_ONLY: i32 = 3;

const DOWN: &[(&str, f64)] = &[("pointing.scenario", 3.0)];

fn step(flight: &mut GuidanceInstance<'_>, sets: &[(&str, f64)]) -> [i32; 2] {
    for (name, value) in sets {
        flight.set(name, *value);
    }
    flight.step_to(flight.time_s() + 1.0).unwrap();
    ["mode.active", "command.kind"].map(|name| flight.integer(name))
}

#[test]
fn lost_attitude_demotes_and_requests_alone_promote() {
    let named = NamedModel::<Guidance>::shipped();
    let mut flight = named.initialize(0.0, &with(&[PLACED, DOWN])).unwrap();
    assert_eq!(step(&mut flight, &[]), [OPERATIONAL, ATTITUDE]);
    // Without attitude and Sun: the search; with the Sun: the turn about it.
    assert_eq!(step(&mut flight, &[("estimate.valid", 0.0)]), [EARTH_ACQUISITION, RATE_ONLY]);
    let sun = [("sun.sensed[1]", 2.0), ("sun.sensedValid", 1.0)];
    assert_eq!(step(&mut flight, &sun), [EARTH_ACQUISITION, ERROR_QUATERNION]);
    // The attitude coming back promotes nothing.
    assert_eq!(step(&mut flight, &[("estimate.valid", 1.0)]), [EARTH_ACQUISITION, ERROR_QUATERNION]);
    assert_eq!(step(&mut flight, &[("mode.request", 2.0)]), [SAFE_HOLD, ATTITUDE]);
    assert_eq!(step(&mut flight, &[("mode.request", 1.0)]), [OPERATIONAL, ATTITUDE]);
    assert_eq!(step(&mut flight, &[("mode.request", 3.0)]), [EARTH_ACQUISITION, ERROR_QUATERNION]);
    assert_eq!(step(&mut flight, &[("mode.request", 0.0)]), [EARTH_ACQUISITION, ERROR_QUATERNION]);
    assert_eq!(step(&mut flight, &[("mode.request", 1.0)]), [OPERATIONAL, ATTITUDE]);
    // A request that is held does not undo a demotion.
    assert_eq!(step(&mut flight, &[("estimate.valid", 0.0)]), [EARTH_ACQUISITION, ERROR_QUATERNION]);
    assert_eq!(step(&mut flight, &[("estimate.valid", 1.0)]), [EARTH_ACQUISITION, ERROR_QUATERNION]);
}

#[test]
fn earth_acquisition_turns_slowly_about_the_sun_line_and_the_search_about_each_axis() {
    let named = NamedModel::<Guidance>::shipped();
    let sets = [
        ("mode.request", 3.0),
        ("estimate.valid", 0.0),
        ("sunSearch.duration", 10.0),
        ("sunSearch.rate", 0.01),
    ];
    let mut flight = named.initialize(0.0, &with(&[PLACED, &sets])).unwrap();
    for axis in [Vector3::x(), Vector3::y(), Vector3::z(), Vector3::x()] {
        flight.step_to(flight.time_s() + 10.0).unwrap();
        assert_eq!(flight.vector("command.rate"), axis * 0.01);
    }
    flight.set("sun.sensedValid", 1.0);
    flight.set_elements("sun.sensed", &Vector3::new(1.0, -1.0, 0.0));
    flight.step_to(41.0).unwrap();
    assert_eq!(flight.vector("command.rate"), -Vector3::y() * flight.real("earthAcquisition.rate"));
    // A turn of 45 deg about Z takes -Y to the Sun.
    let [x, y, z, w] = flight.quaternion("command.error");
    assert!(x == 0.0 && y == 0.0 && (w - 22.5_f64.to_radians().cos()).abs() < 1e-15, "{z} {w}");
    assert!((z.abs() - 22.5_f64.to_radians().sin()).abs() < 1e-15);
}

#[test]
fn the_monitor_demotes_after_its_persistence_and_watches_no_estimate_of_zero() {
    let named = NamedModel::<Guidance>::shipped();
    let monitor = [("monitor.persistence", 5.0), ("monitor.margin", 0.1), ("hotPole.enabled", 0.0)];
    let mut flight = named.initialize(0.0, &with(&[PLACED, DOWN, &monitor])).unwrap();
    let mut near = named.initialize(0.0, &with(&[PLACED, DOWN, &monitor])).unwrap();
    near.set("estimate.q[4]", 0.0);
    near.step_to(30.0).unwrap();
    assert_eq!(near.integer("mode.active"), OPERATIONAL);
    // An estimate with the Sun far outside the zone: its +Y at the Sun.
    let [x, y, z, w] = flight.quaternion("command.q");
    let away = to_inertial(&flight) * nalgebra::UnitQuaternion::from_scaled_axis(Vector3::z() * 3.0);
    assert!([x, y, z, w].iter().all(|it| it.is_finite()));
    flight.set_elements("estimate.q", away.coords.iter());
    for second in 1..=11 {
        let [mode, _] = step(&mut flight, &[]);
        // From the sample at 0 on; Safe Hold is given as long again to turn.
        let expected = match second {
            1..=5 => OPERATIONAL,
            6..=10 => SAFE_HOLD,
            _ => EARTH_ACQUISITION,
        };
        assert_eq!(mode, expected, "{second}");
    }
}

#[test]
fn every_demotion_says_why_in_mode_reason_and_in_the_log() {
    let named = NamedModel::<Guidance>::shipped();
    let at_once = [("monitor.persistence", 0.0), ("monitor.margin", 0.01)];
    let reason_of = |flight: &mut GuidanceInstance<'_>, sets: &[(&str, f64)]| {
        let before = named.warnings().len();
        step(flight, sets);
        (flight.integer("mode.active"), flight.integer("mode.reason"), named.warnings()[before..].to_vec())
    };
    let says = |(mode, reason, warnings): (i32, i32, Vec<String>), expected: (i32, i32), words: &[&str]| {
        assert_eq!((mode, reason), expected, "{warnings:?}");
        assert_eq!(warnings.len(), usize::from(!words.is_empty()), "{warnings:?}");
        assert!(words.iter().all(|word| warnings[0].contains(word)), "{words:?} {warnings:?}");
    };
    let zone_only = [("hotPole.enabled", 0.0)];
    let mut flight = named.initialize(0.0, &with(&[PLACED, DOWN, &at_once, &zone_only])).unwrap();
    says(reason_of(&mut flight, &[]), (OPERATIONAL, 0), &[]);
    let held: [f64; 4] = flight.quaternion("command.q");
    let away = to_inertial(&flight) * nalgebra::UnitQuaternion::from_scaled_axis(Vector3::z() * 3.0);
    flight.set_elements("estimate.q", away.coords.iter());
    says(reason_of(&mut flight, &[]), (SAFE_HOLD, 3), &["t = 1 s", "operational -> safeHold", "keepIn"]);
    let lower = (EARTH_ACQUISITION, 8);
    says(reason_of(&mut flight, &[]), lower, &["t = 2 s", "safeHold -> earthAcquisition", "noProgress"]);
    // What the ground asks for is no warning.
    flight.set_elements("estimate.q", held.iter());
    says(reason_of(&mut flight, &[("mode.request", 1.0)]), (OPERATIONAL, 1), &[]);
    let lost = [("estimate.valid", 0.0)];
    says(reason_of(&mut flight, &lost), (EARTH_ACQUISITION, 6), &["sunLost", "sun.sensedValid"]);
    let sun = [("sun.sensed[1]", 2.0), ("sun.sensedValid", 1.0)];
    says(reason_of(&mut flight, &sun), (EARTH_ACQUISITION, 5), &["earthAcquisition stays", "attitudeLost"]);
    says(reason_of(&mut flight, &[]), (EARTH_ACQUISITION, 5), &[]);
    let requested = [("estimate.valid", 1.0), ("mode.request", 2.0)];
    says(reason_of(&mut flight, &requested), (SAFE_HOLD, 1), &[]);

    // Over the subsolar point at 100 km, without a zone: -Z at the planet.
    let over = [
        ("keepIn.enabled", 0.0),
        ("position[1]", 2.54e6),
        ("position[2]", 0.0),
        ("position[3]", 0.0),
        ("sun.position[1]", 5e10),
        ("sun.position[2]", 0.0),
        ("sun.position[3]", 0.0),
    ];
    let mut low = named.initialize(0.0, &with(&[PLACED, &over, DOWN, &at_once])).unwrap();
    let half = core::f64::consts::FRAC_1_SQRT_2;
    low.set_elements("estimate.q", [0.0, half, 0.0, half].iter());
    says(reason_of(&mut low, &[]), (SAFE_HOLD, 4), &["hotPole", "operational -> safeHold"]);
}

#[test]
fn safe_hold_ignores_all_but_downlink() {
    let named = NamedModel::<Guidance>::shipped();
    let hold = [("mode.request", 2.0), ("monitor.enabled", 0.0)];
    let mut downlink = named.initialize(0.0, &with(&[PLACED, &hold, &[("pointing.scenario", 6.0)]])).unwrap();
    downlink.step_to(20.0).unwrap();
    assert_eq!(downlink.integer("command.kind"), ATTITUDE);
    for command in [
        &[("pointing.scenario", 0.0)][..],
        DOWN,
        &[("pointing.scenario", 2.0), ("aimpoint.option", 10.0), ("scan.frame", 1.0), ("scan.rate[1]", 1e-3)],
        &[("pointing.scenario", 10.0)],
    ] {
        let mut flight = named.initialize(0.0, &with(&[PLACED, &hold, command])).unwrap();
        flight.step_to(20.0).unwrap();
        assert_same(&flight, &downlink);
        assert_eq!(flight.integer("antenna.select"), downlink.integer("antenna.select"));
    }
    // Its own zone is always enforced, and no switch turns it off.
    let tight =
        [("safeHold.keepIn.azimuth", 0.0), ("safeHold.keepIn.elevation", 0.0), ("keepIn.enabled", 0.0)];
    let antenna = [("pointing.scenario", 6.0), ("boresight.option", 4.0), ("boresight.azimuth", -0.1)];
    let flight = named.initialize(0.0, &with(&[PLACED, &hold, &tight, &antenna])).unwrap();
    assert!(flight.boolean("constraint.sunKeepIn"));
    assert!(flight.real("sun.azimuth").abs() < 1e-12 && flight.real("sun.elevation").abs() < 1e-12);
}

#[test]
fn without_an_estimate_nothing_is_demoted_and_the_start_attitude_is_held() {
    let named = NamedModel::<Guidance>::shipped();
    let mut flight = named.initialize(0.0, PLACED).unwrap();
    let held = flight.quaternion("command.q");
    flight.step_to(600.0).unwrap();
    assert_eq!(["mode.active", "command.kind"].map(|name| flight.integer(name)), [OPERATIONAL, 0]);
    assert_eq!(flight.quaternion("command.q"), held);
}

#[test]
fn the_last_law_stays_within_its_zone_when_nothing_is_commanded() {
    let named = NamedModel::<Guidance>::shipped();
    let mut flight = named.initialize(0.0, &with(&[PLACED, DOWN])).unwrap();
    let mut other = named.initialize(0.0, &with(&[PLACED, DOWN])).unwrap();
    for second in 1..=900 {
        if second == 20 {
            flight.set("pointing.scenario", 0.0);
        }
        for it in [&mut flight, &mut other] {
            it.step_to(f64::from(second)).unwrap();
        }
        assert_eq!(flight.quaternion("command.q"), other.quaternion("command.q"), "{second}");
    }
}

#[test]
fn an_aim_without_direction_leaves_the_law_before_it() {
    let named = NamedModel::<Guidance>::shipped();
    let mut flight = named.initialize(0.0, &with(&[PLACED, DOWN])).unwrap();
    let mut other = named.initialize(0.0, &with(&[PLACED, DOWN])).unwrap();
    flight.step_to(5.0).unwrap();
    flight.set("pointing.scenario", 2.0);
    flight.set("aimpoint.option", 1.0);
    flight.step_to(60.0).unwrap();
    other.step_to(60.0).unwrap();
    assert_eq!(flight.quaternion("command.q"), other.quaternion("command.q"));
    assert!(flight.boolean("geometry.degenerate") && !other.boolean("geometry.degenerate"));
}

#[test]
fn the_sun_aimed_at_by_plus_z_stands_still_on_the_zones_edge() {
    let named = NamedModel::<Guidance>::shipped();
    let sets = [("pointing.scenario", 2.0), ("aimpoint.option", 10.0)];
    let mut flight = named.initialize(0.0, &with(&[PLACED, &sets])).unwrap();
    for second in 1..=60 {
        flight.step_to(f64::from(second)).unwrap();
        assert!(flight.real("sun.azimuth").abs() < 1e-6, "{second}");
        assert!((flight.real("sun.elevation").abs() - 13.0_f64.to_radians()).abs() < 1e-6, "{second}");
    }
}
