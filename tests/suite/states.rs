//! A saved state continues as if nothing had happened: in the same instance, after Reset, in another instance and
//! in another process, to the bit.

use std::fmt::Write as _;
use std::path::Path;

use client::{InProcess, Names, StatePointer, short_or_long};
use model_description::{
    BaseType, Causality, Description, ScalarVariable, SimpleTypeKind, Status, Variability, VariableKind,
};

use crate::scenarios::{Scenario, Simulation};
use crate::support::{
    self, Everything, RandomNumbers, everything, fresh, in_a_process_of_its_own, names, ok, silent,
};

const POINTS: usize = 12;
const STEPS: u64 = 50;

/// Step and time at which a state was saved.
#[derive(Clone, Copy)]
struct SavedPoint {
    step_number: u64,
    time_s: f64,
}

/// All that a master can see after each of the steps that follow a restored state, as text.
fn onward(instance: InProcess, scenario: Scenario, place: SavedPoint) -> (String, InProcess) {
    let SavedPoint { step_number, time_s } = place;
    let mut simulation =
        Simulation { instance, names: names(scenario.model()), scenario, step_number, time_s };
    let mut seen = String::new();
    for _ in 0..STEPS {
        simulation.step();
        writeln!(seen, "{:?}", everything(&mut simulation.instance, &simulation.names)).unwrap();
    }
    (seen, simulation.instance)
}

fn restored(mut instance: InProcess, bytes: &[u8]) -> InProcess {
    let (status, state) = instance.deserialize(bytes);
    ok(status);
    ok(instance.set_state(&state));
    instance
}

/// Length of a simulation, in s: the plant's 90 days, the spinner's burn and what follows, some hundred geometries.
fn length_s(scenario: Scenario) -> f64 {
    match scenario.model() {
        "MomentumPlant" if scenario.steps_s()[0] < 60.0 => 300.0,
        "MomentumPlant" => 90.0 * 86_400.0,
        _ => 3_000.0,
    }
}

fn saved_simulations_go_on(scenario: Scenario, child_test: &str) {
    let mut random = RandomNumbers(scenario as u64 + 7);
    let mut times_s: Vec<f64> = (0..POINTS).map(|_| length_s(scenario) * random.unit()).collect();
    times_s.sort_by(f64::total_cmp);
    let folder = tempfile::tempdir().unwrap();
    let mut simulation = Simulation::new(scenario);
    let mut elsewhere = Vec::new();
    for (number, until_s) in times_s.iter().enumerate() {
        while simulation.time_s < *until_s {
            simulation.step();
        }
        let place = SavedPoint { step_number: simulation.step_number, time_s: simulation.time_s };
        let mut state = StatePointer::null();
        ok(simulation.instance.get_state(&mut state));
        let (status, bytes) = simulation.instance.serialize(&state);
        ok(status);
        let (straight, mut instance) = onward(simulation.instance, scenario, place);
        ok(instance.set_state(&state));
        let (again, mut instance) = onward(instance, scenario, place);
        assert!(again == straight, "{scenario:?} at {until_s} s: the same instance");
        ok(instance.reset());
        let (after_reset, instance) = onward(restored(instance, &bytes), scenario, place);
        assert!(after_reset == straight, "{scenario:?} at {until_s} s: after Reset");
        let (other, _) = onward(restored(fresh(scenario.model()), &bytes), scenario, place);
        assert!(other == straight, "{scenario:?} at {until_s} s: another instance");
        std::fs::write(folder.path().join(format!("{number}.state")), &bytes).unwrap();
        std::fs::write(
            folder.path().join(format!("{number}.place")),
            format!("{} {}", place.step_number, place.time_s),
        )
        .unwrap();
        elsewhere.push(straight);
        // The simulation itself continues from the saved point.
        simulation.instance = restored(instance, &bytes);
    }
    in_a_process_of_its_own(child_test, CHILD_FOLDER, folder.path().as_os_str());
    for (number, straight) in elsewhere.iter().enumerate() {
        let seen = std::fs::read_to_string(folder.path().join(format!("{number}.seen"))).unwrap();
        assert!(seen == *straight, "{scenario:?} point {number}: another process");
    }
}

const CHILD_FOLDER: &str = "HELIOTORQUE_TEST_STATES";

/// Runs in the other process.
fn child(scenario: Scenario, folder: &Path) {
    for number in 0..POINTS {
        let read = |kind: &str| std::fs::read(folder.join(format!("{number}.{kind}"))).unwrap();
        let place = String::from_utf8(read("place")).unwrap();
        let (step_number, time_s) = place.split_once(' ').unwrap();
        let place = SavedPoint { step_number: step_number.parse().unwrap(), time_s: time_s.parse().unwrap() };
        let (seen, _) = onward(restored(fresh(scenario.model()), &read("state")), scenario, place);
        std::fs::write(folder.join(format!("{number}.seen")), seen).unwrap();
    }
}

fn in_this_process_and_another(scenario: Scenario, test: &str) {
    match std::env::var_os(CHILD_FOLDER) {
        Some(folder) => child(scenario, Path::new(&folder)),
        None => saved_simulations_go_on(scenario, test),
    }
}

#[test]
fn a_guided_simulation_goes_on_from_any_saved_point() {
    in_this_process_and_another(Scenario::Guided, "states::a_guided_simulation_goes_on_from_any_saved_point");
}

#[test]
fn a_commanded_simulation_goes_on_from_any_saved_point() {
    in_this_process_and_another(
        Scenario::Commanded,
        "states::a_commanded_simulation_goes_on_from_any_saved_point",
    );
}

#[test]
fn a_lit_simulation_goes_on_from_any_saved_point() {
    in_this_process_and_another(Scenario::Lit, "states::a_lit_simulation_goes_on_from_any_saved_point");
}

#[test]
fn a_controlled_simulation_goes_on_from_any_saved_point() {
    in_this_process_and_another(
        Scenario::Controlled,
        "states::a_controlled_simulation_goes_on_from_any_saved_point",
    );
}

#[test]
fn a_free_simulation_goes_on_from_any_saved_point() {
    in_this_process_and_another(Scenario::Free, "states::a_free_simulation_goes_on_from_any_saved_point");
}

#[test]
fn a_burn_goes_on_from_any_saved_point() {
    in_this_process_and_another(Scenario::Burning, "states::a_burn_goes_on_from_any_saved_point");
}

#[test]
fn a_memoryless_model_goes_on_from_any_saved_point() {
    in_this_process_and_another(Scenario::Placed, "states::a_memoryless_model_goes_on_from_any_saved_point");
}

#[test]
fn a_pointed_guidance_goes_on_from_any_saved_point() {
    in_this_process_and_another(Scenario::Pointed, "states::a_pointed_guidance_goes_on_from_any_saved_point");
}

#[test]
fn a_safed_guidance_goes_on_from_any_saved_point() {
    in_this_process_and_another(Scenario::Safed, "states::a_safed_guidance_goes_on_from_any_saved_point");
}

#[test]
fn an_orbiting_guidance_goes_on_from_any_saved_point() {
    in_this_process_and_another(
        Scenario::Orbiting,
        "states::an_orbiting_guidance_goes_on_from_any_saved_point",
    );
}

#[test]
fn a_fired_spinner_goes_on_from_any_saved_point() {
    in_this_process_and_another(Scenario::Fired, "states::a_fired_spinner_goes_on_from_any_saved_point");
}

/// Steps of a simulation before something changes.
const STEPS_BEFORE: u64 = 9;

/// Whether a master may set a variable between steps.
fn may_change(variable: &ScalarVariable) -> bool {
    match variable.causality {
        Causality::Input => true,
        Causality::Parameter => variable.variability == Variability::Tunable,
        _ => false,
    }
}

/// A value of an input or tunable parameter.
#[derive(Clone, Copy, Debug)]
enum Given {
    Real(f64),
    Integer(i32),
    Boolean(i32),
}

impl Given {
    fn set(self, instance: &mut InProcess, reference: u32) {
        ok(match self {
            Self::Real(value) => instance.set_real(&[reference], &[value]),
            Self::Integer(value) => instance.set_integer(&[reference], &[value]),
            Self::Boolean(value) => instance.set_boolean(&[reference], &[value]),
        });
    }

    /// Allowed values other than the present one of a variable that may change between steps: the other items, a number far off.
    fn others(description: &Description, variable: &ScalarVariable, instance: &mut InProcess) -> Vec<Self> {
        let reference = [variable.value_reference];
        let (mut real, mut integer, mut boolean) = ([0.0], [0], [0]);
        match &variable.kind {
            VariableKind::Real { attributes, .. } => {
                ok(instance.get_real(&reference, &mut real));
                let far = if real[0] == 0.0 { 1.0 } else { -0.5 * real[0] };
                let far = far.clamp(attributes.min.unwrap_or(f64::MIN), attributes.max.unwrap_or(f64::MAX));
                Some(far).filter(|far| *far != real[0]).map(Self::Real).into_iter().collect()
            }
            VariableKind::Integer { .. } => {
                ok(instance.get_integer(&reference, &mut integer));
                vec![Self::Integer(integer[0] + 1)]
            }
            VariableKind::Enumeration { declared_type, .. } => {
                ok(instance.get_integer(&reference, &mut integer));
                let declared = description.types.iter().find(|it| it.name == *declared_type).unwrap();
                let SimpleTypeKind::Enumeration { items, .. } = &declared.kind else { panic!() };
                let others = items.iter().map(|item| item.value).filter(|value| *value != integer[0]);
                others.map(Self::Integer).collect()
            }
            VariableKind::Boolean { .. } => {
                ok(instance.get_boolean(&reference, &mut boolean));
                vec![Self::Boolean(1 - boolean[0])]
            }
            VariableKind::String { .. } => Vec::new(),
        }
    }
}

/// Outcome of each of two steps from `place` on, with all that a master can see after one that went well.
fn two_steps(
    instance: &mut InProcess,
    (names, step_s): (&Names, f64),
    place: SavedPoint,
) -> [(Status, Option<Everything>); 2] {
    [0.0, 1.0].map(|k| {
        let status = instance.do_step(place.time_s + k * step_s, step_s);
        (status, (status == Status::Ok).then(|| everything(instance, names)))
    })
}

/// Every input and tunable parameter set to another value right after the state was restored from bytes in an instance in which
/// nothing was set before, or right before it was saved: the bits of the simulation that was never saved.
#[test]
fn a_change_next_to_a_restore_acts_as_in_a_simulation_never_saved() {
    for scenario in Scenario::ALL {
        let model = scenario.model();
        let description = support::description(model);
        let mut simulation = Simulation::new(scenario);
        let (names, step_s) = (simulation.names.clone(), scenario.steps_s()[0]);
        let two_steps = |instance: &mut InProcess, place| two_steps(instance, (&names, step_s), place);
        simulation.begin_again(STEPS_BEFORE);
        let bytes = simulation.bytes();
        let place = SavedPoint { step_number: simulation.step_number, time_s: simulation.time_s };
        let mut elsewhere = silent(model);
        // Reset is a fresh instance to the byte.
        let anew = |mut instance: InProcess| {
            ok(instance.reset());
            short_or_long(Some(instance), None).unwrap_or_else(|| silent(model))
        };
        let (mut count, mut failed) = (0, 0);
        for variable in description.variables.iter().filter(|it| may_change(it)) {
            let reference = variable.value_reference;
            for given in Given::others(&description, variable, &mut simulation.instance) {
                given.set(&mut simulation.instance, reference);
                let changed_bytes = simulation.bytes();
                simulation.begin_again(STEPS_BEFORE);
                given.set(&mut simulation.instance, reference);
                let straight = two_steps(&mut simulation.instance, place);
                let mut set_after = restored(anew(elsewhere), &bytes);
                given.set(&mut set_after, reference);
                let after = two_steps(&mut set_after, place);
                let mut set_before = restored(anew(set_after), &changed_bytes);
                let before = two_steps(&mut set_before, place);
                let name = &variable.name;
                assert!(after == straight, "{scenario:?}: {name} = {given:?} after the restore");
                assert!(before == straight, "{scenario:?}: {name} = {given:?} before it was saved");
                (count, failed) = (count + 1, failed + u32::from(straight[1].0 != Status::Ok));
                elsewhere = set_before;
                simulation.begin_again(STEPS_BEFORE);
            }
        }
        assert!(count > 30 && 10 * failed < count, "{scenario:?}: {failed} of {count} failed");
    }
}

/// Time, values, derivatives, model state, history: Reset leaves none of them.
#[test]
fn reset_is_a_fresh_instance_to_the_byte() {
    for scenario in Scenario::ALL {
        let mut simulation = Simulation::new(scenario);
        (0..200).for_each(|_| simulation.step());
        ok(simulation.instance.reset());
        assert_eq!(simulation.bytes(), fresh(scenario.model()).state_bytes().1);
        // And it runs like one.
        let mut fresh_simulation = Simulation::new(scenario);
        simulation.begin_again(0);
        for _ in 0..50 {
            simulation.step();
            fresh_simulation.step();
            assert_eq!(simulation.bytes(), fresh_simulation.bytes());
        }
    }
}

#[test]
fn reset_is_a_fresh_instance_from_every_mode() {
    for model in ["Empty", "AllTypes", "Panicking"] {
        let expected = fresh(model).state_bytes();
        let stages: [fn(&mut InProcess); 5] = [
            |instance| ok(instance.setup_experiment(3.0, Some(9.0))),
            |instance| ok(instance.enter_initialization_mode()),
            |instance| ok(instance.exit_initialization_mode()),
            |instance| ok(instance.do_step(3.0, 0.5)),
            |instance| ok(instance.terminate()),
        ];
        for last in 0..stages.len() {
            let mut instance = fresh(model);
            stages[..=last].iter().for_each(|stage| stage(&mut instance));
            ok(instance.reset());
            assert_eq!(instance.state_bytes(), expected, "{model} after stage {last}");
        }
        // Out of the error state.
        let mut instance = fresh(model);
        assert_ne!(instance.terminate(), model_description::Status::Ok);
        ok(instance.reset());
        assert_eq!(instance.state_bytes(), expected, "{model} after an error");
    }
    let names = support::names("AllTypes");
    let mut instance = fresh("AllTypes");
    let expected = instance.state_bytes();
    ok(instance.set_string(&[names.typed(BaseType::String, "tunable.text")], &[b"other"]));
    ok(instance.start(0.0, None));
    ok(instance.set_real(&[names.real("input.real")], &[2.0]));
    ok(instance.set_input_derivatives(&[names.real("input.real")], &[1], &[2.0]));
    ok(instance.do_step(0.0, 1.0));
    ok(instance.set_boolean(&[names.typed(BaseType::Boolean, "input.boolean")], &[1]));
    ok(instance.reset());
    assert_eq!(instance.state_bytes(), expected);
}
