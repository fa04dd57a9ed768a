//! Guidance and the controlled plant in a loop, both by their defaults.

use models::{Guidance, MomentumPlant};

use super::super::named_model::NamedModel;
use super::with;

const OPERATIONAL: i32 = 1;

/// A scan about X with the boresight, -Y, at the Sun: its elevation goes from 0 to `reversal_rad` and back, again and again.
fn scan(reversal_rad: f64) -> Vec<(&'static str, f64)> {
    let rate_rad_s = 0.05_f64.to_radians();
    vec![
        ("pointing.scenario", 1.0),
        ("boresight.option", 1.0),
        ("boresight.vector[2]", -1.0),
        ("aimpoint.option", 10.0),
        ("bodyRoll.option", 1.0),
        ("bodyRoll.vector[3]", 1.0),
        ("externalRoll.option", 5.0),
        ("scan.frame", 1.0),
        ("scan.rate[1]", rate_rad_s),
        ("scan.duration[1]", (reversal_rad / rate_rad_s).round()),
        ("scan.reverse[1]", 1.0),
        ("hotPole.enabled", 0.0),
    ]
}

#[test]
fn an_ordinary_scan_near_the_boundary_does_not_end_in_safe_hold() {
    let (plants, guidances) = (NamedModel::<MomentumPlant>::shipped(), NamedModel::<Guidance>::shipped());
    let places = plants.initialize(0.0, &[]).unwrap();
    let [position, velocity] = ["position", "velocity"].map(|name| places.vector(name));
    let limit_rad = 13_f64.to_radians();
    let mut greatest_rad = 0.0_f64;
    // Short of the boundary, and beyond it, where the zone holds the Sun on it.
    for reversal_rad in [12.9_f64.to_radians(), 15_f64.to_radians()] {
        let at_start = [
            ("position[1]", position.x),
            ("position[2]", position.y),
            ("position[3]", position.z),
            ("velocity[1]", velocity.x),
            ("velocity[2]", velocity.y),
            ("velocity[3]", velocity.z),
        ];
        let mut guidance = guidances.initialize(0.0, &with(&[&at_start, &scan(reversal_rad)])).unwrap();
        let start_q = guidance.quaternion("command.q");
        let names = [1, 2, 3, 4].map(|i| format!("start.q[{i}]"));
        let mut start: Vec<_> = names.iter().map(String::as_str).zip(start_q).collect();
        start.push(("attitude.source", 3.0));
        let mut plant = plants.initialize(0.0, &start).unwrap();
        for second in 0..900 {
            // Both take what the other had at the step's begin.
            let kind = guidance.integer("command.kind");
            plant.set("command.kind", f64::from(kind));
            plant.set_elements("command.q", &guidance.quaternion("command.q"));
            plant.set_elements("command.rate", &guidance.vector("command.rate"));
            for name in ["position", "velocity"] {
                guidance.set_elements(name, &plant.vector(name));
            }
            guidance.set_elements("estimate.q", &plant.quaternion("estimate.q"));
            guidance.step_to(f64::from(second + 1)).unwrap();
            plant.step_to(f64::from(second + 1)).unwrap();
            assert_eq!(guidance.integer("mode.active"), OPERATIONAL, "{reversal_rad} {second} s");
            greatest_rad = greatest_rad.max(plant.real("sun.elevation").abs() - limit_rad);
        }
    }
    // It does overshoot.
    assert!(greatest_rad > 0.5_f64.to_radians(), "{greatest_rad}");
}
