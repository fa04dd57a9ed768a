//! Real, Integer and Boolean get and set and doStep allocate no memory once an instance has simulated a while.

use client::{InProcess, Names, short_or_long};
use heliotorque_tests::counting::{Count, counted};
use model_description::BaseType;

use crate::scenarios::{Scenario, Simulation};
use crate::support::{LIBRARY, library, names, ok, silent};

/// References and scratch for values, made before counting begins.
struct Client {
    scenario: Scenario,
    reals: (Vec<u32>, Vec<f64>),
    integers: (Vec<u32>, Vec<i32>),
    booleans: (Vec<u32>, Vec<i32>),
    torque: [u32; 3],
    /// Inputs of the scenario beside the torque: Reals, and a Boolean.
    moved: Vec<u32>,
    switched: u32,
}

impl Client {
    fn new(scenario: Scenario, names: &Names) -> Self {
        let (reals, integers) = (names.all(BaseType::Real), names.all(BaseType::Integer));
        let booleans = names.all(BaseType::Boolean);
        let (moved, switched): (&[&str], _) = match scenario.model() {
            "MomentumPlant" => (&["command.rate[1]", "spacecraft.centerOfMass[2]"], "dump.request"),
            _ => (&["thruster[8].onTime", "thruster[8].onDelay"], "thruster[1].fire"),
        };
        Self {
            scenario,
            reals: (reals.to_vec(), vec![0.0; reals.len()]),
            integers: (integers.to_vec(), vec![0; integers.len()]),
            booleans: (booleans.to_vec(), vec![0; booleans.len()]),
            torque: names.vector("torque.applied"),
            moved: moved.iter().map(|name| names.real(name)).collect(),
            switched: names.typed(BaseType::Boolean, switched),
        }
    }

    /// Reads everything and, in the styles that set inputs, sets some.
    fn turn(&mut self, instance: &mut InProcess, step: usize) {
        ok(instance.get_real(&self.reals.0, &mut self.reals.1));
        ok(instance.get_integer(&self.integers.0, &mut self.integers.1));
        ok(instance.get_boolean(&self.booleans.0, &mut self.booleans.1));
        if matches!(self.scenario, Scenario::Commanded | Scenario::Fired) {
            let wave = (step as f64 * 0.1).sin();
            ok(instance.set_real(&self.torque, &[1e-5 * wave, 2e-6, -1e-6]));
            ok(instance.set_input_derivatives(&self.torque, &[1, 1, 1], &[1e-9 * wave, 0.0, 1e-10]));
            ok(instance.set_boolean(&[self.switched], &[i32::from(step.is_multiple_of(20))]));
            if step.is_multiple_of(30) {
                ok(instance.set_real(&self.moved, &[0.01 * wave.abs(), 0.02 * wave.abs()]));
            }
        }
    }
}

#[test]
fn simulations_allocate_nothing() {
    for scenario in Scenario::ALL {
        // In flight by torque a change of inputs makes the settings anew, which allocates.
        let is_by_torque = matches!(scenario, Scenario::Controlled | Scenario::Free);
        if is_by_torque || scenario == Scenario::Placed || scenario.model() == "Guidance" {
            continue;
        }
        let mut simulation = Simulation::new(scenario);
        let mut client = Client::new(scenario, &simulation.names);
        let step_s = if scenario.model() == "MomentumPlant" { 600.0 } else { 0.7 };
        (0..50).for_each(|_| simulation.step());
        let events = happened(&mut simulation);
        let (mut instance, mut time_s) = (simulation.instance, simulation.time_s);
        let ((), count) = counted(|| {
            for step in 0..short_or_long(2_000, 4_000) {
                client.turn(&mut instance, step);
                ok(instance.do_step(time_s, step_s));
                time_s += step_s;
            }
        });
        assert_eq!(count, Count::default(), "{scenario:?}");
        simulation.instance = instance;
        assert!(happened(&mut simulation) > events, "{scenario:?}: nothing happened in the simulation");
    }
}

/// Dumps so far, or Sun crossings: what a simulation without events would not have.
fn happened(simulation: &mut Simulation) -> i32 {
    let name =
        if simulation.scenario.model() == "MomentumPlant" { "dump.count" } else { "spin.sunCrossings" };
    let mut count = [0];
    ok(simulation.instance.get_integer(&[simulation.names.typed(BaseType::Integer, name)], &mut count));
    count[0]
}

/// Commands, scans, modes and windows of Guidance; every sample sets position and velocity.
#[test]
fn guidance_allocates_nothing() {
    for scenario in Scenario::ALL.into_iter().filter(|scenario| scenario.model() == "Guidance") {
        let mut simulation = Simulation::new(scenario);
        let names = names("Guidance");
        let references = [BaseType::Real, BaseType::Integer, BaseType::Boolean].map(|base| names.all(base));
        let mut reals = vec![0.0; references[0].len()];
        let [mut integers, mut booleans] = [1, 2].map(|base| vec![0; references[base].len()]);
        let [position, velocity] = ["position", "velocity"].map(|name| names.vector::<3>(name));
        let scenario_input = [names.typed(BaseType::Integer, "pointing.scenario")];
        let rate = names.vector::<3>("command.rate");
        (0..200).for_each(|_| simulation.step());
        let (instance, mut time_s) = (&mut simulation.instance, simulation.time_s);
        // What the scenario's last step chose stays, but for these.
        let (mut turned, mut last) = (0, [0.0; 3]);
        let ((), count) = counted(|| {
            for step in 0..4_000_u32 {
                let (sine, cosine) = (f64::from(step) * 1e-3).sin_cos();
                ok(instance.set_real(&position, &[4e6 * cosine, 3e5, 4e6 * sine]));
                ok(instance.set_real(&velocity, &[-2.3e3 * sine, 40.0, 2.3e3 * cosine]));
                ok(instance.set_input_derivatives(&position, &[1; 3], &[10.0, 20.0, -30.0]));
                if scenario == Scenario::Pointed {
                    ok(instance.set_integer(&scenario_input, &[1 + (step / 50 % 8) as i32]));
                }
                ok(instance.do_step(time_s, 0.7));
                time_s += 0.7;
                ok(instance.get_real(references[0], &mut reals));
                ok(instance.get_integer(references[1], &mut integers));
                ok(instance.get_boolean(references[2], &mut booleans));
                let mut now = [0.0; 3];
                ok(instance.get_real(&rate, &mut now));
                turned += i32::from(now != last);
                last = now;
            }
        });
        assert_eq!(count, Count::default(), "{scenario:?}");
        assert!(turned > 0, "{scenario:?}: nothing turned");
    }
}

/// Forecasts where downlinks begin, of the plant and of Guidance, by either convention.
#[test]
fn predictive_targets_allocate_nothing() {
    for model in ["MomentumPlant", "Guidance"] {
        for convention in [1, 2] {
            let names = names(model);
            let integer = |name: &str| names.typed(BaseType::Integer, name);
            let mut instance = silent(model);
            let choices = [
                integer("momentum.strategy"),
                integer("momentum.convention"),
                integer("guided.downlinkEvery"),
            ];
            ok(instance.set_integer(&choices, &[3, convention, 1]));
            let windows = [names.real("guided.downlinkStart"), names.real("guided.downlinkEnd")];
            ok(instance.set_real(&windows, &[100.0, 2_000.0]));
            let center = [names.real("spacecraft.centerOfMass[3]")];
            ok(instance.set_real(&center, &[0.05]));
            if model == "Guidance" {
                // On a circle whose period is about 3 h.
                ok(instance.set_integer(&[integer("pointing.scenario")], &[10]));
                ok(instance.set_real(&names.vector::<3>("position"), &[4e6, 0.0, 0.0]));
                ok(instance.set_real(&names.vector::<3>("velocity"), &[0.0, 0.0, 2.3e3]));
                ok(instance.set_real(&names.vector::<3>("momentum.body"), &[0.4, 0.0, -0.3]));
            }
            ok(instance.start(0.0, None));
            let sun = [names.real("sun.elevation")];
            let moves =
                (model == "Guidance").then(|| ["position", "velocity"].map(|name| names.vector::<3>(name)));
            let (mut time_s, mut last, mut chosen) = (0.0, [0.0], 0);
            let step_s = 500.0;
            let mut step = |instance: &mut InProcess, time_s: &mut f64| {
                if let Some([position, velocity]) = &moves {
                    let (sine, cosine) = (*time_s * 5.75e-4).sin_cos();
                    ok(instance.set_real(position, &[4e6 * cosine, 0.0, 4e6 * sine]));
                    ok(instance.set_real(velocity, &[-2.3e3 * sine, 0.0, 2.3e3 * cosine]));
                }
                ok(instance.do_step(*time_s, step_s));
                *time_s += step_s;
                let mut now = [0.0];
                ok(instance.get_real(&sun, &mut now));
                chosen += i32::from(now != last);
                last = now;
            };
            (0..400).for_each(|_| step(&mut instance, &mut time_s));
            let ((), count) = counted(|| (0..400).for_each(|_| step(&mut instance, &mut time_s)));
            assert_eq!(count, Count::default(), "{model} {convention}");
            assert!(chosen > 10, "{model} {convention}: {chosen}");
        }
    }
}

/// A MomentumPlant of this file.
fn with_file(text: &str) -> (InProcess, Names) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("spacecraft.toml"), text).unwrap();
    let description = LIBRARY
        .describe(LIBRARY.find("MomentumPlant").unwrap(), Some("spacecraft.toml"), Some(text))
        .unwrap();
    let location = format!("file://{}", folder.path().display());
    let instance = InProcess::instantiate(library("MomentumPlant"), &description.guid, Some(&location));
    (instance.unwrap(), Names::new(&description))
}

/// Surfaces that store heat, through eclipses; shadows of one another are left out, they may allocate.
#[test]
fn stored_heat_allocates_nothing() {
    let text = include_str!("../../fmu-src/resources/examples/mercury-orbiter.toml");
    let (mut instance, names) = with_file(&text.replace("\"shadowing.enabled\" = true\n", ""));
    ok(instance.set_debug_logging(false, &[]));
    Scenario::Lit.prepare(&mut instance, &names);
    ok(instance.start(0.0, None));
    let watched = [names.real("sun.litFraction"), names.real("force.thermal[2]")];
    let mut step = |number: u32| {
        let mut values = [0.0; 2];
        ok(instance.do_step(300.0 * f64::from(number), 300.0));
        ok(instance.get_real(&watched, &mut values));
        values
    };
    for number in 0..300 {
        step(number);
    }
    let mut dark = 0;
    let ((), count) = counted(|| {
        for number in 300..1_500 {
            let [lit, recoil_n] = step(number);
            dark += i32::from(lit == 0.0);
            assert!(recoil_n != 0.0);
        }
    });
    assert_eq!(count, Count::default());
    assert!(dark > 20, "{dark}");
}

/// Predictions of an encounter, whose forks carry the heat stored in surfaces along.
#[test]
fn predictions_allocate_nothing() {
    let text = include_str!("../../fmu-src/resources/examples/mercury-orbiter.toml");
    let (mut instance, names) = with_file(&text.replace("\"shadowing.enabled\" = true\n", ""));
    ok(instance.set_debug_logging(false, &[]));
    Scenario::Lit.prepare(&mut instance, &names);
    let integers = ["orbit.center", "orbit.source", "orbit.dynamics", "encounter.body", "ephemeris.source"]
        .map(|name| names.typed(BaseType::Integer, name));
    ok(instance.set_integer(&integers, &[2, 2, 3, 1, 1]));
    ok(instance.set_real(&names.vector::<3>("orbit.position"), &[5e10, 0.0, 0.0]));
    ok(instance.set_real(&names.vector::<3>("orbit.velocity"), &[0.0, 5e4, 5e3]));
    let reals = ["prediction.refresh", "prediction.horizon"].map(|name| names.real(name));
    ok(instance.set_real(&reals, &[3_600.0, 86_400.0]));
    ok(instance.start(0.0, None));
    let since = [names.real("prediction.since")];
    let mut since_s = [0.0];
    for number in 0..20 {
        ok(instance.do_step(1_200.0 * f64::from(number), 1_200.0));
    }
    let ((), count) = counted(|| {
        for number in 20..60 {
            ok(instance.do_step(1_200.0 * f64::from(number), 1_200.0));
        }
        ok(instance.get_real(&since, &mut since_s));
    });
    assert_eq!(count, Count::default());
    assert_eq!(since_s, [68_400.0]);
}

/// The memoryless model: Sun, planet, panels and mass placed anew before every step, through eclipses.
#[test]
fn placing_allocates_nothing() {
    let mut simulation = Simulation::new(Scenario::Placed);
    let names = simulation.names.clone();
    let (reals, booleans) = (names.all(BaseType::Real), names.all(BaseType::Boolean));
    let integers = names.all(BaseType::Integer);
    let planet = names.vector::<3>("planet.positionBody");
    let others = [
        names.real("sun.positionBody[1]"),
        names.real("panel[2].angle"),
        names.real("spacecraft.centerOfMass[3]"),
    ];
    let lit = names.real("sun.litFraction");
    let (mut values, mut switches) = (vec![0.0; reals.len()], vec![0; booleans.len()]);
    let mut choices = vec![0; integers.len()];
    (0..50).for_each(|_| simulation.step());
    let (mut instance, mut time_s) = (simulation.instance, simulation.time_s);
    let mut dark = 0;
    let ((), count) = counted(|| {
        for step in 0..4_000 {
            let (sin, cos) = (f64::from(step) * 0.01).sin_cos();
            ok(instance.set_real(&planet, &[5e6 * sin, -5e6 * cos, 1e5]));
            ok(instance.set_real(&others, &[1e9 * sin, cos, 0.1 * sin]));
            ok(instance.set_input_derivatives(&planet, &[1; 3], &[100.0 * cos, 100.0 * sin, 0.0]));
            ok(instance.do_step(time_s, 1.0));
            time_s += 1.0;
            ok(instance.get_real(reals, &mut values));
            ok(instance.get_integer(integers, &mut choices));
            ok(instance.get_boolean(booleans, &mut switches));
            let mut fraction = [1.0];
            ok(instance.get_real(&[lit], &mut fraction));
            dark += i32::from(fraction[0] == 0.0);
        }
    });
    assert_eq!(count, Count::default());
    assert!(dark > 100 && dark < 3_900, "{dark} of 4000 in eclipse");
}

#[test]
fn all_types_allocates_nothing() {
    let names = names("AllTypes");
    let mut instance = silent("AllTypes");
    ok(instance.start(0.0, None));
    let real = [names.real("input.real"), names.real("tunable.real")];
    let integer =
        [names.typed(BaseType::Integer, "input.integer"), names.typed(BaseType::Integer, "tunable.choice")];
    let boolean = [names.typed(BaseType::Boolean, "input.boolean")];
    let output = [names.real("output.real"), names.real("output.integral")];
    let (mut reals, mut integers, mut booleans) = ([0.0; 2], [0; 2], [0; 1]);
    let mut step = |number: u32| {
        let x = f64::from(number);
        ok(instance.set_real(&real, &[x, x % 10.0]));
        ok(instance
            .set_integer(&integer, &[(number % 900) as i32, if number.is_multiple_of(2) { 1 } else { 4 }]));
        ok(instance.set_boolean(&boolean, &[(number % 2) as i32]));
        ok(instance.set_input_derivatives(&real[..1], &[1], &[0.5]));
        ok(instance.do_step(0.5 * x, 0.5));
        ok(instance.get_real(&output, &mut reals));
        ok(instance.get_integer(&integer, &mut integers));
        ok(instance.get_boolean(&boolean, &mut booleans));
        ok(instance.get_output_derivatives(&output, &[1, 1], &mut reals));
        ok(instance.get_directional_derivative(&output[..1], &real[..1], &[1.0], &mut reals));
    };
    (0..3).for_each(&mut step);
    let ((), count) = counted(|| (3..1_000).for_each(&mut step));
    assert_eq!(count, Count::default());
}

/// The counter itself counts.
#[test]
fn an_allocation_is_seen() {
    let (kept, count) = counted(|| vec![0_u8; 1000]);
    assert_eq!(count, Count { allocations: 1, bytes: 1000, live_bytes: 1000 });
    drop(kept);
}
