//! Guidance and the plant's own guidance are one law.

use models::{Guidance, MomentumPlant};

use super::super::named_model::{NamedInstance, NamedModel};
use super::with;

const ORBIT_S: f64 = 43_200.0;

/// The example's day, its dates as times from its first one.
fn example() -> String {
    const TEXT: &str = include_str!("../../../fmu-src/resources/examples/timeline.toml");
    let time = |line: &str| {
        let date = line.split('"').nth(1)?;
        let (day, clock) = date.strip_suffix(" UTC")?.strip_prefix("2011-04-0")?.split_once('T')?;
        let [hours, minutes] = [clock.get(..2)?, clock.get(3..5)?].map(|it| it.parse::<i32>().unwrap());
        let time_s = 86_400 * (day.parse::<i32>().ok()? - 6) + 3600 * hours + 60 * minutes;
        Some(line.replacen(&format!("\"{date}\""), &time_s.to_string(), 1))
    };
    let lines = TEXT.lines().map(|line| time(line).unwrap_or_else(|| line.to_owned()) + "\n");
    lines.collect()
}

/// Steps a plant by its own guidance and Guidance with the plant's positions, and compares their attitudes at samples.
fn compare(plant_sets: &[(&str, f64)], guidance_sets: &[(&str, f64)], length_s: f64, step_s: f64) {
    compare_by("[[event]]\nat = 0\ndump = true\n", plant_sets, guidance_sets, (length_s, step_s));
}

/// The same by a timeline, where it commands anything; where the Sun stood at each of these samples, in rad.
fn compare_by(
    timeline: &str,
    plant_sets: &[(&str, f64)],
    guidance_sets: &[(&str, f64)],
    (length_s, step_s): (f64, f64),
) -> Vec<(f64, [f64; 2])> {
    let plants = NamedModel::<MomentumPlant>::shipped().with_schedule("timeline.toml", timeline);
    let guidances = NamedModel::<Guidance>::shipped().with_schedule("timeline.toml", timeline);
    let commands = timeline.contains("[[command]]");
    // Guidance slews from its command, propagated by its rate since the last sample.
    let most =
        if commands && plant_sets.iter().any(|(name, _)| *name == "guided.slewRate") { 1e-6 } else { 1e-12 };
    let epoch = [("start.epoch", 2.9e8)];
    let plant_sets = with(&[plant_sets, &epoch, &[("attitude.source", 1.0), ("orbit.dynamics", 1.0)]]);
    let mut plant = plants.initialize(0.0, &plant_sets).unwrap();
    let quiet = [("hotPole.enabled", 0.0), ("monitor.enabled", 0.0)];
    let mut start = with(&[guidance_sets, &epoch, &quiet]);
    let places =
        ["position", "velocity", "momentum.body"].map(|name| [1, 2, 3].map(|i| format!("{name}[{i}]")));
    let seen =
        |plant: &NamedInstance<'_, MomentumPlant>| places.clone().map(|it| it.map(|name| plant.real(&name)));
    let at_start = seen(&plant);
    for (names, values) in places.iter().zip(at_start) {
        start.extend(names.iter().map(String::as_str).zip(values));
    }
    let mut guidance = guidances.initialize(0.0, &start).unwrap();
    let (mut worst, mut time_s, mut sun_rad) = (0.0_f64, 0.0, Vec::new());
    while time_s < length_s {
        for (names, values) in places.iter().zip(seen(&plant)) {
            names.iter().zip(values).for_each(|(name, value)| guidance.set(name, value));
        }
        guidance.set_elements("estimate.q", &plant.quaternion("attitude.q"));
        // Just after the sample, which belongs to the step that begins here.
        guidance.step_to(time_s + 1e-9).unwrap();
        if commands && plant.integer("timeline.command") == 0 {
            time_s += step_s;
            plant.step_to(time_s).unwrap();
            guidance.step_to(time_s).unwrap();
            continue;
        }
        let (a, b) = (guidance.quaternion("command.q"), plant.quaternion("attitude.q"));
        let difference = |sign: f64| a.iter().zip(b).map(|(a, b)| (a - sign * b).powi(2)).sum::<f64>().sqrt();
        let off = difference(1.0).min(difference(-1.0));
        assert!(off < most, "{off:e} at {time_s} s: {a:?} {b:?}");
        for flag in ["downlink.active", "downlink.clamped"] {
            assert_eq!(guidance.boolean(flag), plant.boolean(flag), "{flag} at {time_s} s");
        }
        worst = worst.max(off);
        sun_rad.push((time_s, ["sun.azimuth", "sun.elevation"].map(|name| plant.real(name))));
        time_s += step_s;
        plant.step_to(time_s).unwrap();
        guidance.step_to(time_s).unwrap();
    }
    assert!(worst > 0.0);
    sun_rad
}

#[test]
fn nadir_within_the_zone_is_the_plants_nadir_rule() {
    let rule = [("guided.scienceRule", 2.0), ("guided.downlinkEvery", 0.0)];
    let zone = [("keepIn.azimuth", 15_f64.to_radians()), ("keepIn.elevation", 13_f64.to_radians())];
    let limit = [("keepIn.elevation", 13_f64.to_radians())];
    compare(&with(&[&rule, &limit]), &with(&[&zone, &[("pointing.scenario", 3.0)]]), ORBIT_S, 120.0);
}

#[test]
fn downlink_is_the_plants_downlink() {
    let always = [("guided.downlinkEvery", 1.0), ("guided.downlinkStart", 0.0), ("guided.downlinkEnd", 1e9)];
    compare(&always, &[("pointing.scenario", 6.0)], ORBIT_S, 300.0);
}

#[test]
fn slews_into_commands_are_the_plants() {
    // The second begins before the slew into the first is over, downlinks are not linked before theirs is.
    let commands = "[[command]]\nat = 0\nattitude = [0.6, 0, 0, 0.8]\n[[command]]\nat = 100\nattitude = [0, -0.8, 0.6, 0]\n\
        [[command]]\nat = 180\nscenario = \"nadir\"\n[[command]]\nat = 2000\nscenario = \"downlink\"\n\
        sun = { azimuth = \"4 deg\" }\n[[command]]\nat = 3000\nscenario = \"plusZ\"\naimpoint = { option = \"earth\" }\n";
    let slewing = [("guided.slewRate", 2e-3), ("guided.downlinkEvery", 0.0), ("keepIn.enabled", 0.0)];
    compare_by(commands, &slewing, &slewing, (4000.0, 1.0));
}

#[test]
fn the_orbit_phase_is_the_plants_guided_attitude_over_three_days() {
    for every in [1.0, 2.0] {
        let windows = [("guided.downlinkEvery", every)];
        compare(&windows, &with(&[&windows, &[("pointing.scenario", 10.0)]]), 3.0 * 86_400.0, 600.0);
    }
}

#[test]
fn named_attitudes_are_one_law_in_both() {
    for rule in 4..=8 {
        let windows = [("guided.downlinkEvery", 1.0), ("guided.scienceRule", f64::from(rule))];
        compare(&windows, &with(&[&windows, &[("pointing.scenario", 10.0)]]), 2.0 * ORBIT_S, 600.0);
    }
}

#[test]
fn a_timeline_is_one_law_in_both() {
    let quiet = [("guided.downlinkEvery", 0.0)];
    compare_by(&example(), &quiet, &[], (86_400.0, 30.0));
    // Where the zone is off, its axis is another, or it holds the Sun elsewhere.
    let narrow = [("keepIn.azimuth", 0.05), ("keepIn.elevation", 0.1), ("keepIn.method", 2.0)];
    for zone in
        [&[("keepIn.enabled", 0.0)][..], &[("keepIn.axis[1]", 0.3), ("keepIn.axis[2]", -1.0)], &narrow]
    {
        compare_by(&example(), &with(&[&quiet, zone]), zone, (86_400.0, 90.0));
    }
    // Places of the Sun of its own, in the zone and beyond it, whatever the strategy.
    let places = "[[command]]\nat = 0\nscenario = \"downlink\"\nsun = { azimuth = \"-4 deg\", elevation = \"5 deg\" }\n\
                  [[command]]\nat = 7200\nscenario = \"downlink\"\nsun = { elevation = \"-25 deg\" }\nalternate = true\n\
                  [[command]]\nat = 14400\nscenario = \"nadir\"\n";
    for strategy in [1.0, 2.0, 3.0] {
        let strategy = [("momentum.strategy", strategy), ("guided.downlinkEvery", 2.0)];
        compare_by(places, &strategy, &strategy, (18_000.0, 90.0));
    }
}

/// Each command of a downlink has a place of its own, chosen for a downlink as long as the windows', by the momentum where it begins.
#[test]
fn every_downlink_of_a_timeline_is_chosen_anew_in_both() {
    let timeline = "[[command]]\nat = 0\nscenario = \"downlink\"\n[[command]]\nat = 1200\nscenario = \"downlink\"\n\
                    [[command]]\nat = 2400\nscenario = \"nadir\"\n[[command]]\nat = 3000\nscenario = \"downlink\"\n\
                    [[command]]\nat = 3600\nscenario = \"downlink\"\nalternate = true\n\
                    [[command]]\nat = 4200\nscenario = \"downlink\"\nsun = { elevation = \"2 deg\" }\n\
                    [[command]]\nat = 4800\nscenario = \"downlink\"\n";
    let momentum = [("start.momentum[1]", 0.4), ("start.momentum[3]", -0.3)];
    let both = [("momentum.strategy", 2.0), ("guided.downlinkEvery", 2.0), ("momentum.convention", 2.0)];
    let sun_rad = compare_by(timeline, &with(&[&both, &momentum]), &both, (5_400.0, 60.0));
    let place = |at_s: f64| sun_rad.iter().find(|(time_s, _)| *time_s == at_s).unwrap().1;
    let apart_rad = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    for (first_s, second_s) in [(600.0, 1800.0), (3300.0, 3900.0), (4500.0, 5100.0)] {
        assert!(apart_rad(place(first_s), place(second_s)) > 1e-4, "{first_s} {second_s}");
    }
    // What lies ahead is forecast anew too.
    let plants = NamedModel::<MomentumPlant>::shipped().with_schedule("timeline.toml", timeline);
    let mut plant =
        plants.initialize(0.0, &with(&[&both, &momentum, &[("momentum.strategy", 3.0)]])).unwrap();
    let places = [600.0, 1800.0, 3300.0, 3900.0].map(|at_s| {
        plant.step_to(at_s).unwrap();
        ["sun.azimuth", "sun.elevation"].map(|name| plant.real(name))
    });
    assert!(apart_rad(places[0], places[1]) > 1e-4 && apart_rad(places[2], places[3]) > 1e-4, "{places:?}");
}
