//! Half days at one sample a second: flags change with the geometry, commands move steadily, turns stay in the zone.

use nalgebra::Vector3;

use super::body_positions::BodyPositions;
use super::command_status::CommandStatus;
use super::sample_inputs::{GuidanceSettings, SampleInputs};
use super::system::GuidanceState;
use crate::attitude::{Attitude, SunAngles};
use crate::constants::DEG_RAD;
use crate::guidance::constraints::constrained::Constraints;
use crate::guidance::constraints::hot_pole::HotPole;
use crate::guidance::constraints::keep_in::KeepIn;
use crate::guidance::downlink::sun_direction::DownlinkSunDirection;
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::geometry::limb::terminator_limb;
use crate::guidance::geometry::moving::{Moving, value};
use crate::guidance::orbit_phase::schedule::Schedule;
use crate::guidance::pointing::command::{PointingCommand, Scenario};
use crate::guidance::scenario::scenario_tests::{SCENARIOS, command, hardware};
use crate::guidance::tests::burn::{guidance_settings, sample_inputs, settings, still_inputs};
use crate::guidance::tests::geometry::{Random, nearest_zone};
use crate::guidance::tests::orbit::{TestOrbit, guided};
use crate::guidance::{Guided, OrbitPhaseLaw, ScienceRule, Sight};
use crate::tests::short_or_long;

const HALF_DAY_S: u32 = 43_200;

fn zone() -> KeepIn {
    nearest_zone(15.0 * DEG_RAD, 13.0 * DEG_RAD)
}

/// A downlink after every periapsis of an orbit of twelve hours, begun at it.
fn law(science: ScienceRule, slew_rate_rad_s: f64) -> Guided {
    Guided {
        elevation_limit_rad: zone().elevation_rad,
        slew_rate_rad_s,
        ..guided(science, f64::INFINITY, [2.0 * 3600.0, 10.0 * 3600.0], 1)
    }
}

fn flight_settings(orbit_phase: Guided) -> GuidanceSettings<'static> {
    // Wide enough for every pass over the day side.
    let hot_pole = HotPole { altitude_m: 1e7, angle_rad: 80.0 * DEG_RAD, cone_rad: 90.0 * DEG_RAD };
    let mut all = guidance_settings(settings(Vector3::x()));
    all.hardware = hardware();
    all.keep_in = zone();
    all.modes.operational = Constraints { keep_in: Some(zone()), hot_pole: Some(hot_pole) };
    all.modes.safe_hold = all.modes.operational;
    all.orbit_phase = orbit_phase;
    all
}

/// What says something of the geometry.
fn flags(judged: &CommandStatus) -> [bool; 7] {
    [
        judged.sun_keep_in,
        judged.hot_pole,
        judged.hot_pole_reached,
        judged.clamped,
        judged.reachable,
        judged.degenerate,
        judged.link_available,
    ]
}

/// A flight under one command: flags at each second, and each second before which the command is not where its rate led.
struct Simulated {
    flags: Vec<[bool; 7]>,
    jumps: Vec<(u32, f64)>,
}

fn simulated(
    all: &GuidanceSettings<'_>,
    command: PointingCommand,
    positions: &[EphemerisAtTime],
) -> Simulated {
    let mut guidance = GuidanceState::new(Attitude::default(), 0.0);
    let mut simulated = Simulated { flags: Vec::with_capacity(positions.len()), jumps: Vec::new() };
    for (second, ephemeris) in (0_u32..).zip(positions) {
        let time_s = f64::from(second);
        let led_to = guidance.command.attitude_at(time_s);
        let rate_before = guidance.command.rate_body_rad_s;
        let inputs = SampleInputs {
            command,
            positions: BodyPositions::in_every_mode(Some(*ephemeris)),
            ..sample_inputs(led_to, Vector3::zeros())
        };
        guidance.sample(all, &inputs, |_| None);
        simulated.flags.push(flags(&guidance.status));
        let now = guidance.command;
        let jump_rad = led_to.rotation_vector_to(&now.attitude_at(time_s)).norm();
        // What both rates explain, also where the rate changes much between two samples, is no jump.
        let steady_rad = now.rate_body_rad_s.norm() + rate_before.norm() + 1e-4;
        if second > 0 && jump_rad > steady_rad {
            simulated.jumps.push((second, jump_rad));
        }
    }
    simulated
}

/// How often a flag changes, seen every `every` samples.
fn changes(simulated: &Simulated, flag: usize, every: usize) -> usize {
    let seen: Vec<bool> = simulated.flags.iter().step_by(every).map(|flags| flags[flag]).collect();
    seen.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// Seconds at which a flag changes.
fn changed_at(simulated: &Simulated, flag: usize, second: u32) -> bool {
    let at = second as usize;
    simulated.flags[at][flag] != simulated.flags[at - 1][flag]
}

#[test]
fn no_flag_flickers_and_no_command_jumps_over_half_a_day_of_every_scenario() {
    let orbit = TestOrbit::new(12.0);
    let mut greatest = [0; 7];
    let mut unexplained = Vec::new();
    for day in &[0.0, 40.0][..short_or_long(1, 2)] {
        let positions: Vec<EphemerisAtTime> =
            (0..HALF_DAY_S).map(|second| orbit.ephemeris(day * 86_400.0 + f64::from(second))).collect();
        let orbit_phases = [
            (ScienceRule::Scaled { gain: 0.25 }, 0.0),
            (ScienceRule::Nadir, 0.0),
            (ScienceRule::Nadir, 3e-3),
            (ScienceRule::Scaled { gain: 1.0 }, 2e-3),
        ];
        let commands = SCENARIOS
            .map(|scenario| (command(scenario), law(ScienceRule::Nadir, 0.0)))
            .into_iter()
            .chain(orbit_phases.map(|(science, slew_rate_rad_s)| {
                let command =
                    PointingCommand { scenario: Some(Scenario::OrbitPhase), ..PointingCommand::default() };
                (command, law(science, slew_rate_rad_s))
            }));
        for (command, orbit_phase) in commands {
            let simulated = simulated(&flight_settings(orbit_phase), command, &positions);
            for (flag, most) in greatest.iter_mut().enumerate() {
                let count = changes(&simulated, flag, 1);
                *most = count.max(*most);
                // What the geometry does lasts longer than twenty seconds.
                assert_eq!(count, changes(&simulated, flag, 20), "{:?} flag {flag}", command.scenario);
            }
            for (second, jump_rad) in &simulated.jumps {
                // The edge of the hot pole's region, and of a window where turns take no time.
                let at_region = changed_at(&simulated, 1, *second);
                let at_window = command.scenario == Some(Scenario::OrbitPhase)
                    && orbit_phase.slew_rate_rad_s == 0.0
                    && [7_200, 36_000].iter().any(|edge| second.abs_diff(*edge) <= 1);
                // The limb and the terminator meet or part.
                let has_limb = |at: u32| {
                    let height = Moving::from_re(command.limb.height_m);
                    terminator_limb(&positions[at as usize], height).map(|limb| limb.exists)
                };
                let at_limb = command.scenario == Some(Scenario::LimbTerminator)
                    && has_limb(*second) != has_limb(second - 1);
                if !(at_region || at_window || at_limb) {
                    unexplained.push((day, command.scenario, orbit_phase.science, *second, *jump_rad));
                }
            }
        }
    }
    assert!(unexplained.is_empty(), "{} {:?}", unexplained.len(), &unexplained[..unexplained.len().min(30)]);
    // The keep-in zone, the hot pole and reach come and go.
    assert!(greatest[0] >= 2 && greatest[1] >= 2 && greatest[4] >= 2, "{greatest:?}");
}

#[test]
fn random_flights_with_slews_stay_in_the_zone() {
    let orbit = TestOrbit::new(12.0);
    let mut random = Random(51);
    let (mut worst_rad, mut slewing, mut without_zone_rad) = (0.0_f64, 0, 0.0_f64);
    for flight in 0..24 {
        let zone = KeepIn {
            azimuth_rad: random.within(2.0, 25.0) * DEG_RAD,
            elevation_rad: random.within(2.0, 25.0) * DEG_RAD,
            ..zone()
        };
        let gain = random.within(0.0, 1.0);
        let science = random.one_of(&[ScienceRule::Nadir, ScienceRule::Scaled { gain }]);
        let start_s = random.within(0.0, 80.0 * 86_400.0);
        let mut place = || {
            let share = random.one_of(&[-1.0, 1.0, 0.4]);
            DownlinkSunDirection {
                angles: SunAngles {
                    azimuth_rad: zone.azimuth_rad * share,
                    elevation_rad: zone.elevation_rad * random.within(-0.3, 0.3),
                },
                earth_ahead: random.within(0.0, 1.0) < 0.5,
            }
        };
        let sun_direction = (flight % 3 > 0).then(&mut place);
        let begin_s = orbit.ephemeris(start_s).epoch_s + random.within(0.0, 9.0 * 3600.0);
        let length_s = random.within(3_000.0, 9_000.0);
        let base = law(science, random.within(5e-4, 1e-2));
        let schedule = Schedule {
            periapsis_s: begin_s,
            downlink_start_s: 0.0,
            downlink_end_s: length_s,
            once: true,
            throughout: false,
            ..base.schedule
        };
        let law = Guided {
            schedule,
            elevation_limit_rad: zone.elevation_rad,
            keep_in: Some(zone),
            sun_direction,
            ..base
        };
        let eigenaxis = Guided { keep_in: None, ..law };
        let by = |guided| OrbitPhaseLaw { guided, default_downlink: hardware().default_downlink };
        let offset_s = start_s - orbit.ephemeris(start_s).epoch_s;
        let lines = |epoch_s: f64| orbit.ephemeris(epoch_s + offset_s);
        for edge_s in [begin_s, begin_s + length_s] {
            for step in 0..3_000 {
                let at_s = edge_s + 0.5 * f64::from(step);
                let found = by(law).at(at_s, lines);
                if !found.slewing {
                    break;
                }
                slewing += 1;
                let sun = lines(at_s).lines().sun.direction;
                let excess = |attitude: &crate::attitude::MovingFrame| {
                    zone.excess_rad(&(attitude.inertial_from_body.inverse() * sun)).unwrap()
                };
                worst_rad = worst_rad.max(excess(&found.frame));
                without_zone_rad = without_zone_rad.max(excess(&by(eigenaxis).at(at_s, lines).frame));
                assert!(
                    excess(&found.frame) < 1e-9,
                    "{flight}: {:e} at {at_s} s, {law:?}",
                    excess(&found.frame)
                );
            }
        }
    }
    assert!(slewing > 5_000, "{slewing}");
    // About one axis the same turns leave the zone by degrees.
    assert!(worst_rad < 1e-11 && without_zone_rad > 1.0 * DEG_RAD, "{worst_rad:e} {without_zone_rad}");
}

#[test]
fn a_downlink_of_the_orbit_phase_reaches_the_earth_beyond_a_right_angle_from_the_sun() {
    let orbit = TestOrbit::new(12.0);
    let all = flight_settings(law(ScienceRule::Nadir, 0.0));
    let (mut near, mut far) = (0, 0);
    for day in 0..88 {
        let ephemeris = orbit.ephemeris(f64::from(day) * 86_400.0 + 5.0 * 3600.0);
        let command = PointingCommand { scenario: Some(Scenario::OrbitPhase), ..PointingCommand::default() };
        let inputs = SampleInputs {
            command,
            positions: BodyPositions::in_every_mode(Some(ephemeris)),
            ..still_inputs()
        };
        let mut guidance = GuidanceState::new(Attitude::default(), 0.0);
        guidance.sample(&all, &inputs, |_| None);
        let earth = guidance.command.attitude_at(0.0).to_body(&value(&ephemeris.to_earth()).normalize());
        assert!(earth.z.abs() < 1e-9);
        assert!(guidance.status.reachable, "{day}");
        let is_near = value(&ephemeris.to_sun()).dot(&value(&ephemeris.to_earth())) > 0.0;
        if is_near { near += 1 } else { far += 1 }
    }
    assert!(near > 10 && far > 10, "{near} {far}");
}

#[test]
fn a_scan_that_changes_begins_anew() {
    let orbit = TestOrbit::new(12.0);
    let all = flight_settings(law(ScienceRule::Nadir, 0.0));
    let scan = crate::guidance::pointing::command::ScanCommand {
        frame: Some(crate::guidance::pointing::command::ScanFrame::Body),
        rate_rad_s: [1e-3, 0.0, 0.0],
        duration_s: [60.0; 3],
        reverse: [true; 3],
        ..crate::guidance::pointing::command::ScanCommand::default()
    };
    let nadir = PointingCommand { scan, ..command(Scenario::Nadir) };
    let mut faster = nadir;
    faster.scan.rate_rad_s[0] = 2e-3;
    let sample = |guidance: &mut GuidanceState, second: u32, command: PointingCommand| {
        let ephemeris = orbit.ephemeris(20_000.0 + f64::from(second));
        let positions = BodyPositions::in_every_mode(Some(ephemeris));
        let inputs = SampleInputs { command, positions, ..still_inputs() };
        guidance.sample(&all, &inputs, |_| None);
        guidance.command.attitude_at(f64::from(second))
    };
    let mut changed = GuidanceState::new(Attitude::default(), 0.0);
    for second in 0..37 {
        sample(&mut changed, second, nadir);
    }
    let mut begun = GuidanceState::new(Attitude::default(), 37.0);
    for second in 37..120 {
        let [was_changed, is_new] = [&mut changed, &mut begun].map(|it| sample(it, second, faster));
        assert!(was_changed.rotation_vector_to(&is_new).norm() < 1e-12, "{second}");
    }
}
