//! A plan as a timeline: the same flight as by inputs, to the same bits however it is cut; alternation cancels torque across the Sun.

use models::MomentumPlant;
use nalgebra::Vector3;
use physics::constants::ASTRONOMICAL_UNIT_M;
use physics::spacecraft::MESSENGER_TOML;

use super::named_model::{NamedInstance, NamedModel, assert_cuts_change_nothing};

const HOUR_S: f64 = 3600.0;
const DAY_S: f64 = 86_400.0;

/// About the Sun at this distance, in downlink throughout; no dump comes by itself.
fn cruise(distance_au: f64) -> Vec<(&'static str, f64)> {
    vec![
        ("orbit.center", 2.0),
        ("orbit.frame", 4.0),
        ("orbit.semiMajorAxis", distance_au * ASTRONOMICAL_UNIT_M),
        ("orbit.eccentricity", 0.0),
        ("dump.threshold[1]", 1e3),
        ("dump.threshold[2]", 1e3),
        ("dump.threshold[3]", 1e3),
        // Off the place at which the panels balance the body.
        ("spacecraft.centerOfMass[1]", 0.01),
        ("spacecraft.centerOfMass[3]", 0.02),
    ]
}

fn by_timeline() -> [(&'static str, f64); 2] {
    [("panel[1].control", 4.0), ("panel[2].control", 4.0)]
}

fn planned(timeline: &str) -> NamedModel<MomentumPlant> {
    NamedModel::<MomentumPlant>::with("messenger.toml", MESSENGER_TOML)
        .with_schedule("timeline.toml", timeline)
}

/// Row of a plan from a time on: offset and windmill of the panels, azimuth and elevation of the Sun, in deg, the alternate attitude.
struct Window(f64, [f64; 2], [f64; 2], bool);

const PLAN: [Window; 6] = [
    Window(0.0, [55.0, 0.0], [0.0, 0.0], false),
    Window(0.7 * DAY_S, [55.0, 2.0], [3.0, 0.0], false),
    Window(1.35 * DAY_S, [40.0, -3.0], [3.0, -4.0], true),
    Window(1.9 * DAY_S, [-40.0, 0.0], [0.0, 2.0], false),
    Window(2.5 * DAY_S, [60.0, 1.0], [-5.0, 5.0], true),
    Window(3.125 * DAY_S, [60.0, 1.0], [-5.0, 5.0], false),
];

fn plan() -> String {
    let windows = PLAN.iter().map(|Window(at_s, [offset, windmill], [azimuth, elevation], alternate)| {
        format!(
            "[[command]]\nat = {at_s:?}\nscenario = \"downlink\"\nalternate = {alternate}\n\
             sun = {{ azimuth = \"{azimuth} deg\", elevation = \"{elevation} deg\" }}\n\
             [[panels]]\nat = {at_s:?}\nsunOffset = \"{offset} deg\"\nwindmill = \"{windmill} deg\"\n"
        )
    });
    windows.collect()
}

#[test]
fn a_plan_as_timeline_is_the_plan_by_inputs() {
    let events = "[[event]]\nat = \"30 h\"\nmaneuver = { deltaV = [0.5, -1, 0.2] }\n\
                  [[event]]\nat = \"50 h\"\ndump = [0.1, 0.2, -0.3]\n";
    let (planned, commanded) = (planned(&(plan() + events)), NamedModel::<MomentumPlant>::shipped());
    let mut timeline = planned.initialize(0.0, &[&cruise(0.4)[..], &by_timeline()].concat()).unwrap();
    let by_command = [("panel[1].control", 3.0), ("panel[2].control", 3.0)];
    let mut inputs = commanded.initialize(0.0, &[&cruise(0.4)[..], &by_command].concat()).unwrap();
    let mut edges: Vec<(f64, Option<&Window>)> = PLAN.iter().map(|it| (it.0, Some(it))).collect();
    edges.extend([30.0, 50.0, 96.0].map(|it| (it * HOUR_S, None)));
    edges.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut largest = 0.0_f64;
    for (at_s, window) in edges {
        if at_s > 0.0 {
            inputs.step_to(at_s).unwrap();
            timeline.step_to(at_s).unwrap();
        }
        let [a, b] = [&timeline, &inputs].map(|it| it.vector("momentum.inertial"));
        // The dump of the timeline at this time is over, that by input not yet begun.
        if at_s != 30.0 * HOUR_S && at_s != 50.0 * HOUR_S {
            assert!((a - b).norm() <= 1e-9 * a.norm(), "{at_s}: {a} {b}");
        }
        largest = largest.max(a.norm());
        inputs.set("maneuver.request", 0.0);
        inputs.set("dump.request", 0.0);
        if at_s == 30.0 * HOUR_S {
            inputs.set_elements("maneuver.deltaV", &[0.5, -1.0, 0.2]);
            inputs.set("maneuver.request", 1.0);
        }
        if at_s == 50.0 * HOUR_S {
            inputs.set_elements("dump.target", &[0.1, 0.2, -0.3]);
            inputs.set("dump.request", 1.0);
        }
        let Some(Window(_, [offset, windmill], [azimuth, elevation], alternate)) = window else { continue };
        // Panel 1 stands on +X.
        inputs.set("panel[1].sunOffsetCommand", (offset + windmill).to_radians());
        inputs.set("panel[2].sunOffsetCommand", (offset - windmill).to_radians());
        inputs.set("downlink.sunAzimuth", azimuth.to_radians());
        inputs.set("downlink.sunElevation", elevation.to_radians());
        inputs.set("downlink.alternate", f64::from(u8::from(*alternate)));
    }
    assert!(largest > 1.0, "{largest}");
    for flight in [&timeline, &inputs] {
        assert_eq!((flight.integer("maneuver.count"), flight.integer("dump.count")), (1, 2));
        assert!(flight.boolean("downlink.active"));
    }
    assert_eq!(timeline.boolean("downlink.clamped"), inputs.boolean("downlink.clamped"));
    assert_eq!(timeline.integer("timeline.command"), 6);
}

#[test]
fn steps_of_any_length_simulate_a_timeline_to_the_same_bits() {
    let rest = "[[command]]\nat = \"85 h\"\nuntil = \"90 h\"\nscenario = \"generic\"\n\
                boresight = { option = \"vector\", vector = [0, -1, 0] }\naimpoint = { option = \"sun\" }\n\
                bodyRoll = { option = \"vector\", vector = [0, 0, 1] }\nexternalRoll = { option = \"earth\" }\n\
                [command.scan]\nframe = \"body\"\nrate = [\"0.01 deg/s\", 0, 0]\nduration = [700, 0, 0]\n\
                pause = [100, 0, 0]\nsegments = [0, 0, 0]\nreverse = [true, false, false]\n\
                [[event]]\nat = 100000.25\nmaneuver = { deltaV = [3, 0, 0] }\n[[event]]\nat = \"88 h\"\ndump = true\n";
    let named = planned(&(plan() + rest));
    for orbit in [&[("orbit.dynamics", 2.0), ("spacecraft.centerOfMassShift[3]", 0.01)][..], &[]] {
        let sets = [&cruise(0.35)[..], &by_timeline(), orbit].concat();
        let initialize = || named.initialize(0.0, &sets).unwrap();
        assert_cuts_change_nothing(initialize, [2.0 * DAY_S, 4.0 * DAY_S], &[600.0, 12_345.0, DAY_S], |_| {});
    }
}

/// Momentum across the Sun line in the middle of the flight, over what one attitude alone leaves there.
fn left_across(named: &NamedModel<MomentumPlant>, sets: &[(&str, f64)], until_s: f64) -> f64 {
    let across = |flight: &NamedInstance<'_, MomentumPlant>, sun: &Vector3<f64>| {
        let momentum = flight.vector("momentum.inertial");
        (momentum - sun * sun.dot(&momentum)).norm()
    };
    let [alternated, alone] = [1.0, 0.0].map(|enabled| {
        let mut flight = named.initialize(0.0, &[sets, &[("timeline.enabled", enabled)]].concat()).unwrap();
        flight.step_to(0.5 * until_s).unwrap();
        let sun = -flight.vector("position").normalize();
        flight.step_to(until_s).unwrap();
        across(&flight, &sun)
    });
    assert!(alone > 0.1, "{alone}");
    alternated / alone
}

#[test]
fn alternation_cancels_torque_across_the_sun_line() {
    let halves = |alternates: &[bool]| -> String {
        let each = alternates.iter().enumerate().map(|(k, alternate)| {
            format!("[[command]]\nat = \"{} h\"\nscenario = \"downlink\"\nalternate = {alternate}\n", 6 * k)
        });
        each.collect()
    };
    let (one, two) = (planned(&halves(&[false, true])), planned(&halves(&[false, true, true, false])));
    let held = [
        ("orbit.center", 2.0),
        ("orbit.source", 3.0),
        ("orbit.position[1]", 0.4 * ASTRONOMICAL_UNIT_M),
        ("ephemeris.source", 3.0),
        ("earth.position[1]", -0.3 * ASTRONOMICAL_UNIT_M),
        ("earth.position[2]", 0.9 * ASTRONOMICAL_UNIT_M),
    ];
    let quiet = &cruise(0.4)[4..];
    let fixed = left_across(&one, &[&held, quiet].concat(), 12.0 * HOUR_S);
    assert!(fixed < 1e-6, "{fixed:e}");
    let [one, two] =
        [(&one, 12.0), (&two, 24.0)].map(|(named, hours)| left_across(named, &cruise(0.4), hours * HOUR_S));
    println!("left across the Sun line: fixed {fixed:e}, +- {one:e}, +--+ {two:e}");
    assert!(one < 1e-2 && two < 2e-3, "{one:e} {two:e}");
}

#[test]
fn the_sun_stands_where_the_downlink_has_it_and_what_cannot_be_is_flagged() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut flight = named.initialize(0.0, &cruise(0.4)).unwrap();
    assert_eq!(flight.integer("guided.phase"), 2);
    let mut time_s = 0.0;
    let mut clamped = 0;
    for (azimuth, elevation, alternate) in
        [(0.0, 0.0, 0.0), (0.05, -0.1, 0.0), (-0.1, 0.05, 1.0), (0.0, 0.2, 0.0), (0.0, 1.5, 1.0)]
    {
        flight.set("downlink.sunAzimuth", azimuth);
        flight.set("downlink.sunElevation", elevation);
        flight.set("downlink.alternate", alternate);
        time_s += HOUR_S;
        flight.step_to(time_s).unwrap();
        let found = ["sun.azimuth", "sun.elevation"].map(|name| flight.real(name));
        let apart = (found[0] - azimuth).hypot(found[1] - elevation);
        let flagged = flight.boolean("downlink.clamped");
        clamped += i32::from(flagged);
        assert_eq!(apart > 1e-9, flagged, "{azimuth} {elevation}: {found:?}");
    }
    assert!(clamped > 0);
    // About the Sun with windows there is science between them.
    let mut windows = named
        .initialize(
            0.0,
            &[&cruise(0.4)[..], &[("guided.phase", 1.0), ("guided.downlinkReference", 2.0)]].concat(),
        )
        .unwrap();
    windows.step_to(60.0).unwrap();
    assert!(!windows.boolean("downlink.active"));
    assert_eq!(named.initialize(0.0, &[]).unwrap().integer("guided.phase"), 1);
}

#[test]
fn a_place_outside_the_keep_in_zone_is_its_boundary_however_it_is_requested() {
    let timeline = "[[command]]\nat = 0\nscenario = \"downlink\"\nsun = { azimuth = \"3 deg\", elevation = \"20 deg\" }\n";
    let (planned, plain) = (planned(timeline), NamedModel::<MomentumPlant>::shipped());
    let input = [("downlink.sunAzimuth", 3_f64.to_radians()), ("downlink.sunElevation", 20_f64.to_radians())];
    for (zone, expected_deg) in [
        (&[][..], 13.0),
        (&[("keepIn.elevation", 0.1)], 0.1_f64.to_degrees()),
        (&[("keepIn.enabled", 0.0)], 20.0),
        // Beyond its distance it does not count.
        (&[("keepIn.distance", 0.3 * ASTRONOMICAL_UNIT_M)], 20.0),
    ] {
        // The Earth is far enough from the Sun line.
        let place = [&cruise(0.4)[..], &[("orbit.trueAnomaly", 2.0)]].concat();
        let mut by_timeline = planned.initialize(0.0, &[&place[..], zone].concat()).unwrap();
        let mut by_input = plain.initialize(0.0, &[&place[..], zone, &input].concat()).unwrap();
        for flight in [&mut by_timeline, &mut by_input] {
            flight.step_to(HOUR_S).unwrap();
            let [azimuth, elevation] =
                ["sun.azimuth", "sun.elevation"].map(|it| flight.real(it).to_degrees());
            assert!(
                (azimuth - 3.0).abs() < 1e-9 && (elevation - expected_deg).abs() < 1e-9,
                "{azimuth} {elevation}"
            );
            assert_eq!(flight.boolean("downlink.clamped"), expected_deg != 20.0);
        }
        let [a, b] = [&by_timeline, &by_input].map(|it| it.vector("momentum.inertial"));
        assert!((a - b).norm() < 1e-9 * a.norm(), "{a} {b}");
    }
}

/// Within rounding of its boundary the keep-in zone neither begins nor ends to act: a step takes no more work than elsewhere.
#[test]
fn a_place_on_the_keep_in_zones_boundary_is_simulated_in_one_step() {
    for [azimuth_deg, elevation_deg] in [[-15.0, -5.0], [-15.0, -13.0], [4.0, 13.0], [-14.94, -12.94]] {
        let named = planned(&format!(
            "[[command]]\nat = 0\nscenario = \"downlink\"\n\
             sun = {{ azimuth = \"{azimuth_deg} deg\", elevation = \"{elevation_deg} deg\" }}\n"
        ));
        let mut flight = named.initialize(0.0, &[("solver.workLimit", 2e4)]).unwrap();
        flight.step_to(14.0 * HOUR_S).unwrap();
    }
}

#[test]
fn an_input_goes_before_the_timeline_and_what_it_leaves_goes_by_guided() {
    let timeline =
        "[[command]]\nat = 0\nuntil = 3600\nscenario = \"downlink\"\nsun = { elevation = \"4 deg\" }\n";
    let named = planned(timeline);
    let mut flight = named.initialize(0.0, &cruise(0.4)).unwrap();
    let elevation_deg = |flight: &NamedInstance<'_, MomentumPlant>| flight.real("sun.elevation").to_degrees();
    flight.step_to(1000.0).unwrap();
    assert!((elevation_deg(&flight) - 4.0).abs() < 1e-9);
    flight.set("downlink.sunElevation", -0.1);
    flight.step_to(2000.0).unwrap();
    assert!((flight.real("sun.elevation") + 0.1).abs() < 1e-9);
    flight.set("downlink.sunElevation", 0.0);
    // At its edge the command is over.
    flight.step_to(3600.0).unwrap();
    assert!((flight.integer("timeline.command"), elevation_deg(&flight).abs() < 1e-9) == (0, true));
    flight.step_to(3600.0 + 1e-3).unwrap();
    assert!(flight.boolean("downlink.active") && elevation_deg(&flight).abs() < 1e-9);
}

#[test]
fn dates_are_times_of_the_simulation_wherever_it_begins() {
    let date = |time: &str| format!("\"2008-03-20T{time} TDB\"");
    let timeline = format!(
        "[[command]]\nat = {}\nscenario = \"downlink\"\n[[command]]\nat = {}\nscenario = \"downlink\"\n\
         sun = {{ elevation = \"4 deg\" }}\n[[panels]]\nat = {}\nsunOffset = \"20 deg\"\n\
         [[event]]\nat = {}\nmaneuver = {{ deltaV = [1, 0, 0] }}\n[[event]]\nat = {}\ndump = [1, 0, 0]\n",
        date("00:00:00"),
        date("12:00:00.5"),
        date("12:00:00.5"),
        date("00:00:00"),
        date("12:00:00.5"),
    );
    let named = planned(&timeline);
    for start_s in [0.0, 0.1, 0.3, 1e5 + 0.7] {
        // J2000 is at noon of the first day of 2000.
        let epoch = [("start.epoch", 3_000.5 * DAY_S)];
        let sets = [&cruise(0.4)[..], &by_timeline(), &epoch].concat();
        let mut flight = named.initialize(start_s, &sets).unwrap();
        assert_eq!(flight.integer("maneuver.count"), 1, "{start_s}");
        let edge_s = start_s + 43_200.5;
        flight.step_to(edge_s - 1e-3).unwrap();
        assert_eq!((flight.integer("timeline.command"), flight.integer("dump.count")), (1, 1));
        let before_rad = flight.real("panel[1].angleActual");
        flight.step_to(edge_s).unwrap();
        assert_eq!((flight.integer("timeline.command"), flight.integer("dump.count")), (2, 2), "{start_s}");
        assert!((flight.real("panel[1].angleActual") - before_rad).abs() > 0.1);
        assert!((flight.real("dump.lastTime") - edge_s).abs() < 1e-6);
    }
}

#[test]
fn without_the_timeline_neither_panels_nor_events_follow_it() {
    let timeline = "[[panels]]\nat = 0\nsunOffset = \"20 deg\"\n[[event]]\nat = 10\ndump = true\n";
    let named = planned(timeline);
    let mut flight = named
        .initialize(0.0, &[&cruise(0.4)[..], &by_timeline(), &[("timeline.enabled", 0.0)]].concat())
        .unwrap();
    flight.step_to(100.0).unwrap();
    assert_eq!(flight.integer("dump.count"), 0);
    let plain = NamedModel::<MomentumPlant>::shipped();
    let plain = plain.initialize(0.0, &cruise(0.4)).unwrap();
    assert!((flight.real("panel[1].angleActual") - plain.real("panel[1].angleActual")).abs() < 1e-6);
}

#[test]
fn the_alternate_attitude_is_half_a_turn_about_the_sun_line() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let [direct, alternate] = [0.0, 1.0].map(|alternate| {
        let sets = [&cruise(0.4)[..], &[("downlink.alternate", alternate), ("downlink.sunElevation", 0.1)]];
        let mut flight = named.initialize(0.0, &sets.concat()).unwrap();
        flight.step_to(HOUR_S).unwrap();
        flight
    });
    let turn = alternate.to_inertial("attitude.q") * direct.to_inertial("attitude.q").inverse();
    let sun = -direct.vector("position").normalize();
    assert!((turn.angle() - core::f64::consts::PI).abs() < 1e-9, "{}", turn.angle());
    assert!(turn.axis().unwrap().cross(&sun).norm() < 1e-9);
    // The light falls on the same sides.
    let torques = [&direct, &alternate].map(|it| it.vector("torque.solar"));
    assert!((torques[0] - torques[1]).norm() < 1e-9 * torques[0].norm());
}

#[test]
fn controlled_flight_with_its_own_guidance_samples_the_timeline() {
    let timeline = "[[command]]\nat = 0\nscenario = \"downlink\"\n\
                    [[command]]\nat = 600\nscenario = \"downlink\"\nsun = { elevation = \"4 deg\" }\n";
    let named = planned(timeline);
    let sets = [("attitude.source", 3.0), ("command.source", 2.0)];
    let mut flight = named.initialize(0.0, &[&cruise(0.4)[..2], &cruise(0.4)[2..4], &sets].concat()).unwrap();
    flight.step_to(599.0).unwrap();
    assert!(flight.real("sun.elevation").abs() < 1e-3, "{}", flight.real("sun.elevation"));
    assert_eq!(flight.integer("timeline.command"), 1);
    flight.step_to(1800.0).unwrap();
    assert!(
        (flight.real("sun.elevation") - 4_f64.to_radians()).abs() < 1e-3,
        "{}",
        flight.real("sun.elevation")
    );
    assert_eq!(flight.integer("timeline.command"), 2);
}
