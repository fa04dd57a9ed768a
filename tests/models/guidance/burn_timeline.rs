//! A timeline with three burns, by Guidance and the controlled plant in a loop.

use models::{Guidance, MomentumPlant};
use nalgebra::Vector3;

use super::super::named_model::NamedModel;
use super::super::spacecraft::{EXHAUST_M_S, SIMPLE, couples, thruster};
use super::{FREE, with};

const START: &str = "2011-04-06T00:00:00 UTC";
const HOUR_S: f64 = 3600.0;

/// A command that burns, in h of the start, and what it adds, in m/s.
struct Planned {
    at_h: f64,
    delta_v_m_s: Vector3<f64>,
}

/// At a date, after a time, and when the attitude is reached; each by a set of its own.
const TIMELINE: &str = r#"
[[command]]
at = "2011-04-06T00:00:00 UTC"
scenario = "nadir"
[[command]]
at = "2011-04-06T00:15:00 UTC"
scenario = "burn"
burn = { deltaV = [7.0, -9.0, 4.0], thrusters = "main", start = "2011-04-06T00:35:00 UTC" }
[[command]]
at = "2011-04-06T00:45:00 UTC"
scenario = "nadir"
[[command]]
at = "2011-04-06T01:00:00 UTC"
until = "2011-04-06T01:30:00 UTC"
scenario = "burn"
burn = { deltaV = [-1.0, 3.0, 2.0], thrusters = "fine" }
[[command]]
at = "2011-04-06T01:40:00 UTC"
scenario = "nadir"
[[command]]
at = "2011-04-06T02:00:00 UTC"
scenario = "burn"
burn = { deltaV = ["0.5 m/s", "0.0 m/s", "-1.5 m/s"], thrusters = "side", start = "15 min", duration = "10 min" }
[[command]]
at = "2011-04-06T02:30:00 UTC"
scenario = "nadir"
"#;

fn planned() -> [Planned; 3] {
    let planned = |at_h, delta_v: [f64; 3]| Planned { at_h, delta_v_m_s: Vector3::from(delta_v) };
    [planned(0.25, [7.0, -9.0, 4.0]), planned(1.0, [-1.0, 3.0, 2.0]), planned(2.0, [0.5, 0.0, -1.5])]
}

/// 100 N along +Z that never turn it, 20 N along +Z, 10 N along +X; couples and wheels for the attitude.
fn spacecraft() -> String {
    let pairs = |set: &str, axis: usize, force_n: f64| {
        [1.0, -1.0].map(|side| {
            let (mut at, mut direction) = ([0.0; 3], [0.0; 3]);
            (at[1], direction[axis]) = (side * 0.5, 1.0);
            thruster(at, direction, force_n, &format!("set = \"{set}\""))
        })
    };
    let main = thruster([0.0; 3], [0.0, 0.0, 1.0], 100.0, "set = \"main\"\nattitude_control = false");
    let wheels: String = ["[1.0, 0.0, 0.0]", "[0.0, 1.0, 0.0]", "[0.0, 0.0, 1.0]"]
        .map(|axis| format!("[[wheels]]\naxis = {axis}\ncapacity_n_m_s = 10.0\n"))
        .concat();
    let sets = [pairs("fine", 2, 10.0), pairs("side", 0, 5.0)].concat().concat();
    format!("{SIMPLE}{main}{sets}{}{wheels}", couples(""))
}

#[test]
fn each_burn_of_a_timeline_adds_its_velocity() {
    let spacecraft = spacecraft();
    let plants = NamedModel::<MomentumPlant>::with("own.toml", &spacecraft);
    let guidances =
        NamedModel::<Guidance>::with("own.toml", &spacecraft).with_schedule("timeline.toml", TIMELINE);
    let epoch = [("start.epoch", physics::environment::dates::epoch_s(START).unwrap())];
    let places = ["position", "velocity"];
    let before = plants.initialize(0.0, &epoch).unwrap();
    let names = places.map(|name| [1, 2, 3].map(|i| format!("{name}[{i}]")));
    let at_start: Vec<_> = names.iter().flatten().map(|name| (name.as_str(), before.real(name))).collect();
    let mut guidance = guidances.initialize(0.0, &with(&[&epoch, FREE, &at_start])).unwrap();
    let start_q = guidance.quaternion("command.q");
    let names = [1, 2, 3, 4].map(|i| format!("start.q[{i}]"));
    let q: Vec<_> = names.iter().map(String::as_str).zip(start_q).collect();
    let controlled = [("attitude.source", 3.0), ("command.source", 1.0)];
    let mut plant = plants.initialize(0.0, &with(&[&epoch, &q, &controlled])).unwrap();

    let planned = planned();
    let (mut now_s, mut added) = (0.0, Vec::new());
    let mut begin = None;
    while now_s < 2.75 * HOUR_S {
        let command = planned.iter().find(|it| {
            let since_s = now_s - it.at_h * HOUR_S;
            (0.0..0.5 * HOUR_S).contains(&since_s)
        });
        match (begin, command) {
            (None, Some(_)) => begin = Some((plant.vector("deltaV"), plant.real("mass"))),
            (Some((before, mass_kg)), None) => {
                let ideal_m_s = EXHAUST_M_S * (mass_kg / plant.real("mass")).ln();
                added.push((plant.vector("deltaV") - before, ideal_m_s));
                begin = None;
            }
            _ => {}
        }
        now_s += if command.is_some() { 1.0 } else { 60.0 };
        // Both take what the other had at the step's begin.
        for name in ["command.kind", "thrust.request"] {
            plant.set(name, f64::from(guidance.integer(name)));
        }
        plant.set("thrust.command", f64::from(u8::from(guidance.boolean("thrust.command"))));
        plant.set("thrust.stop", guidance.real("thrust.stop"));
        plant.set_elements("command.q", &guidance.quaternion("command.q"));
        plant.set_elements("command.rate", &guidance.vector("command.rate"));
        for name in ["position", "velocity", "accelerometer.deltaV"] {
            guidance.set_elements(name, &plant.vector(name));
        }
        guidance.set_elements("estimate.q", &plant.quaternion("estimate.q"));
        guidance.step_to(now_s).unwrap();
        plant.step_to(now_s).unwrap();
    }
    assert_eq!(added.len(), planned.len());
    for ((added, ideal_m_s), planned) in added.iter().zip(&planned) {
        let speed_m_s = planned.delta_v_m_s.norm();
        let off = (added - planned.delta_v_m_s).norm() / speed_m_s;
        assert!(off < 0.01, "{added} m/s, planned {} m/s", planned.delta_v_m_s);
        // By its propellant, of which wheels need none.
        assert!(
            (ideal_m_s / speed_m_s - 1.0).abs() < 0.01,
            "{ideal_m_s} m/s by the rocket equation, {speed_m_s} m/s"
        );
    }
    assert!(!guidance.boolean("burn.timedOut"));
    assert!(guidances.warnings().iter().all(|it| !it.contains("burn")), "{:?}", guidances.warnings());
}
