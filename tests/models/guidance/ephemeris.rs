//! Onboard ephemerides: one that contradicts the Sun sensors is not used, and each mode keeps to what paper 001 allows it.

use models::Guidance;
use nalgebra::Vector3;
use physics::bodies::Body;

use super::super::named_model::{NamedModel, assert_cuts_change_nothing, assert_same};
use super::super::onboard_ephemeris::{FILE, START_S, file, from_mercury};
use super::{FREE, GuidanceInstance, to_inertial, with};

const OPERATIONAL: i32 = 1;
const SAFE_HOLD: i32 = 2;
const EARTH_ACQUISITION: i32 = 3;
const BY_EPHEMERIS: i32 = 7;
const PRECISE: i32 = 1;
const COARSE: i32 = 2;
const DEG: f64 = core::f64::consts::PI / 180.0;

/// Above Mercury, at its centre by an instrument.
const ABOVE: &[(&str, f64)] = &[
    ("ephemeris.source", 4.0),
    ("pointing.scenario", 3.0),
    ("position[1]", 3e6),
    ("position[2]", 1e6),
    ("position[3]", 2e6),
    ("velocity[1]", -900.0),
    ("velocity[2]", 2_000.0),
    ("velocity[3]", 400.0),
];

fn position_m() -> Vector3<f64> {
    Vector3::new(3e6, 1e6, 2e6)
}

/// A flight of a guidance with a file whose Sun is turned aside.
fn with_file(span_s: f64, turned_rad: f64) -> NamedModel<Guidance> {
    NamedModel::<Guidance>::shipped().with_schedule(FILE, &file(span_s, turned_rad).0)
}

/// Measurements of the commanded attitude: estimate and Sun.
fn sense(flight: &mut GuidanceInstance<'_>) {
    let to_body = to_inertial(flight).inverse();
    let sun_m = from_mercury(Body::Sun, START_S + flight.time_s()).position_m - position_m();
    let q = flight.quaternion("command.q");
    flight.set_elements("estimate.q", q.iter());
    flight.set_elements("sun.sensed", &(to_body * sun_m.normalize()));
    flight.set("sun.sensedValid", 1.0);
}

fn seen(flight: &GuidanceInstance<'_>) -> (i32, bool, i32) {
    (flight.integer("mode.active"), flight.boolean("ephemeris.valid"), flight.integer("ephemeris.active"))
}

/// Angle between the true Sun and -Y of the commanded frame.
fn sun_from_minus_y_rad(flight: &GuidanceInstance<'_>) -> f64 {
    let sun_m = from_mercury(Body::Sun, START_S + flight.time_s()).position_m - position_m();
    (to_inertial(flight).inverse() * sun_m).angle(&-Vector3::y())
}

#[test]
fn a_sun_five_degrees_off_is_lost_after_its_persistence_and_the_coarse_one_simulated_by() {
    let named = with_file(86_400.0, 5.0 * DEG);
    let mut flight = named.initialize(0.0, ABOVE).unwrap();
    for second in 1..=40 {
        sense(&mut flight);
        flight.step_to(f64::from(second)).unwrap();
        // The sample at 10 s, which belongs to the step that ends at 11 s, has lasted for ten.
        let expected = if second <= 10 { (OPERATIONAL, true, PRECISE) } else { (SAFE_HOLD, false, COARSE) };
        assert_eq!(seen(&flight), expected, "{second}");
        assert_eq!(flight.integer("mode.reason"), if second <= 10 { 0 } else { BY_EPHEMERIS }, "{second}");
    }
    // Safe Hold commands downlink within its keep-in zone: now with the Sun where it is, to the coarse model's error.
    let elevation_rad = flight.real("sun.elevation");
    let off_rad = (sun_from_minus_y_rad(&flight) - elevation_rad.hypot(flight.real("sun.azimuth"))).abs();
    assert!(off_rad < 3e-4, "{off_rad}");
    // A request of the ground trusts the same file again, and it is lost again.
    flight.set("mode.request", 1.0);
    for second in 41..=60 {
        sense(&mut flight);
        flight.step_to(f64::from(second)).unwrap();
        let expected = if second <= 50 { (OPERATIONAL, true, PRECISE) } else { (SAFE_HOLD, false, COARSE) };
        assert_eq!(seen(&flight), expected, "{second}");
    }
}

#[test]
fn a_sun_within_the_tolerance_and_one_that_is_not_judged_stay() {
    for (turned_deg, is_sensed) in [(0.0, true), (1.9, true), (5.0, false)] {
        let named = with_file(86_400.0, turned_deg * DEG);
        let mut flight = named.initialize(0.0, ABOVE).unwrap();
        for second in 1..=30 {
            if is_sensed {
                sense(&mut flight);
            }
            flight.step_to(f64::from(second)).unwrap();
        }
        assert_eq!(seen(&flight), (OPERATIONAL, true, PRECISE), "{turned_deg}");
    }
}

#[test]
fn earth_acquisition_goes_by_coarse_models_and_other_sources_know_none() {
    let named = with_file(86_400.0, 0.0);
    for (source, request, expected) in [
        (4.0, 2.0, (SAFE_HOLD, true, PRECISE)),
        (4.0, 3.0, (EARTH_ACQUISITION, true, COARSE)),
        (5.0, 1.0, (OPERATIONAL, true, COARSE)),
        (1.0, 3.0, (EARTH_ACQUISITION, true, PRECISE)),
        (2.0, 3.0, (EARTH_ACQUISITION, true, PRECISE)),
    ] {
        let sets = [("ephemeris.source", source), ("mode.request", request)];
        let mut flight = named.initialize(0.0, &with(&[ABOVE, &sets])).unwrap();
        flight.step_to(3.0).unwrap();
        assert_eq!(seen(&flight), expected, "{source} {request}");
    }
}

#[test]
fn a_span_that_ends_in_flight_ends_operational_and_one_not_begun_is_refused() {
    let named = with_file(100.0, 0.0);
    let mut flight = named.initialize(0.0, ABOVE).unwrap();
    for second in 1..=120 {
        flight.step_to(f64::from(second)).unwrap();
        let expected = if second <= 101 { (OPERATIONAL, true, PRECISE) } else { (SAFE_HOLD, false, COARSE) };
        assert_eq!(seen(&flight), expected, "{second}");
    }
    for epoch_s in [START_S - 1.0, START_S + 101.0] {
        let text = named.refusal(&with(&[ABOVE, &[("start.epoch", epoch_s)]]));
        assert!(text.contains("start.epoch: found") && text.contains(FILE), "{text}");
        named
            .initialize(0.0, &with(&[ABOVE, &[("start.epoch", epoch_s), ("ephemeris.source", 1.0)]]))
            .unwrap();
    }
    let text = named.refusal(&with(&[ABOVE, &[("target.planet", 3.0)]]));
    assert!(text.contains("found no [[body]] that joins sun with venus"), "{text}");
}

#[test]
fn without_a_file_the_precise_models_are_those_of_vsop87_to_the_bit() {
    let named = NamedModel::<Guidance>::shipped();
    let mut simulated = named.initialize(0.0, ABOVE).unwrap();
    let mut theory = named.initialize(0.0, &with(&[ABOVE, &[("ephemeris.source", 1.0)]])).unwrap();
    for end_s in [1.0, 30.0, 4_000.0] {
        for flight in [&mut simulated, &mut theory] {
            flight.step_to(end_s).unwrap();
        }
        assert_same(&simulated, &theory);
    }
    assert_eq!(seen(&simulated), (OPERATIONAL, true, PRECISE));
}

#[test]
fn a_file_points_as_vsop87_does_to_its_error_and_the_coarse_models_to_theirs() {
    let (text, error_m) = file(10.0 * 86_400.0, 0.0);
    let named = NamedModel::<Guidance>::shipped().with_schedule(FILE, &text);
    let simulate = |source: f64| {
        let sets = [("ephemeris.source", source), ("pointing.scenario", 6.0)];
        let mut flight = named.initialize(0.0, &with(&[ABOVE, FREE, &sets])).unwrap();
        flight.step_to(86_400.0).unwrap();
        flight.to_inertial("command.q")
    };
    let [theory, simulated, coarse] = [1.0, 4.0, 5.0].map(simulate);
    let [simulated_rad, coarse_rad] = [simulated, coarse].map(|it| it.angle_to(&theory));
    // The attitude turns by the error's angle, at the Sun and at the Earth, as seen from 4e10 m at least.
    assert!(simulated_rad < 4.0 * error_m / 4e10 + 1e-12, "{simulated_rad:e} rad for {error_m} m");
    assert!(coarse_rad < 1e-3 && coarse_rad > simulated_rad, "{coarse_rad:e}");
}

#[test]
fn neither_cuts_nor_saving_change_a_bit_of_a_fall_back() {
    let named = with_file(86_400.0, 5.0 * DEG);
    let mut first = named.initialize(0.0, ABOVE).unwrap();
    sense(&mut first);
    let sensed: Vec<(String, f64)> = ["estimate.q[1]", "estimate.q[2]", "estimate.q[3]", "estimate.q[4]"]
        .into_iter()
        .chain(["sun.sensed[1]", "sun.sensed[2]", "sun.sensed[3]"])
        .map(|name| (name.to_owned(), first.real(name)))
        .chain([("sun.sensedValid".to_owned(), 1.0)])
        .collect();
    let sensed: Vec<(&str, f64)> = sensed.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    let initialize = || named.initialize(0.0, &with(&[ABOVE, &sensed])).unwrap();
    let mut last = None;
    assert_cuts_change_nothing(initialize, [9.0, 10.5, 25.0, 60.0], &[0.7, 0.1, 0.3, 7.0], |it| {
        last = Some(seen(it))
    });
    assert_eq!(last, Some((SAFE_HOLD, false, COARSE)));
}
