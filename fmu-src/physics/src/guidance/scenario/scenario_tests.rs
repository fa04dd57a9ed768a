//! Every combination of options and every scenario on a Mercury orbit: the rate is the derivative of the attitude, and the
//! boresight is on the aimpoint.

use core::f64::consts::PI;
use std::sync::{LazyLock, OnceLock};

use approx::assert_relative_eq;
use nalgebra::Vector3;

use super::{GuidanceHardware, PointingProgress, PointingSolution, pointing_solution};
use crate::attitude::angle_between_rad;
use crate::bodies::Body;
use crate::enumeration::Enumerated;
use crate::guidance::downlink::default_downlink::DefaultDownlink;
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::geometry::lighting::SubsolarMethod;
use crate::guidance::geometry::lvlh::AzimuthReference;
use crate::guidance::geometry::moving::{fixed, value};
use crate::guidance::pointing::aimpoint::aimpoint_kind;
use crate::guidance::pointing::antenna::tests::quadrants;
use crate::guidance::pointing::antenna::{Antennas, Beam};
use crate::guidance::pointing::boresight::Gimbal;
use crate::guidance::pointing::command::*;
use crate::guidance::pointing::scan::{ScanCompatibility, ScanTime};
use crate::guidance::tests::orbit::{TestOrbit, rate_error};
use crate::spacecraft::Instrument;

/// 1e-7 of the rate, or of this.
pub(crate) const FLOOR_RAD_S: f64 = 1e-5;
pub(crate) const STEP_S: f64 = 0.25;

/// Every item of an enumeration.
pub(crate) fn every<T: Enumerated>() -> impl Iterator<Item = T> + Clone {
    T::ITEMS.iter().map(|item| item.variant)
}

pub(crate) const SCENARIOS: [Scenario; 8] = [
    Scenario::Generic,
    Scenario::PlusZ,
    Scenario::Nadir,
    Scenario::Gimbal,
    Scenario::DoubleTarget,
    Scenario::Downlink,
    Scenario::LimbTerminator,
    Scenario::LimbGeneric,
];

fn scan_at(elapsed_s: f64) -> ScanTime {
    ScanTime { elapsed_s, tolerance_s: 0.0 }
}

pub(crate) fn hardware() -> GuidanceHardware<'static> {
    static TILTED: OnceLock<[Instrument; 1]> = OnceLock::new();
    let instruments = TILTED.get_or_init(|| {
        let boresight_body = Vector3::new(0.03, -0.02, 1.0).normalize();
        [Instrument { name: "tilted".into(), boresight_body, gimbal: None }]
    });
    GuidanceHardware { instruments, gimbal: Some(camera()), ..no_instruments() }
}

/// MESSENGER's antennas, and no instrument.
pub(crate) fn no_instruments() -> GuidanceHardware<'static> {
    static ANTENNAS: LazyLock<(Antennas, DefaultDownlink)> =
        LazyLock::new(|| (quadrants(), DefaultDownlink::new(&quadrants())));
    let (antennas, default_downlink) = &*ANTENNAS;
    GuidanceHardware {
        instruments: &[],
        gimbal: None,
        antennas,
        default_downlink,
        subsolar: SubsolarMethod::default(),
        scans: ScanCompatibility::default(),
    }
}

/// MESSENGER's camera.
pub(crate) fn camera() -> Gimbal {
    Gimbal {
        zero_body: Vector3::z(),
        quarter_body: -Vector3::y(),
        minimum_rad: -50.0 * PI / 180.0,
        maximum_rad: 40.0 * PI / 180.0,
    }
}

pub(crate) fn aimpoint(option: AimpointOption) -> AimpointCommand {
    let far = matches!(option, AimpointOption::EarthCentered | AimpointOption::SunCentered);
    AimpointCommand {
        option: Some(option),
        vector: Vector3::new(1.0, -2.0, 0.5),
        position_m: Vector3::new(1e6, -2e6, 5e5) * if far { 1e4 } else { 1.0 },
        velocity_m_s: Vector3::zeros(),
        right_ascension_rad: 1.1,
        declination_rad: -0.4,
        latitude_rad: 0.3,
        longitude_rad: -2.0,
        height_m: 2e3,
        azimuth_rad: 0.8,
        elevation_rad: -0.6,
        body: Some(Body::Venus),
    }
}

/// All numbers of a command, to be used by whichever option.
pub(crate) fn command(scenario: Scenario) -> PointingCommand {
    PointingCommand {
        scenario: Some(scenario),
        boresight: BoresightCommand {
            option: Some(BoresightOption::Vector),
            vector: Vector3::new(0.1, 0.2, 2.0),
            azimuth_rad: -0.7,
            elevation_rad: 0.3,
            angle_rad: 0.4,
            instrument: 1,
        },
        aimpoint: aimpoint(AimpointOption::LatitudeLongitude),
        second_aimpoint: aimpoint(AimpointOption::Nadir),
        body_roll: BodyRollCommand {
            option: Some(BodyRollOption::Vector),
            vector: Vector3::new(-0.2, -1.0, 0.1),
            azimuth_rad: 1.9,
            elevation_rad: 0.6,
        },
        external_roll: ExternalRollCommand {
            option: Some(ExternalRollOption::Sun),
            vector: Vector3::new(-0.3, 0.5, 2.0),
            right_ascension_rad: 4.0,
            declination_rad: 0.8,
        },
        limb: LimbCommand {
            azimuth_rad: 0.9,
            reference: Some(AzimuthReference::Sun),
            height_m: 2e4,
            height_rate_m_s: 130.0,
        },
        scan: ScanCommand::default(),
    }
}

/// A scan whose axes have their corners at different times, none of them within a second of [`SCAN_TIMES_S`].
fn scan(frame: ScanFrame) -> ScanCommand {
    ScanCommand {
        frame: Some(frame),
        reference: Some(AzimuthReference::Sun),
        rate_rad_s: [1e-3, -4e-4, 7e-4],
        speed_m_s: [300.0, -500.0, 200.0],
        duration_s: [20.0, 33.0, 14.0],
        pause_s: [5.0, 0.0, 9.0],
        segments: [6, 0, 3],
        reverse: [true, true, false],
    }
}

/// All axes in motion; x paused; x turned back and z paused; all in motion again; z at its end; x as well.
const SCAN_TIMES_S: [f64; 6] = [10.0, 22.0, 38.5, 54.0, 117.0, 160.0];

/// Largest ratio of rate error to what is allowed, over an orbit; the boresight is on the aimpoint throughout.
fn worst(command: &PointingCommand, scan_s: Option<f64>, orbit: &TestOrbit) -> f64 {
    let hardware = hardware();
    let at = |started_s: f64, time_s: f64| -> Option<(EphemerisAtTime, PointingSolution)> {
        let elapsed_s = time_s - started_s;
        let progress = PointingProgress {
            scan: scan_s.map(|scan_s| scan_at(scan_s + elapsed_s)),
            limb_elapsed_s: 30.0 + elapsed_s,
            ..PointingProgress::default()
        };
        let ephemeris = orbit.ephemeris(time_s);
        Some((ephemeris, pointing_solution(command, &hardware, &ephemeris, &progress)?))
    };
    let mut worst: f64 = 0.0;
    let mut compared = 0;
    for time_s in orbit.times_s() {
        let (_, solution) = at(time_s, time_s).unwrap();
        let pointing = solution.vectors.pointing().unwrap();
        let boresight =
            pointing.frame().inertial_from_body * value(&solution.vectors.boresight_body).normalize();
        let toward = value(&solution.vectors.aimpoint).normalize();
        assert!(boresight.cross(&toward).norm() < 1e-12 && boresight.dot(&toward) > 0.0);
        // Where the terminator comes onto the disc or leaves it the law takes another form.
        let same_form = [-2.0, 2.0].iter().all(|step| {
            at(time_s, time_s + step * STEP_S).is_some_and(|(_, other)| other.reachable == solution.reachable)
        });
        if same_form {
            let axes = |time_s_: f64| Some(at(time_s, time_s_)?.1.vectors.pointing()?.inertial_from_body);
            worst = worst.max(rate_error(axes, time_s, STEP_S, FLOOR_RAD_S).unwrap());
            compared += 1;
        }
    }
    assert!(compared >= 40);
    worst
}

#[test]
fn the_rate_is_the_derivative_for_every_combination_of_options() {
    let orbit = TestOrbit::new(12.0);
    let mut largest: f64 = 0.0;
    let mut found = 0;
    for boresight in every() {
        for option in every() {
            for body_roll in every() {
                for external_roll in every() {
                    let mut command = command(Scenario::Generic);
                    command.boresight.option = Some(boresight);
                    command.aimpoint = aimpoint(option);
                    command.body_roll.option = Some(body_roll);
                    command.external_roll.option = Some(external_roll);
                    let worst = worst(&command, None, &orbit);
                    assert!(
                        worst < 1e-7,
                        "{worst:e} {boresight:?} {option:?} {body_roll:?} {external_roll:?}"
                    );
                    largest = largest.max(worst);
                    found += 1;
                }
            }
        }
    }
    println!("options: largest {largest:e} of {found}");
    assert_eq!(found, 4 * 18 * 2 * 8);
}

#[test]
fn the_rate_is_the_derivative_for_every_scenario_with_every_scan() {
    for period_h in [12.0, 15.0] {
        let orbit = TestOrbit::new(period_h);
        for scenario in SCENARIOS {
            let mut command = command(scenario);
            let basic = worst(&command, None, &orbit);
            assert!(basic < 1e-7, "{basic:e} {scenario:?}");
            for frame in every() {
                command.scan = scan(frame);
                for scan_s in SCAN_TIMES_S {
                    let worst = worst(&command, Some(scan_s), &orbit);
                    assert!(worst < 1e-7, "{worst:e} {scenario:?} {frame:?} {scan_s}");
                }
            }
        }
    }
}

#[test]
fn the_rate_is_the_derivative_for_every_aimpoint_with_every_scan() {
    let orbit = TestOrbit::new(12.0);
    let mut active = 0;
    for option in every() {
        for frame in every() {
            let mut command = command(Scenario::Generic);
            command.aimpoint = aimpoint(option);
            // An aimpoint that leaves the Sun by metres spans no plane with it.
            command.external_roll.option = Some(ExternalRollOption::Vector);
            command.scan = scan(frame);
            for scan_s in SCAN_TIMES_S {
                let worst = worst(&command, Some(scan_s), &orbit);
                assert!(worst < 1e-7, "{worst:e} {option:?} {frame:?} {scan_s}");
            }
            let progress = PointingProgress { scan: Some(scan_at(10.0)), ..PointingProgress::default() };
            let solution =
                pointing_solution(&command, &hardware(), &orbit.ephemeris(11.0), &progress).unwrap();
            assert_eq!(solution.scan_active, hardware().scans.allows(frame, aimpoint_kind(option)));
            active += usize::from(solution.scan_active);
        }
    }
    // Body and inertial rotations with 18, translations with 11 and 6, local rotations with 10.
    assert_eq!(active, 18 + 18 + 11 + 6 + 10);
}

fn at(
    command: &PointingCommand,
    time_s: f64,
    progress: &PointingProgress,
) -> (EphemerisAtTime, Option<PointingSolution>) {
    let ephemeris = TestOrbit::new(12.0).ephemeris(time_s);
    let solution = pointing_solution(command, &hardware(), &ephemeris, progress);
    (ephemeris, solution)
}

#[test]
fn scenarios_set_the_vectors_of_table_5() {
    let still = PointingProgress::default();
    for scenario in SCENARIOS {
        let mut command = command(scenario);
        if scenario == Scenario::Downlink {
            command.boresight.option = Some(BoresightOption::PhasedArray);
        }
        let (s, solution) = at(&command, 3000.0, &still);
        let solution = solution.unwrap();
        if scenario == Scenario::Generic {
            continue;
        }
        assert_eq!(solution.vectors.body_roll, fixed(-Vector3::y()), "{scenario:?}");
        assert_eq!(solution.vectors.external_roll, s.to_sun());
        let boresight = value(&solution.vectors.boresight_body);
        match scenario {
            Scenario::Gimbal => assert_eq!(boresight, camera().boresight(0.4)),
            Scenario::Downlink => {
                assert_relative_eq!(boresight, Vector3::new((-0.7_f64).sin(), -(0.7_f64.cos()), 0.0));
            }
            _ => assert_eq!(boresight, hardware().instruments[0].boresight_body, "{scenario:?}"),
        }
        let toward = value(&solution.vectors.aimpoint);
        match scenario {
            Scenario::Nadir => assert_eq!(toward, -value(&s.position)),
            Scenario::Downlink => assert_eq!(toward, value(&s.to_earth())),
            _ => assert!((toward + value(&s.position)).norm() < 2.5e6, "{scenario:?}: about the planet"),
        }
    }
}

#[test]
fn a_body_scan_keeps_the_moved_boresight_on_the_aim() {
    let mut command = command(Scenario::Nadir);
    command.scan = ScanCommand { duration_s: [100.0; 3], ..scan(ScanFrame::Body) };
    for elapsed_s in [1.0, 40.0, 99.0] {
        let progress = PointingProgress { scan: Some(scan_at(elapsed_s)), ..PointingProgress::default() };
        let (s, solution) = at(&command, 3000.0, &progress);
        let pointing = solution.unwrap().vectors.pointing().unwrap();
        let nadir_body = value(&pointing.to_body(&s.to_planet())).normalize();
        // The instrument turned about X, then Y, then Z by rotation vectors.
        let turn = |axis: Vector3<f64>, rate: f64| nalgebra::Rotation3::new(axis * (rate * elapsed_s));
        let expected = turn(Vector3::z(), 7e-4)
            * turn(Vector3::y(), -4e-4)
            * turn(Vector3::x(), 1e-3)
            * hardware().instruments[0].boresight_body;
        assert!(nadir_body.cross(&expected).norm() < 1e-12 && nadir_body.dot(&expected) > 0.0);
    }
}

#[test]
fn an_incompatible_scan_and_one_with_downlink_leave_the_basic_pointing() {
    let scanning = PointingProgress { scan: Some(scan_at(10.0)), ..PointingProgress::default() };
    let mut star = command(Scenario::PlusZ);
    star.aimpoint = aimpoint(AimpointOption::Vector);
    star.scan = scan(ScanFrame::InertialTranslation);
    let mut downlink = command(Scenario::Downlink);
    downlink.scan = scan(ScanFrame::Body);
    for command in [star, downlink] {
        let (_, scanned) = at(&command, 500.0, &scanning);
        let (_, basic) = at(&command, 500.0, &PointingProgress::default());
        assert_eq!(scanned, basic);
        assert!(!scanned.unwrap().scan_active);
    }
}

#[test]
fn the_camera_comes_nearest_to_the_second_aimpoint() {
    let mut in_range = 0;
    let orbit = TestOrbit::new(12.0);
    for (step, option) in (0..45).zip(every().cycle()) {
        let mut command = command(Scenario::DoubleTarget);
        command.second_aimpoint = aimpoint(option);
        let s = orbit.ephemeris(f64::from(step) * 900.0);
        let solution = pointing_solution(&command, &hardware(), &s, &PointingProgress::default()).unwrap();
        let pointing = solution.vectors.pointing().unwrap();
        let angle = solution.gimbal_angle(&pointing, hardware().gimbal.as_ref()).unwrap();
        in_range += u32::from(angle.in_range);
        let to_inertial = pointing.frame().inertial_from_body;
        let mut only_second = PointingCommand { aimpoint: command.second_aimpoint, ..command };
        only_second.scenario = Some(Scenario::PlusZ);
        let second = pointing_solution(&only_second, &hardware(), &s, &PointingProgress::default()).unwrap();
        let second = value(&second.vectors.aimpoint);
        let off_rad =
            |angle_rad: f64| angle_between_rad(&(to_inertial * camera().boresight(angle_rad)), &second);
        let range = camera();
        let best = (0..=2000)
            .map(|k| range.minimum_rad + (range.maximum_rad - range.minimum_rad) * f64::from(k) / 2000.0)
            .map(off_rad)
            .fold(f64::INFINITY, f64::min);
        assert!(off_rad(angle.angle_rad) <= best + 1e-12, "{option:?}");
    }
    assert!(in_range > 5 && in_range < 45, "{in_range}");
}

#[test]
fn devices_stop_at_their_range_and_say_so() {
    let still = PointingProgress::default();
    let mut camera = command(Scenario::Gimbal);
    camera.boresight.angle_rad = 1.2;
    let (_, solution) = at(&camera, 3000.0, &still);
    let angle = solution.unwrap().gimbal.unwrap();
    assert!(!angle.in_range && (angle.angle_rad - 40.0 * PI / 180.0).abs() < 1e-15);
    let mut antenna = command(Scenario::Generic);
    antenna.boresight.option = Some(BoresightOption::PhasedArray);
    antenna.boresight.azimuth_rad = 0.2;
    let solution = at(&antenna, 3000.0, &still).1.unwrap();
    let Some(Beam::Commanded(antenna)) = solution.antenna else { panic!("{:?}", solution.antenna) };
    assert_eq!(antenna.azimuth_rad, 0.0);
    assert!(!antenna.is_in_range() && solution.gimbal.is_none());
}

#[test]
fn a_terminator_off_the_disc_aims_at_the_centre_and_says_so() {
    let orbit = TestOrbit::new(12.0);
    let (mut there, mut gone) = (0, 0);
    for step in 0..200 {
        let s = orbit.ephemeris(f64::from(step) * 216.0);
        let command = command(Scenario::LimbTerminator);
        let solution = pointing_solution(&command, &hardware(), &s, &PointingProgress::default()).unwrap();
        if solution.reachable {
            there += 1;
        } else {
            gone += 1;
            assert_eq!(value(&solution.vectors.aimpoint), -value(&s.position));
        }
    }
    assert!(there > 0 && gone > 0, "{there} {gone}");
}

#[test]
fn zeros_and_unknown_rows_are_no_command() {
    let still = PointingProgress::default();
    let (s, none) = at(&PointingCommand::default(), 0.0, &still);
    assert!(none.is_none());
    for scenario in SCENARIOS {
        let zeros = PointingCommand { scenario: Some(scenario), ..PointingCommand::default() };
        let solution = pointing_solution(&zeros, &hardware(), &s, &still);
        let alone = matches!(
            scenario,
            Scenario::Nadir | Scenario::Downlink | Scenario::LimbTerminator | Scenario::LimbGeneric
        );
        assert_eq!(solution.is_some(), alone, "{scenario:?}");
        assert!(solution.is_none_or(|solution| solution.vectors.pointing().is_some()));
    }
    let mut unknown = command(Scenario::Nadir);
    unknown.boresight.instrument = 2;
    assert!(at(&unknown, 0.0, &still).1.is_none());
    let mut zero = command(Scenario::Generic);
    zero.boresight.vector = Vector3::zeros();
    assert!(at(&zero, 0.0, &still).1.is_none());
}
