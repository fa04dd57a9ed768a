//! Predictive targets of a sampled guidance against those of a plant that guides itself, where sunlight alone acts.

use models::{Guidance, MomentumPlant};

use super::super::named_model::{NamedInstance, NamedModel};
use super::{Flight, quaternion, set_vector, with};

const HOUR_S: f64 = 3600.0;
const CYCLE_S: f64 = 24.0 * HOUR_S;

/// What both are told alike: the centre of mass 5 cm off along Z, a shade alone in the light.
fn craft(strategy: f64, convention: f64) -> Vec<(&'static str, f64)> {
    vec![
        ("momentum.strategy", strategy),
        ("momentum.convention", convention),
        ("solar.fixedPressure", 1.0),
        ("sunshade.shape", 2.0),
        ("panel[1].enabled", 0.0),
        ("panel[2].enabled", 0.0),
        ("spacecraft.centerOfMass[3]", 0.05),
        ("dump.threshold[1]", 4.0),
        ("dump.threshold[2]", 4.0),
        ("dump.threshold[3]", 4.0),
        ("dump.reinitFraction", 1.0),
    ]
}

const PLANT: &[(&str, f64)] = &[("gravityGradient.enabled", 0.0)];

const GUIDANCE: &[(&str, f64)] = &[
    ("pointing.scenario", 10.0),
    ("hotPole.enabled", 0.0),
    ("keepIn.enabled", 0.0),
    ("monitor.enabled", 0.0),
];

/// Tells guidance what a plant does.
fn observe(guidance: &mut Flight<'_>, plant: &NamedInstance<'_, MomentumPlant>) {
    for (input, output) in
        [("position", "position"), ("velocity", "velocity"), ("momentum.body", "momentum.body")]
    {
        set_vector(guidance, input, &plant.vector(output));
    }
    for (i, value) in (1..).zip(quaternion(plant, "attitude.q")) {
        guidance.set(&format!("estimate.q[{i}]"), value);
    }
}

/// Where a downlink begins, a hundredth of a second into it.
fn downlink_s(cycle: u32) -> f64 {
    2.0 * HOUR_S + f64::from(cycle) * CYCLE_S + 0.01
}

#[test]
fn a_sample_chooses_what_a_plant_chooses() {
    let (guidances, plants) = (NamedModel::<Guidance>::shipped(), NamedModel::<MomentumPlant>::shipped());
    for convention in [1.0, 2.0] {
        let told = craft(3.0, convention);
        let mut plant = plants.fly(0.0, &with(&[&told, PLANT])).unwrap();
        let (mut worst_rad, mut greatest_rad) = (0.0_f64, 0.0_f64);
        // The plant forecasts nothing where its flight begins.
        for cycle in 1..12 {
            plant.step_to(downlink_s(cycle)).unwrap();
            let epoch = [("start.epoch", plant.real("start.epoch") + plant.time_s())];
            let mut seen: Vec<(String, f64)> = Vec::new();
            for name in ["position", "velocity", "momentum.body"] {
                let vector = plant.vector(name);
                seen.extend((0..3).map(|i| (format!("{name}[{}]", i + 1), vector[i])));
            }
            let q = quaternion(&plant, "attitude.q");
            seen.extend((0..4).map(|i| (format!("estimate.q[{}]", i + 1), q[i])));
            let seen: Vec<(&str, f64)> = seen.iter().map(|(name, value)| (&**name, *value)).collect();
            let choose = |strategy: f64| {
                let sets = with(&[&told, GUIDANCE, &epoch, &seen, &[("momentum.strategy", strategy)]]);
                guidances.fly(0.0, &sets).unwrap()
            };
            let guidance = choose(3.0);
            for name in ["sun.azimuth", "sun.elevation"] {
                worst_rad = worst_rad.max((guidance.real(name) - plant.real(name)).abs());
                greatest_rad = greatest_rad.max((choose(2.0).real(name) - plant.real(name)).abs());
            }
            println!(
                "{convention} {cycle}: {:.5} {:.5} plant {:.5} {:.5} reactive {:.5} {:.5} {} {}",
                guidance.real("sun.azimuth"),
                guidance.real("sun.elevation"),
                plant.real("sun.azimuth"),
                plant.real("sun.elevation"),
                choose(2.0).real("sun.azimuth"),
                choose(2.0).real("sun.elevation"),
                guidance.boolean("momentum.targetClamped"),
                plant.boolean("momentum.targetClamped"),
            );
        }
        println!("{convention}: {worst_rad:e} {greatest_rad:e}");
    }
}

#[test]
fn loops() {
    let (guidances, plants) = (NamedModel::<Guidance>::shipped(), NamedModel::<MomentumPlant>::shipped());
    for (days, threshold) in [(30.0, 1.0), (30.0, 2.0), (90.0, 4.0)] {
        let thresholds = [1, 2, 3]
            .map(|i| (["dump.threshold[1]", "dump.threshold[2]", "dump.threshold[3]"][i - 1], threshold));
        for convention in [1.0, 2.0] {
            let own = [1.0, 2.0, 3.0].map(|strategy| {
                let mut plant =
                    plants.fly(0.0, &with(&[&craft(strategy, convention), PLANT, &thresholds])).unwrap();
                plant.fly_to(days * 24.0 * HOUR_S, 3600.0).unwrap();
                plant.integer("dump.count")
            });
            println!("{days} d, {threshold}: convention {convention} guided {own:?}");
            if days > 40.0 {
                continue;
            }
            let sampled = [2.0, 3.0].map(|strategy| {
                let begun = std::time::Instant::now();
                let told = craft(strategy, convention);
                let commanded = [("attitude.source", 2.0), ("momentum.strategy", 1.0)];
                let mut plant = plants.fly(0.0, &with(&[&told, PLANT, &thresholds, &commanded])).unwrap();
                let mut guidance = guidances.fly(0.0, &with(&[&told, GUIDANCE, &thresholds])).unwrap();
                let step_s = 600.0;
                let mut at_s = 0.0;
                while at_s < days * 24.0 * HOUR_S {
                    observe(&mut guidance, &plant);
                    guidance.step_to(at_s + step_s).unwrap();
                    for (i, value) in (1..).zip(quaternion(&guidance, "command.q")) {
                        plant.set(&format!("command.q[{i}]"), value);
                    }
                    for (i, value) in (1..).zip(guidance.vector("command.rate").iter()) {
                        plant.set(&format!("command.rate[{i}]"), *value);
                    }
                    at_s += step_s;
                    plant.step_to(at_s).unwrap();
                }
                println!("{:?}", begun.elapsed());
                plant.integer("dump.count")
            });
            println!("   sampled {sampled:?}");
        }
    }
}
