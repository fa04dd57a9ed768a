//! The transitions as a table, the search axis by axis, and where the error quaternion takes the boresight.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::Rotation3;

use super::*;
use crate::attitude::angle_between_rad;
use crate::bodies::Body;
use crate::guidance::constraints::hot_pole::HotPole;
use crate::guidance::constraints::keep_in::KeepIn;
use crate::guidance::downlink::sun_direction::{DownlinkRequest, downlink};
use crate::guidance::geometry::moving::unit;
use crate::guidance::pointing::antenna::tests::quadrants;
use crate::guidance::pointing::command::{PointingCommand, Scenario};
use crate::guidance::tests::geometry::{Random, cube_directions, nearest_zone};
use crate::guidance::tests::orbit::about_mercury;
use Mode::{EarthAcquisition, Operational, SafeHold};

fn zone(limit_rad: f64) -> KeepIn {
    nearest_zone(limit_rad, limit_rad)
}

fn settings() -> ModeSettings {
    ModeSettings {
        operational: Constraints { keep_in: Some(zone(0.3)), hot_pole: None },
        safe_hold: Constraints { keep_in: Some(zone(0.2)), hot_pole: None },
        monitor: Some(Monitor { margin_rad: 0.01, persistence_s: 0.0 }),
        ephemeris_check: None,
        watches_hot_pole: true,
        boresight_body: -Vector3::y() * 2.0,
        earth_acquisition_rate_rad_s: 1e-3,
        sun_search_rate_rad_s: 2e-3,
        sun_search_duration_s: 600.0,
    }
}

fn ephemeris() -> EphemerisAtTime {
    let position = Vector3::x() * Body::Mercury.data().radius_m * 2.0;
    about_mercury(position, Vector3::x() * 5e10, Vector3::new(4e10, 8e10, 1e10))
}

fn known() -> BodyPositions {
    BodyPositions::in_every_mode(Some(ephemeris()))
}

/// -Y at the Sun along +x, turned on by `angle_rad` about Z: that is the Sun's azimuth, save for its sign.
fn estimate(angle_rad: f64) -> Attitude {
    Attitude::from_rotation(&Rotation3::from_axis_angle(&Vector3::z_axis(), FRAC_PI_2 + angle_rad))
}

fn sensed(request: Option<Mode>, estimate: Option<Attitude>) -> Sensed {
    Sensed { time_s: 0.0, request, is_of_timeline: false, estimate, sun_body: None }
}

#[test]
fn the_modes_change_by_the_table() {
    let (safe, unsafe_both, unsafe_hold) = (Some(estimate(0.0)), Some(estimate(0.5)), Some(estimate(0.25)));
    // From, request before, request, estimate, to.
    let table = [
        (Operational, None, None, safe, Operational),
        (Operational, None, None, unsafe_hold, Operational),
        (Operational, None, None, unsafe_both, SafeHold),
        (Operational, None, None, None, EarthAcquisition),
        (Operational, None, Some(SafeHold), safe, SafeHold),
        (Operational, None, Some(EarthAcquisition), safe, EarthAcquisition),
        (Operational, None, Some(SafeHold), unsafe_hold, EarthAcquisition),
        (Operational, Some(Operational), Some(Operational), unsafe_both, SafeHold),
        (SafeHold, None, None, safe, SafeHold),
        (SafeHold, None, None, unsafe_hold, EarthAcquisition),
        (SafeHold, None, None, None, EarthAcquisition),
        (SafeHold, None, Some(Operational), safe, Operational),
        (SafeHold, None, Some(Operational), unsafe_hold, Operational),
        (SafeHold, None, Some(Operational), unsafe_both, SafeHold),
        (SafeHold, None, Some(Operational), None, EarthAcquisition),
        (SafeHold, Some(Operational), Some(Operational), safe, SafeHold),
        (EarthAcquisition, None, None, safe, EarthAcquisition),
        (EarthAcquisition, None, None, unsafe_both, EarthAcquisition),
        (EarthAcquisition, None, None, None, EarthAcquisition),
        (EarthAcquisition, None, Some(SafeHold), safe, SafeHold),
        (EarthAcquisition, None, Some(Operational), safe, Operational),
        (EarthAcquisition, Some(SafeHold), Some(Operational), safe, Operational),
        (EarthAcquisition, None, Some(Operational), None, EarthAcquisition),
        (EarthAcquisition, Some(Operational), Some(Operational), safe, EarthAcquisition),
    ];
    for (row, (mode, last_request, request, estimate, expected)) in table.into_iter().enumerate() {
        for sun_body in [None, Some(Vector3::x())] {
            let mut state = ModeState { mode, last_request, ..ModeState::default() };
            let sensed = Sensed { sun_body, ..sensed(request, estimate) };
            let steering = state.sample(&settings(), &sensed, &known()).unwrap();
            assert_eq!(state.mode, expected, "row {row}");
            let lost = estimate.is_none() && sun_body.is_none();
            match steering {
                Steering::Pointing(constraints) if expected == Operational => {
                    assert_eq!(constraints, settings().operational)
                }
                Steering::Pointing(constraints) => {
                    assert_eq!((expected, constraints), (SafeHold, settings().safe_hold))
                }
                Steering::ErrorQuaternion { .. } => assert!(expected == EarthAcquisition && !lost),
                Steering::RateOnly(_) => assert!(expected == EarthAcquisition && lost),
            }
        }
    }
}

#[test]
fn the_reason_is_that_of_the_last_change_of_mode() {
    let (safe, unsafe_both) = (Some(estimate(0.0)), Some(estimate(0.5)));
    let sun = Some(Vector3::x());
    let mut state = ModeState::default();
    // Request, of a timeline, estimate, Sun; mode and reason after it.
    for (row, (request, is_of_timeline, estimate, sun_body, mode, reason)) in [
        (None, false, safe, None, Operational, None),
        (Some(Operational), false, safe, None, Operational, None),
        (Some(SafeHold), false, safe, None, SafeHold, Some(ModeReason::Request)),
        (Some(Operational), true, safe, None, Operational, Some(ModeReason::Timeline)),
        (Some(Operational), true, unsafe_both, None, SafeHold, Some(ModeReason::SunKeepIn)),
        (Some(Operational), true, unsafe_both, None, EarthAcquisition, Some(ModeReason::NoProgress)),
        (Some(Operational), true, None, sun, EarthAcquisition, Some(ModeReason::AttitudeLost)),
        (Some(Operational), true, None, None, EarthAcquisition, Some(ModeReason::SunLost)),
        (Some(Operational), true, safe, None, EarthAcquisition, Some(ModeReason::SunLost)),
        (None, false, safe, None, EarthAcquisition, Some(ModeReason::SunLost)),
        (Some(Operational), false, safe, None, Operational, Some(ModeReason::Request)),
        // What demotes at the same sample outweighs the request.
        (Some(SafeHold), false, None, sun, EarthAcquisition, Some(ModeReason::AttitudeLost)),
    ]
    .into_iter()
    .enumerate()
    {
        let sensed = Sensed { sun_body, is_of_timeline, ..sensed(request, estimate) };
        state.sample(&settings(), &sensed, &known()).unwrap();
        assert_eq!((state.mode, state.reason), (mode, reason), "row {row}");
    }
}

#[test]
fn without_ephemeris_or_monitor_nothing_is_judged() {
    let far_off = sensed(None, Some(estimate(2.0)));
    let mut state = ModeState::default();
    state.sample(&settings(), &far_off, &BodyPositions::in_every_mode(None)).unwrap();
    assert_eq!(state.mode, Operational);
    let unwatched = ModeSettings { monitor: None, ..settings() };
    state.sample(&unwatched, &far_off, &known()).unwrap();
    assert_eq!(state.mode, Operational);
}

#[test]
fn after_a_promotion_a_violation_counts_in_full() {
    let mut settings = settings();
    settings.monitor = Some(Monitor { margin_rad: 0.01, persistence_s: 2.0 });
    let mut state = ModeState::default();
    // The Sun comes nearer all the time: a safing turn that makes progress, until the promotion ends the lenience.
    for (time_s, angle_rad, request, expected) in [
        (0.0, 2.0, None, Operational),
        (1.0, 1.9, None, Operational),
        (2.0, 1.8, None, SafeHold),
        (3.0, 1.7, None, SafeHold),
        (5.0, 1.6, None, SafeHold),
        (6.0, 1.5, Some(Operational), Operational),
        (7.0, 1.4, Some(Operational), Operational),
        (8.0, 1.3, Some(Operational), SafeHold),
    ] {
        let sensed = Sensed { time_s, ..sensed(request, Some(estimate(angle_rad))) };
        state.sample(&settings, &sensed, &known()).unwrap();
        assert_eq!(state.mode, expected, "{time_s}");
    }
}

#[test]
fn a_demoted_mode_commands_a_safe_attitude_at_once() {
    let ephemeris = ephemeris();
    let mut settings = settings();
    let cone = HotPole { altitude_m: 1e8, angle_rad: 0.5, cone_rad: 1.7 };
    settings.safe_hold.hot_pole = Some(cone);
    let mut state = ModeState::default();
    let sample = state.sample(&settings, &sensed(None, Some(estimate(2.0))), &known()).unwrap();
    let Steering::Pointing(constraints) = sample else { panic!("{sample:?}") };
    assert_eq!(state.mode, SafeHold);
    for azimuth_rad in [None, Some(-1.5), Some(2.0)] {
        let request = DownlinkRequest { antenna_azimuth_rad: azimuth_rad, ..DownlinkRequest::default() };
        let found = downlink(&ephemeris.to_sun(), &ephemeris.to_earth(), &quadrants(), &request).unwrap();
        let kept = constraints.applied(&found.vectors, &ephemeris, None).unwrap();
        let body = |v| value(&kept.pointing.to_body(&unit(&v).unwrap()));
        let excess_rad =
            constraints.excess(&body(ephemeris.to_sun()), &body(ephemeris.to_planet()), true).greatest_rad();
        // The planet is opposite the Sun here: the cone is out of reach with the Sun on -Y, and flagged.
        assert!(excess_rad < 1e-12 || !kept.hot_pole_reached, "{excess_rad} {kept:?}");
    }
}

#[test]
fn safe_hold_takes_downlink_without_scan_and_nothing_else() {
    let mut requested = PointingCommand { scenario: Some(Scenario::Gimbal), ..PointingCommand::default() };
    requested.boresight.azimuth_rad = -0.5;
    requested.scan.rate_rad_s = [1e-3, 0.0, 0.0];
    assert_eq!(Operational.allowed(&requested), requested);
    let default = PointingCommand { scenario: Some(Scenario::Downlink), ..PointingCommand::default() };
    assert_eq!(SafeHold.allowed(&requested), default);
    requested.scenario = Some(Scenario::Downlink);
    let allowed = SafeHold.allowed(&requested);
    assert_eq!((allowed.boresight, allowed.scan), (requested.boresight, default.scan));
}

#[test]
fn losing_the_sun_sensors_alone_demotes_nothing() {
    let mut state = ModeState::default();
    for request in [None, Some(SafeHold)] {
        state.sample(&settings(), &sensed(request, Some(estimate(0.0))), &known()).unwrap();
        assert_eq!(state.mode, request.unwrap_or(Operational));
    }
}

#[test]
fn the_search_turns_about_x_y_and_z_until_the_sun_is_back() {
    let mut state = ModeState::default();
    let mut at = |time_s: f64, estimate, sun_body| {
        let sensed = Sensed { time_s, request: None, is_of_timeline: false, estimate, sun_body };
        let steering = state.sample(&settings(), &sensed, &known()).unwrap();
        assert_eq!(state.mode, EarthAcquisition);
        (steering, state.search_since_s)
    };
    let about = |axis: Vector3<f64>| Steering::RateOnly(axis * 2e-3);
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    for (time_s, axis) in
        [(100.1, x), (699.1, x), (700.1, y), (1299.1, y), (1300.1, z), (1900.1, x), (2500.1, y), (4900.1, z)]
    {
        assert_eq!(at(time_s, None, None), (about(axis), Some(100.1)), "{time_s}");
    }
    // The sensors see it again.
    let (steering, since_s) = at(4901.1, None, Some(-x));
    assert!(matches!(steering, Steering::ErrorQuaternion { .. }) && since_s.is_none());
    // A new search begins with X. A sensor that is valid without a direction is none.
    assert_eq!(at(5000.1, None, Some(Vector3::zeros())), (about(x), Some(5000.1)));
    assert_eq!(at(5000.1 + 601.0, None, None), (about(y), Some(5000.1)));
    // Star trackers are back: the Sun of the ephemeris, here 0.4 rad from -Y toward... the sign of its azimuth.
    let (steering, since_s) = at(5700.1, Some(estimate(0.4)), None);
    let Steering::ErrorQuaternion { error, rate_body_rad_s } = steering else { panic!("{steering:?}") };
    assert_eq!(since_s, None);
    assert_eq!(rate_body_rad_s, Vector3::new(0.0, -1e-3, 0.0));
    let sun = error.body_from_inertial(&-y);
    let expected = estimate(0.4).inertial_from_body().inverse() * x;
    assert!((sun - expected).norm() < 1e-14 && (angle_between_rad(&sun, &-y) - 0.4).abs() < 1e-14);
}

/// A(q) of Wertz (eq 12-13a), typed from the quaternion's components: from the commanded to the actual frame.
fn attitude_matrix(q: [f64; 4]) -> nalgebra::Matrix3<f64> {
    let [q1, q2, q3, q4] = q;
    nalgebra::Matrix3::new(
        q1 * q1 - q2 * q2 - q3 * q3 + q4 * q4,
        2.0 * (q1 * q2 + q3 * q4),
        2.0 * (q1 * q3 - q2 * q4),
        2.0 * (q1 * q2 - q3 * q4),
        -q1 * q1 + q2 * q2 - q3 * q3 + q4 * q4,
        2.0 * (q2 * q3 + q1 * q4),
        2.0 * (q1 * q3 + q2 * q4),
        2.0 * (q2 * q3 - q1 * q4),
        -q1 * q1 - q2 * q2 + q3 * q3 + q4 * q4,
    )
}

#[test]
fn the_error_quaternion_takes_the_boresight_to_the_sensed_sun() {
    let mut random = Random(31);
    let mut worst = 0.0_f64;
    for boresight in cube_directions().map(|axis| axis.normalize()) {
        for k in 0..500 {
            let away_rad = 10_f64.powf(random.within(-12.0, 0.0));
            let across = boresight.cross(&random.direction()).normalize();
            let near = boresight * away_rad.cos() + across * away_rad.sin();
            let sun = [random.direction(), near, -near, boresight, -boresight][k % 5];
            let q = error_quaternion(&boresight, &sun).unwrap().0;
            worst = worst.max((attitude_matrix(q) * boresight - sun).norm());
            assert!((q.iter().map(|c| c * c).sum::<f64>() - 1.0).abs() < 1e-14 && q[3] >= 0.0);
            // Eqs 25 and 26 as printed, away from their singular ends.
            let normal = sun.cross(&boresight);
            if normal.norm() > 1e-3 {
                let half_rad = sun.dot(&boresight).clamp(-1.0, 1.0).acos() / 2.0;
                let printed = normal.normalize() * half_rad.sin();
                assert!((Vector3::new(q[0], q[1], q[2]) - printed).norm() < 1e-12);
                assert!((q[3] - half_rad.cos()).abs() < 1e-12);
            }
        }
    }
    assert!(worst < 2e-15, "{worst:e}");
}

#[test]
fn at_the_ends_of_the_error_quaternion_its_axis_is_chosen() {
    let of = |b: Vector3<f64>, s: Vector3<f64>| error_quaternion(&b, &s).unwrap().0;
    assert_eq!(of(Vector3::x(), Vector3::x()), [0.0, 0.0, 0.0, 1.0]);
    assert_eq!(of(-Vector3::y(), Vector3::y()), [0.0, 0.0, 1.0, 0.0]);
    assert_eq!(of(Vector3::z(), -Vector3::z()), [1.0, 0.0, 0.0, 0.0]);
    for boresight in cube_directions().map(|axis| axis.normalize()) {
        let [x, y, z, w] = of(boresight, -boresight);
        let axis = Vector3::new(x, y, z);
        assert!(w < 1e-15 && axis.dot(&boresight).abs() < 1e-15 && (axis.norm() - 1.0).abs() < 1e-15);
        assert!((2.0 * axis.norm().atan2(w) - PI).abs() < 1e-14);
    }
}
