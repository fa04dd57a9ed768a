//! Fits keep the error they state, files are read back to the bit, and what is wrong in one is reported by name.

use nalgebra::Vector3;

use super::*;
use crate::bodies::Body;
use crate::constants::{DAY_S, GM_MERCURY_M3_S2};
use crate::environment::CartesianState;
use crate::environment::coarse_ephemeris::CoarseEphemeris;
use crate::environment::ephemeris::Ephemeris;
use crate::environment::kepler_planet::MESSENGER_AS_PRINTED;
use crate::environment::orbit::TwoBodyOrbit;
use crate::environment::time::MOMENTUM_STUDY_START_S as START_S;
use crate::numerics::Span;
use crate::numerics::chebyshev::Segment;
use crate::tests::short_or_long;

const SPAN: Span = Span::new(START_S, START_S + 40.0 * DAY_S);

fn negative(state: CartesianState) -> CartesianState {
    CartesianState { position_m: -state.position_m, velocity_m_s: -state.velocity_m_s }
}

/// The Sun from Mercury and the Earth from the Sun by VSOP87, and the spacecraft on its printed orbit.
fn motion(target: OnboardTarget) -> impl FnMut(f64) -> CartesianState {
    let mut ephemeris = Ephemeris::default();
    let orbit = TwoBodyOrbit::from_elements(MESSENGER_AS_PRINTED, GM_MERCURY_M3_S2, START_S).unwrap();
    move |epoch_s| match target {
        OnboardTarget::Sun => negative(ephemeris.state(Body::Mercury, epoch_s)),
        OnboardTarget::Earth => ephemeris.state(Body::Earth, epoch_s),
        _ => orbit.state_at(epoch_s),
    }
}

fn fitted(target: OnboardTarget, center: Body, segment_s: f64, degree: usize) -> FittedBody<SegmentTable> {
    let plan = FitPlan::new(SPAN, segment_s);
    let states: Vec<_> = plan.epochs_s().into_iter().map(motion(target)).collect();
    let (motion, error) = plan.fit(&states, degree);
    FittedBody { target, center, motion, error }
}

fn mission() -> OnboardEphemeris {
    OnboardEphemeris {
        source: Some("VSOP87 \"as tested\"".to_owned()),
        precise: vec![
            fitted(OnboardTarget::Sun, Body::Mercury, 4.0 * DAY_S, 7),
            fitted(OnboardTarget::Earth, Body::Sun, 8.0 * DAY_S, 7),
            fitted(OnboardTarget::Spacecraft, Body::Mercury, 1800.0, 12),
        ],
        // A span whose ends the middle and half its length do not give back.
        coarse: vec![coarse_mercury(Span::new(START_S + 0.1, START_S + 4.0 * 365.25 * DAY_S + 0.7))],
    }
}

fn coarse_mercury(span: Span) -> FittedBody<CoarseElements> {
    let elements = Segment::<6, 32>::nodes(span.start_s, span.end_s).map(|at_s| {
        KeplerianElements::from([5.79e10, 0.2056, 0.498, 0.19, 1.17, 8.27e-7 * (at_s - START_S)])
    });
    let motion = CoarseElements::from_elements(Body::Sun, span, &elements);
    FittedBody { target: OnboardTarget::Mercury, center: Body::Sun, motion, error: FitError::default() }
}

#[test]
fn stated_errors_bound_the_fit_and_are_nearly_reached() {
    for body in mission().precise {
        let mut truth = motion(body.target);
        let mut found = FitError::default();
        // Epochs that are neither nodes nor checks, an irrational part of the span apart.
        for i in 0..short_or_long(3_000, 20_000) {
            let epoch_s = SPAN.start_s + SPAN.length_s() * (f64::from(i) * 0.618_033_988_75).fract();
            let state = body.motion.state(epoch_s).unwrap();
            found = found.worst(FitError::from_states(&state, &truth(epoch_s)));
        }
        let [position, velocity] =
            [found.position_m / body.error.position_m, found.velocity_m_s / body.error.velocity_m_s];
        assert!(position < 1.05 && velocity < 1.05, "{}: {position} {velocity}", body.target);
        // Among few epochs none need be near the worst.
        let nearly = short_or_long(0.0, 0.5);
        assert!(position > nearly && velocity > nearly, "{}: {position} {velocity}", body.target);
    }
}

#[test]
fn velocity_is_the_derivative_of_position() {
    let body = fitted(OnboardTarget::Spacecraft, Body::Mercury, 1800.0, 12);
    for i in 0..500 {
        let epoch_s = SPAN.start_s + 1.0 + 1000.0 * f64::from(i);
        let [before, after] = [-0.5, 0.5].map(|step_s| body.motion.state(epoch_s + step_s).unwrap());
        let slope = after.position_m - before.position_m;
        // Positions near 1e7 m at epochs near 3e8 s: 6e-8 s of rounding at 3 km/s.
        let velocity = body.motion.state(epoch_s).unwrap().velocity_m_s;
        assert!((slope - velocity).norm() < 2e-3, "{}", (slope - velocity).norm());
    }
}

#[test]
fn what_lies_outside_the_span_is_refused() {
    let carried = mission();
    for (target, center) in [(OnboardTarget::Sun, Body::Mercury), (OnboardTarget::Earth, Body::Mercury)] {
        assert_eq!(carried.span(target, center), Some(SPAN));
        for inside_s in [SPAN.start_s, SPAN.end_s] {
            assert!(carried.state(target, center, inside_s).is_some());
        }
        for outside_s in [SPAN.start_s.next_down(), SPAN.end_s.next_up(), f64::NAN] {
            assert!(carried.state(target, center, outside_s).is_none());
        }
        // For an integrator that looks ahead the last state moves on evenly.
        let last = carried.state(target, center, SPAN.end_s).unwrap();
        let ahead = carried.state_carried_on(target, center, SPAN.end_s + 64.0).unwrap();
        assert_eq!(ahead.velocity_m_s, last.velocity_m_s);
        assert!((ahead.position_m - last.position_m - last.velocity_m_s * 64.0).norm() < 1e-3);
    }
    assert!(carried.coarse_state(OnboardTarget::Mercury, START_S).is_none());
    assert_eq!(carried.span(OnboardTarget::Venus, Body::Mercury), None);
    assert!(carried.state_carried_on(OnboardTarget::Venus, Body::Mercury, SPAN.start_s).is_none());
}

#[test]
fn positions_from_any_center_are_the_differences_of_those_given() {
    let carried = mission();
    let epoch_s = START_S + 12.3 * DAY_S;
    let given = |index: usize| carried.precise[index].motion.state(epoch_s).unwrap();
    let [sun_from_mercury, earth_from_sun, spacecraft] = [0, 1, 2].map(given);
    let from = |target, center| carried.state(target, center, epoch_s).unwrap();
    assert_eq!(from(OnboardTarget::Sun, Body::Mercury), sun_from_mercury);
    assert_eq!(from(OnboardTarget::Earth, Body::Sun), earth_from_sun);
    assert_eq!(from(OnboardTarget::Mercury, Body::Sun), negative(sun_from_mercury));
    assert_eq!(from(OnboardTarget::Spacecraft, Body::Mercury), spacecraft);
    let earth_m = sun_from_mercury.position_m + earth_from_sun.position_m;
    assert!((from(OnboardTarget::Earth, Body::Mercury).position_m - earth_m).norm() < 1e-4);
    let back_m = spacecraft.position_m - earth_m;
    assert!((from(OnboardTarget::Spacecraft, Body::Earth).position_m - back_m).norm() < 1e-4);
    assert_eq!(from(OnboardTarget::Mercury, Body::Mercury), CartesianState::default());
}

#[test]
fn a_file_is_read_back_to_the_bit() {
    let carried = mission();
    let text = to_toml(&carried);
    assert_eq!(OnboardEphemeris::from_toml("", &text).unwrap(), carried);
}

#[test]
fn edges_lie_at_whole_multiples_of_the_length() {
    let plan = FitPlan::new(Span::new(-12.0, 31.0), 10.0);
    let epochs_s = plan.epochs_s();
    assert_eq!(plan.edges_s.len(), 7);
    for edge_s in [-10.0, 0.0, 10.0, 20.0, 30.0] {
        assert_eq!(epochs_s.iter().filter(|at_s| **at_s == edge_s).count(), 1, "{edge_s}");
    }
    assert!(epochs_s.is_sorted_by(|a, b| a < b) && epochs_s[0] == -12.0);
    assert!((epochs_s.last().unwrap() - 31.0).abs() < 2e-6);
    assert_eq!(FitPlan::new(Span::new(0.0, 1.0), 0.0).edges_s.len(), 2);
    assert_eq!(FitPlan::new(Span::new(0.0, 20.0), 10.0).edges_s.len(), 3);
}

/// Greatest angle between the directions from the Sun, in rad, and greatest distance, in m, and of the velocities, in m/s.
fn coarse_error(body: Body) -> (f64, FitError) {
    let (mut ephemeris, mut coarse) = (Ephemeris::default(), CoarseEphemeris::default());
    let (mut angle_rad, mut error) = (0.0_f64, FitError::default());
    let count = short_or_long(1_000, 3_000);
    for i in 0..count {
        let epoch_s = (f64::from(2 * i) / f64::from(count) - 1.0) * 50.0 * 365.25 * DAY_S;
        let (truth, found) = (ephemeris.state(body, epoch_s), coarse.state(body, epoch_s));
        error = error.worst(FitError::from_states(&found, &truth));
        let across = found.position_m.cross(&truth.position_m).norm();
        angle_rad = angle_rad.max(across.atan2(found.position_m.dot(&truth.position_m)));
    }
    (angle_rad, error)
}

#[test]
fn coarse_planets_stay_within_the_stated_error_of_vsop87() {
    let cases = [
        (Body::Mercury, 1.1e-4, 4.6),
        (Body::Venus, 1.3e-4, 3.2),
        // The Earth swings about its barycentre with the Moon: 4,700 km and 12 m/s of it.
        (Body::Earth, 1.3e-4, 15.5),
        (Body::Mars, 2.9e-4, 4.4),
        (Body::Jupiter, 1.4e-4, 7.4),
    ];
    let found = cases.map(|(body, ..)| coarse_error(body));
    for ((body, allowed_rad, allowed_m_s), (angle_rad, error)) in cases.into_iter().zip(found) {
        assert!(angle_rad < allowed_rad && angle_rad > 0.8 * allowed_rad, "{body:?}: {angle_rad:e} rad");
        let velocity_m_s = error.velocity_m_s;
        assert!(velocity_m_s < allowed_m_s && velocity_m_s > 0.8 * allowed_m_s, "{body:?}: {error:?}");
    }
}

/// A small file, right as it stands.
const SMALL: &str = r#"frame = "EME2000"

[[body]]
body = "sun"
center = "mercury"
degree = 1
error_m = 1.0
error_m_s = 1e-3
segment = [
    { start_s = 0.0, end_s = 10.0, x_m = [5e10, 1.0], y_m = [0.0, 0.0], z_m = [0.0, 0.0] },
    { start_s = 10.0, end_s = 20.0, x_m = [5e10, 1.0], y_m = [0.0, 0.0], z_m = [0.0, 0.0] },
]

[[coarse]]
body = "earth"
center = "sun"
start_s = 0.0
end_s = 1e6
error_m = 1e7
error_m_s = 1.0
semi_major_axis_m = [1.5e11, 0.0, 0.0, 0.0, 0.0]
eccentricity = [0.0167, 0.0, 0.0, 0.0, 0.0]
inclination_rad = [0.4, 0.0, 0.0, 0.0, 0.0]
ascending_node_rad = [0.0, 0.0, 0.0, 0.0, 0.0]
periapsis_argument_rad = [1.8, 0.0, 0.0, 0.0, 0.0]
mean_anomaly_rad = [0.0, 0.1, 0.0, 0.0, 0.0]
"#;

#[test]
fn the_small_file_is_right_and_a_straight_line() {
    let carried = OnboardEphemeris::from_toml("", SMALL).unwrap();
    let state = carried.state(OnboardTarget::Sun, Body::Mercury, 15.0).unwrap();
    // T_1 rises by 2 m over 10 s.
    assert_eq!(state.position_m, Vector3::new(5e10, 0.0, 0.0));
    assert_eq!(state.velocity_m_s, Vector3::new(0.2, 0.0, 0.0));
}

#[test]
fn what_is_wrong_is_reported_by_line_and_key() {
    let second = "{ start_s = 10.0, end_s = 20.0";
    for (old, new, message) in [
        (
            second,
            "{ start_s = 11.0, end_s = 20.0",
            "e.toml:11: body[1].segment[2].start_s: found 1.1e1, a gap of 1e0 s",
        ),
        (
            second,
            "{ start_s = 9.0, end_s = 20.0",
            "e.toml:11: body[1].segment[2].start_s: found 9e0, an overlap of 1e0 s",
        ),
        (second, "{ start_s = 10.0, end_s = 10.0", "segment[2].end_s: found 1e1, allowed: more than start_s"),
        (
            second,
            "{ start_s = 10.0, end_s = 1e12",
            "segment[2].end_s: found 1000000000000, allowed: s past J2000",
        ),
        ("x_m = [5e10, 1.0]", "x_m = [5e10, nan]", "body[1].segment[1].x_m[2]: found NaN, allowed: a finite"),
        ("x_m = [5e10, 1.0]", "x_m = [5e10]", "segment[1].x_m: found 1 coefficients, allowed: 2, one more"),
        ("degree = 1", "degree = 99", "body[1].degree: found 99, allowed: a degree from 0 to 24"),
        ("degree = 1", "", "found no key `degree`"),
        ("error_m = 1.0", "error_m = -1.0", "body[1].error_m: found -1"),
        ("EME2000", "ECLIPJ2000", "e.toml:1: frame: found the unknown word `ECLIPJ2000`"),
        ("body = \"sun\"", "body = \"mercury\"", "body[1].center: found mercury, allowed: another body"),
        ("body = \"sun\"", "body = \"sum\"", "found the unknown word `sum` (did you mean `sun`?)"),
        ("center = \"sun\"", "center = \"mars\"", "coarse[1].center: found mars, allowed: sun"),
        ("[1.5e11,", "[-1.5e11,", "coarse[1].semi_major_axis_m: found -1.5e11 m, allowed: above 0"),
        ("[0.0167,", "[1.0167,", "coarse[1].eccentricity: found 1.0167, allowed: from 0"),
        ("[1.5e11, 0.0,", "[1.5e11,", "semi_major_axis_m: found a list of length 4"),
    ] {
        assert!(SMALL.contains(old), "{old}");
        let error =
            OnboardEphemeris::from_toml("e.toml", &SMALL.replacen(old, new, 1)).unwrap_err().to_string();
        assert!(error.contains(message), "{new}: {error}");
    }
    let cut = SMALL.find("center = \"sun\"").unwrap() - 3;
    let torn = OnboardEphemeris::from_toml("e.toml", &SMALL[..cut]).unwrap_err().to_string();
    assert!(torn.contains("e.toml:15") && torn.contains("not TOML"), "{torn}");
    let empty = OnboardEphemeris::from_toml("e.toml", "frame = \"EME2000\"").unwrap_err().to_string();
    assert!(empty.contains("found no body"), "{empty}");
    let entry = &SMALL[SMALL.find("[[body]]").unwrap()..SMALL.find("[[coarse]]").unwrap()];
    for (other, message) in [
        (entry.to_owned(), "body[2].body: found sun for the second time, allowed: each body once"),
        (
            entry
                .replace("\"sun\"", "\"m\"")
                .replace("\"mercury\"", "\"sun\"")
                .replace("\"m\"", "\"mercury\""),
            "body[2].center: found sun, whose own position counts from mercury",
        ),
    ] {
        let error =
            OnboardEphemeris::from_toml("e.toml", &format!("{SMALL}\n{other}")).unwrap_err().to_string();
        assert!(error.contains(message), "{error}");
    }
}
