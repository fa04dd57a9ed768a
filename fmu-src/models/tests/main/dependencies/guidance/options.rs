//! Options drawn at random, and those that a subject needs.

use super::super::super::named_model::Tables;
use super::super::random::RandomNumbers;
use super::numbers::redraw;
use super::subject::{Guide, Subject};

/// Options drawn at random, with their items in this version.
const OPTIONS: &[(&str, i32, i32)] = &[
    ("boresight.option", 0, 4),
    ("aimpoint.body", 0, 7),
    ("secondAimpoint.body", 0, 7),
    ("bodyRoll.option", 0, 2),
    ("externalRoll.option", 0, 5),
    ("limb.reference", 0, 2),
    ("scan.reference", 0, 2),
    ("scan.segments[1]", 0, 2),
    ("scan.segments[2]", 0, 2),
    ("scan.segments[3]", 0, 2),
    ("scan.reverse[1]", 0, 1),
    ("scan.reverse[2]", 0, 1),
    ("scan.reverse[3]", 0, 1),
    ("subsolar.method", 1, 2),
    ("keepIn.method", 1, 2),
    ("guided.scienceRule", 1, 3),
    ("guided.downlinkEvery", 0, 2),
    ("boresight.instrument", 0, 3),
];

/// A configuration about a subject.
pub fn draw(bench: &Guide, random: &mut RandomNumbers, subject: Subject) -> Tables {
    let mut values = bench.defaults();
    for (name, low, high) in OPTIONS {
        let item = random.whole(*low, *high);
        // Item 5 of bodies is kept.
        bench.put(&mut values, name, if name.ends_with("body") && item == 5.0 { 6.0 } else { item });
    }
    let item = |bench: &Guide, values: &mut Tables, name: &str, item: i32| {
        bench.put(values, name, f64::from(item));
    };
    let chance = |random: &mut RandomNumbers, share: f64| f64::from(u8::from(random.next() < share));
    bench.put(&mut values, "pointing.scenario", random.whole(1, 8));
    bench.put(&mut values, "aimpoint.option", random.whole(0, 14));
    bench.put(&mut values, "secondAimpoint.option", random.whole(0, 14));
    bench.put(&mut values, "keepIn.enabled", chance(random, 0.6));
    bench.put(&mut values, "hotPole.enabled", chance(random, 0.6));
    bench.put(&mut values, "monitor.enabled", chance(random, 0.7));
    // The theory of the planets costs most.
    let source = if random.next() < 0.95 { 3.0 } else { random.whole(1, 2) };
    bench.put(&mut values, "ephemeris.source", source);
    bench.put(&mut values, "target.planet", if random.next() < 0.9 { 1.0 } else { random.whole(3, 4) });
    bench.put(&mut values, "start.epoch", random.between(0.0, 3e7));
    bench.put(&mut values, "estimate.valid", 1.0);
    match subject {
        Subject::Scenario(scenario) => item(bench, &mut values, "pointing.scenario", scenario),
        Subject::Aimpoint(option) => {
            item(bench, &mut values, "pointing.scenario", 2);
            item(bench, &mut values, "aimpoint.option", option);
            bench.put(&mut values, "hotPole.enabled", 0.0);
        }
        Subject::SecondAimpoint(option) => {
            item(bench, &mut values, "pointing.scenario", 5);
            item(bench, &mut values, "aimpoint.option", random.whole(1, 14) as i32);
            item(bench, &mut values, "secondAimpoint.option", option);
        }
        Subject::Scan(frame) => {
            item(bench, &mut values, "scan.frame", frame);
            bench.put(&mut values, "pointing.scenario", if random.next() < 0.5 { 5.0 } else { 2.0 });
            let aims = [6.0, 7.0, 9.0, 13.0, 12.0, 5.0];
            let aim = aims[(random.next() * 6.0) as usize % 6];
            bench.put(&mut values, "aimpoint.option", aim);
        }
        Subject::Modes => {
            bench.put(&mut values, "pointing.scenario", random.whole(2, 3));
            bench.put(&mut values, "mode.request", random.whole(0, 3));
            bench.put(&mut values, "estimate.valid", chance(random, 0.6));
            bench.put(&mut values, "sun.sensedValid", chance(random, 0.6));
        }
        Subject::Monitor => {
            bench.put(&mut values, "pointing.scenario", random.whole(2, 3));
            bench.put(&mut values, "monitor.enabled", 1.0);
            bench.put(&mut values, "mode.request", random.whole(0, 2));
            bench.put(&mut values, "keepIn.enabled", chance(random, 0.8));
            bench.put(&mut values, "ephemeris.source", if random.next() < 0.8 { 3.0 } else { 2.0 });
        }
        Subject::Ephemeris => {
            bench.put(&mut values, "pointing.scenario", random.whole(2, 3));
            bench.put(&mut values, "ephemeris.source", 4.0);
            bench.put(&mut values, "target.planet", 1.0);
            bench.put(&mut values, "mode.request", random.whole(0, 1));
            bench.put(&mut values, "sun.sensedValid", 1.0);
            bench.put(&mut values, "monitor.enabled", 0.0);
            bench.put(&mut values, "aimpoint.option", random.whole(1, 3));
        }
        Subject::Generic => {
            bench.put(&mut values, "pointing.scenario", 1.0);
            bench.put(&mut values, "boresight.option", random.whole(1, 4));
            bench.put(&mut values, "bodyRoll.option", random.whole(1, 2));
            bench.put(&mut values, "externalRoll.option", random.whole(1, 5));
            bench.put(&mut values, "keepIn.enabled", chance(random, 0.2));
            bench.put(&mut values, "hotPole.enabled", chance(random, 0.2));
            bench.put(&mut values, "scan.frame", random.whole(0, 2));
        }
        Subject::Lost(what) => {
            let (scenario, boresight, aim) = match what {
                0 => (1, 1, 10),
                1 => (2, 4, 1),
                2 => (1, 4, 1),
                3 => (2, 4, 8),
                4 => (8, 4, 1),
                5 => (5, 4, 5),
                6 => (1, 4, 5),
                _ => (2, 4, 15),
            };
            item(bench, &mut values, "pointing.scenario", scenario);
            item(bench, &mut values, "boresight.option", boresight);
            item(bench, &mut values, "aimpoint.option", aim);
            bench.put(&mut values, "limb.reference", 1.0);
            bench.put(&mut values, "mode.request", 1.0);
            bench.put(&mut values, "scan.frame", random.whole(0, 2));
            // A spacecraft that is promoted from Earth Acquisition has an error quaternion to lose.
            bench.put(&mut values, "sun.sensedValid", 1.0);
        }
        Subject::OrbitPhase => {
            item(bench, &mut values, "pointing.scenario", 10);
            bench.put(&mut values, "guided.downlinkEvery", random.whole(1, 2));
            bench.put(&mut values, "guided.slewRate", if random.next() < 0.3 { 0.0 } else { 1e-3 });
            bench.put(&mut values, "keepIn.enabled", chance(random, 0.3));
            bench.put(&mut values, "hotPole.enabled", chance(random, 0.3));
        }
        Subject::HotPole => {
            bench.put(&mut values, "hotPole.enabled", 1.0);
            bench.put(&mut values, "pointing.scenario", random.whole(1, 3));
        }
        Subject::Link => item(bench, &mut values, "pointing.scenario", 6),
        Subject::Burn => {
            item(bench, &mut values, "pointing.scenario", 9);
            bench.put(&mut values, "keepIn.enabled", chance(random, 0.3));
            bench.put(&mut values, "hotPole.enabled", chance(random, 0.3));
            bench.put(&mut values, "monitor.enabled", chance(random, 0.3));
            bench.put(&mut values, "burn.thrusters", random.whole(0, 3));
        }
        Subject::Momentum | Subject::Predictive => {
            let scenario = if random.next() < 0.7 { 6 } else { 10 };
            item(bench, &mut values, "pointing.scenario", scenario);
            bench.put(&mut values, "boresight.option", random.whole(0, 3));
            let is_predictive = subject == Subject::Predictive;
            bench.put(&mut values, "momentum.strategy", if is_predictive { 3.0 } else { 2.0 });
            bench.put(&mut values, "momentum.horizon", random.whole(1, 2));
            bench.put(&mut values, "momentum.targetAxes", random.whole(1, 3));
            bench.put(&mut values, "momentum.targeting", random.whole(1, 2));
            bench.put(&mut values, "momentum.convention", random.whole(1, 2));
            bench.put(&mut values, "solar.fixedPressure", chance(random, 0.3));
            bench.put(&mut values, "dump.reinitTo", random.whole(1, 2));
            let every = if is_predictive { random.whole(1, 2) } else { 1.0 };
            bench.put(&mut values, "guided.downlinkEvery", every);
            let is_slewing = is_predictive && random.next() < 0.3;
            bench.put(&mut values, "guided.slewRate", if is_slewing { 1e-3 } else { 0.0 });
            bench.put(&mut values, "monitor.enabled", 0.0);
            bench.put(&mut values, "keepIn.enabled", chance(random, 0.3));
            bench.put(&mut values, "hotPole.enabled", chance(random, 0.3));
            for panel in (1..).take_while(|k| bench.has(&format!("panel[{k}].tilt"))) {
                bench.put(&mut values, &format!("panel[{panel}].tilt"), random.whole(1, 2));
                bench.put(&mut values, &format!("panel[{panel}].enabled"), chance(random, 0.8));
            }
        }
    }
    redraw(bench, random, subject, &mut values);
    values
}
