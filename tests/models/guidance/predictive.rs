//! Predictive targets of a sampled guidance against those of a plant that guides itself, where sunlight alone acts.

use client::short_or_long;
use models::{Guidance, MomentumPlant};

use super::super::named_model::{NamedInstance, NamedModel};
use super::{GuidanceInstance, with};

const HOUR_S: f64 = 3600.0;
const CYCLE_S: f64 = 24.0 * HOUR_S;

/// Start values of both, reported alike: the centre of mass 5 cm off along Z, a shade alone in the light.
fn spacecraft(strategy: f64, convention: f64) -> Vec<(&'static str, f64)> {
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

fn span_s() -> f64 {
    short_or_long(6.0, 30.0) * CYCLE_S
}

/// Thresholds low enough for dumps within days.
const LOW: &[(&str, f64)] =
    &[("dump.threshold[1]", 1.0), ("dump.threshold[2]", 1.0), ("dump.threshold[3]", 1.0)];

const PLANT: &[(&str, f64)] = &[("gravityGradient.enabled", 0.0)];

const GUIDANCE: &[(&str, f64)] = &[
    ("pointing.scenario", 10.0),
    ("hotPole.enabled", 0.0),
    ("keepIn.enabled", 0.0),
    ("monitor.enabled", 0.0),
];

/// Tells guidance what a plant does.
fn observe(guidance: &mut GuidanceInstance<'_>, plant: &NamedInstance<'_, MomentumPlant>) {
    for (input, output) in
        [("position", "position"), ("velocity", "velocity"), ("momentum.body", "momentum.body")]
    {
        guidance.set_elements(input, &plant.vector(output));
    }
    guidance.set_elements("estimate.q", &plant.quaternion("attitude.q"));
}

/// Beginning of a downlink, a hundredth of a second into it.
fn downlink_s(cycle: u32) -> f64 {
    2.0 * HOUR_S + f64::from(cycle) * CYCLE_S + 0.01
}

#[test]
fn a_sample_chooses_what_a_plant_chooses() {
    let (guidances, plants) = (NamedModel::<Guidance>::shipped(), NamedModel::<MomentumPlant>::shipped());
    // What is left is the steps of the forecasts, and two-body motion over twenty days.
    let more = [("guided.downlinkEnd", 10.1 * HOUR_S), ("spacecraft.centerOfMass[3]", 0.02)];
    for (convention, bound_rad) in [(1.0, 1e-5), (2.0, 3e-5)] {
        let reported = with(&[&spacecraft(3.0, convention), &more]);
        let mut plant = plants.initialize(0.0, &with(&[&reported, PLANT])).unwrap();
        let (mut worst_rad, mut reactive_rad) = (0.0_f64, 0.0_f64);
        // The plant forecasts nothing where its flight begins.
        for cycle in 1..12 {
            plant.step_to(downlink_s(cycle)).unwrap();
            let choice = |strategy: f64| {
                let epoch_s = plant.real("start.epoch") + plant.time_s();
                let more = [("start.epoch", epoch_s), ("momentum.strategy", strategy)];
                let mut guidance = guidances.initialize(0.0, &with(&[&reported, GUIDANCE, &more])).unwrap();
                observe(&mut guidance, &plant);
                guidance.step_to(1e-3).unwrap();
                guidance
            };
            let off_rad = |guidance: &GuidanceInstance<'_>| {
                let off = ["sun.azimuth", "sun.elevation"].map(|it| guidance.real(it) - plant.real(it));
                off[0].abs().max(off[1].abs())
            };
            let predictive = choice(3.0);
            let clamped =
                [predictive.boolean("momentum.targetClamped"), plant.boolean("momentum.targetClamped")];
            assert_eq!(clamped[0], clamped[1], "{convention} {cycle}");
            worst_rad = worst_rad.max(off_rad(&predictive));
            reactive_rad = reactive_rad.max(off_rad(&choice(2.0)));
        }
        println!("{convention}: {worst_rad:e}, reactive {reactive_rad:e}");
        assert!(worst_rad < bound_rad && reactive_rad > 0.01, "{worst_rad:e} {reactive_rad:e}");
    }
}

/// Dumps in thirty days of a plant that follows what a sampled guidance commands, ten minutes late at most.
fn dumps_by_samples(strategy: f64) -> i32 {
    let (guidances, plants) = (NamedModel::<Guidance>::shipped(), NamedModel::<MomentumPlant>::shipped());
    let reported = with(&[&spacecraft(strategy, 2.0), LOW]);
    let follows = [("attitude.source", 2.0), ("momentum.strategy", 1.0)];
    let mut plant = plants.initialize(0.0, &with(&[&reported, PLANT, &follows])).unwrap();
    let mut guidance = guidances.initialize(0.0, &with(&[&reported, GUIDANCE])).unwrap();
    while plant.time_s() < span_s() {
        let end_s = plant.time_s() + 600.0;
        observe(&mut guidance, &plant);
        guidance.step_to(end_s).unwrap();
        plant.set_elements("command.q", &guidance.quaternion("command.q"));
        plant.set_elements("command.rate", &guidance.vector("command.rate"));
        plant.step_to(end_s).unwrap();
    }
    plant.integer("dump.count")
}

#[test]
fn samples_that_look_ahead_save_as_many_dumps_as_a_plant_that_does() {
    let plants = NamedModel::<MomentumPlant>::shipped();
    let [reactive, predictive] = [2.0, 3.0].map(|strategy| {
        let mut plant = plants.initialize(0.0, &with(&[&spacecraft(strategy, 2.0), LOW, PLANT])).unwrap();
        plant.simulate_to(span_s(), HOUR_S).unwrap();
        (plant.integer("dump.count"), dumps_by_samples(strategy))
    });
    println!("dumps of the plant's own and of samples: reactive {reactive:?}, predictive {predictive:?}");
    assert!(predictive.1 < reactive.1, "{reactive:?} {predictive:?}");
    assert!((predictive.0 - predictive.1).abs() <= 1, "{predictive:?}");
    assert!((reactive.0 - reactive.1).abs() <= 1, "{reactive:?}");
}

#[test]
fn without_a_cycle_to_come_a_target_is_the_given_one() {
    let named = NamedModel::<Guidance>::shipped();
    let place = [
        ("position[1]", 4e6),
        ("velocity[2]", 2.3e3),
        ("velocity[3]", 400.0),
        ("pointing.scenario", 6.0),
        ("guided.downlinkEnd", 12_000.0),
    ];
    for convention in [1.0, 2.0] {
        let chosen = |strategy: f64, more: &[(&str, f64)]| {
            let flight = named
                .initialize(0.0, &with(&[&spacecraft(strategy, convention), GUIDANCE, &place, more]))
                .unwrap();
            flight.quaternion("command.q")
        };
        let cycles = [("guided.downlinkEvery", 2.0)];
        assert_ne!(chosen(2.0, &cycles), chosen(3.0, &cycles));
        for none in [
            &[("guided.downlinkEvery", 0.0)][..],
            &[("guided.downlinkReference", 2.0)],
            // Past the planet, never to return.
            &[("velocity[2]", 6e3)],
        ] {
            assert_eq!(chosen(2.0, none), chosen(3.0, none), "{none:?}");
        }
    }
}

#[test]
fn a_longer_horizon_costs_work_that_a_step_may_not_have() {
    let named = NamedModel::<Guidance>::shipped();
    let place = [("position[1]", 4e6), ("velocity[2]", 2.3e3), ("pointing.scenario", 6.0)];
    let refusal = |horizon: f64| {
        let limit = [("solver.workLimit", 50_000.0), ("momentum.horizon", horizon)];
        let mut flight =
            named.initialize(0.0, &with(&[&spacecraft(3.0, 2.0), GUIDANCE, &place, &limit])).unwrap();
        flight.step_to(2.0).err().map(|it| it.to_string())
    };
    assert_eq!(refusal(4.0), None);
    assert!(refusal(100.0).unwrap().contains("solver.workLimit"));
}
