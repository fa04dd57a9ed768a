//! Any sequence of calls, legal or not, is answered by the standard's call table.

mod master;
mod strategies;
mod table;
mod variables;

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use client::{InProcess, Message, StatePointer};
use model_description::{BaseType, Status};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngSeed, TestRunner};
use proptest_state_machine::{ReferenceStateMachine, StateMachineTest};

use crate::support;
use master::{Answer, Call, Master, Misprint, Picked};
use variables::{Value, references};

/// Calls in a long run, a third of them in a short one; `HELIOTORQUE_CALLS` sets another number.
const CALLS: u64 = 1_000_000;
const LONGEST_SEQUENCE: usize = 300;

impl ReferenceStateMachine for Master {
    type State = Self;
    type Transition = Call;

    fn init_state() -> BoxedStrategy<Self> {
        Just(Self::new()).boxed()
    }

    fn transitions(state: &Self) -> BoxedStrategy<Call> {
        strategies::next(state.now.state)
    }

    fn apply(mut state: Self, call: &Call) -> Self {
        state.call(call);
        state
    }
}

/// An instance with the states its master keeps.
struct Subject {
    instance: InProcess,
    slots: [StatePointer; 2],
    bytes: Vec<u8>,
    /// Calls made, by function and state.
    made: Made,
}

type Made = BTreeMap<(&'static str, char), u64>;

static MADE: Mutex<Made> = Mutex::new(Made::new());

impl Drop for Subject {
    fn drop(&mut self) {
        let mut all = MADE.lock().unwrap_or_else(PoisonError::into_inner);
        for (cell, count) in &self.made {
            *all.entry(*cell).or_default() += count;
        }
    }
}

fn reference(picked: &Picked) -> u32 {
    match *picked {
        Picked::Row(row) => references()[row],
        Picked::Unknown(reference) => reference,
    }
}

fn real_of(name: &str) -> u32 {
    references()[variables::position(name)]
}

impl Subject {
    fn new() -> Self {
        Self {
            instance: support::fresh("AllTypes"),
            slots: [StatePointer::null(), StatePointer::null()],
            bytes: Vec::new(),
            made: Made::new(),
        }
    }

    fn get(&mut self, base: BaseType, picked: &[Picked]) -> (Status, Vec<Value>) {
        let references: Vec<u32> = picked.iter().map(reference).collect();
        let (mut reals, mut integers) = (vec![f64::NAN; picked.len()], vec![i32::MIN; picked.len()]);
        let instance = &mut self.instance;
        match base {
            BaseType::Real => {
                let status = instance.get_real(&references, &mut reals);
                (status, reals.into_iter().map(Value::Real).collect())
            }
            BaseType::Integer => {
                let status = instance.get_integer(&references, &mut integers);
                (status, integers.into_iter().map(Value::Integer).collect())
            }
            BaseType::Boolean => {
                let status = instance.get_boolean(&references, &mut integers);
                (status, integers.into_iter().map(Value::Boolean).collect())
            }
            BaseType::String => {
                let (status, texts) = instance.get_string(&references);
                // Values are compared with static texts; few differ.
                (status, texts.into_iter().map(|text| Value::Text(known(&text))).collect())
            }
        }
    }

    fn set(&mut self, base: BaseType, expected: &[(Picked, Value)]) -> Status {
        let references: Vec<u32> = expected.iter().map(|(picked, _)| reference(picked)).collect();
        let values = expected.iter().map(|(_, value)| value);
        match base {
            BaseType::Real => {
                let values: Vec<f64> =
                    values.map(|it| if let Value::Real(it) = it { *it } else { 0.0 }).collect();
                self.instance.set_real(&references, &values)
            }
            BaseType::Integer => {
                let values: Vec<i32> =
                    values.map(|it| if let Value::Integer(it) = it { *it } else { 0 }).collect();
                self.instance.set_integer(&references, &values)
            }
            BaseType::Boolean => {
                let values: Vec<i32> =
                    values.map(|it| if let Value::Boolean(it) = it { *it } else { 0 }).collect();
                self.instance.set_boolean(&references, &values)
            }
            BaseType::String => {
                let bytes = |value: &Value| match *value {
                    Value::Text(text) => text.as_bytes(),
                    _ => b"\xFF\xFE".as_slice(),
                };
                let values: Vec<&[u8]> = values.map(bytes).collect();
                self.instance.set_string(&references, &values)
            }
        }
    }

    /// Makes the call; the status and what was read.
    fn call(&mut self, call: &Call, before: Before) -> (Status, Vec<Value>) {
        let Before { state, time_s } = before;
        *self.made.entry((master::function(call), state)).or_default() += 1;
        let instance = &mut self.instance;
        let mut number = [f64::NAN];
        let status = match call {
            Call::SetDebugLogging(on) => instance.set_debug_logging(*on, &[]),
            Call::SetupExperiment { start_s, stop_s } => instance.setup_experiment(*start_s, *stop_s),
            Call::EnterInitializationMode => instance.enter_initialization_mode(),
            Call::ExitInitializationMode => instance.exit_initialization_mode(),
            Call::Terminate => instance.terminate(),
            Call::Reset => instance.reset(),
            Call::Replace => {
                self.instance = support::fresh("AllTypes");
                Status::Ok
            }
            Call::Get(base, picked) => return self.get(*base, picked),
            Call::Set(base, expected) => self.set(*base, expected),
            Call::GetState(slot) => instance.get_state(&mut self.slots[*slot]),
            Call::SetState(slot) => instance.set_state(&self.slots[*slot]),
            Call::FreeState(slot) => instance.free_state(&mut self.slots[*slot]),
            Call::Serialize(slot) => {
                let (status, bytes) = instance.serialize(&self.slots[*slot]);
                if status == Status::Ok {
                    self.bytes = bytes;
                }
                status
            }
            Call::Deserialize(slot) => {
                let (status, state) = instance.deserialize(&self.bytes);
                if status == Status::Ok {
                    self.slots[*slot] = state;
                }
                status
            }
            Call::SetInputDerivative { known, order, value } => {
                let reference = real_of(if *known { "input.real" } else { "tunable.real" });
                instance.set_input_derivatives(&[reference], &[*order], &[*value])
            }
            Call::GetOutputDerivative { known, order } => {
                let reference = real_of(if *known { "output.real" } else { "input.real" });
                instance.get_output_derivatives(&[reference], &[*order], &mut number)
            }
            Call::DirectionalDerivative { known, seed } => {
                let unknown = real_of(if *known { "output.real" } else { "parameter.real" });
                instance.get_directional_derivative(
                    &[unknown],
                    &[real_of("input.real")],
                    &[*seed],
                    &mut number,
                )
            }
            Call::DoStep { step_s, off_s, no_return: false } => instance.do_step(time_s + off_s, *step_s),
            Call::DoStep { step_s, off_s, no_return: true } => {
                instance.do_step_without_return(time_s + off_s, *step_s)
            }
            Call::CancelStep => instance.cancel_step(),
            Call::GetStatus(kind) => instance.get_status(*kind),
            Call::GetIntegerStatus(kind) => instance.get_integer_status(*kind),
            Call::GetStringStatus(kind) => instance.get_string_status(*kind),
            Call::LastSuccessfulTime => {
                let (status, value) = instance.last_successful_time();
                number[0] = value;
                status
            }
            Call::Terminated => {
                let (status, value) = instance.terminated();
                number[0] = f64::from(u8::from(value));
                status
            }
        };
        (status, number.map(Value::Real).to_vec())
    }
}

fn known(text: &str) -> &'static str {
    let starts = variables::VARIABLES.iter().filter_map(|variable| match variable.start {
        Value::Text(text) => Some(text),
        _ => None,
    });
    let set = ["a", "100 % #1#", "Ωμέγα", "a rather long text, longer than the others"];
    set.into_iter().chain(starts).find(|it| *it == text).unwrap_or("a text nobody set")
}

/// State and time of the reference before a call.
#[derive(Clone, Copy)]
struct Before {
    state: char,
    time_s: f64,
}

impl Before {
    fn new(master: &Master) -> Self {
        Self { state: master.now.state, time_s: master.time_s() }
    }
}

/// Whether an instance answered as the reference did, and logged the reason of a refusal.
fn compare(
    master: &Master,
    call: &Call,
    (status, values): &(Status, Vec<Value>),
    messages: &[Message],
) -> Result<(), String> {
    let expected = match master.answer {
        Answer::Ok | Answer::Values(_) | Answer::Number(_) => Status::Ok,
        Answer::Warned(_) => Status::Warning,
        Answer::Discard => Status::Discard,
        Answer::Error => Status::Error,
    };
    let complain = |what: String| Err(format!("{call:?}, now in {}: {what}", master.now.state));
    if *status != expected {
        return complain(format!("{status:?} not {expected:?}"));
    }
    let wrong = match &master.answer {
        Answer::Values(expected) | Answer::Warned(expected) => expected
            .iter()
            .zip(values)
            .any(|(expected, found)| expected.is_some_and(|expected| expected != *found)),
        Answer::Number(expected) => *values != [Value::Real(*expected)],
        _ => false,
    };
    if wrong {
        return complain(format!("{values:?} not {:?}", master.answer));
    }
    // 2.1.5: the logger is called before anything but OK is returned.
    let logged = messages.iter().any(|message| message.status == *status);
    let must_log = matches!(status, Status::Warning | Status::Error);
    if (must_log || (*status == Status::Discard && master.logging)) && !logged {
        return complain(format!("{status:?} without a message"));
    }
    if messages.iter().any(|message| message.text.contains("panic")) {
        return complain(format!("{messages:?}"));
    }
    Ok(())
}

/// The sequence under test.
struct Sequence {
    subject: Subject,
    before: Before,
}

impl StateMachineTest for Sequence {
    type SystemUnderTest = Self;
    type Reference = Master;

    fn init_test(master: &Master) -> Self {
        Self { subject: Subject::new(), before: Before::new(master) }
    }

    fn apply(mut sequence: Self, master: &Master, call: Call) -> Self {
        let answer = sequence.subject.call(&call, sequence.before);
        let messages = sequence.subject.instance.drain_messages();
        compare(master, &call, &answer, &messages).unwrap_or_else(|message| panic!("{message}"));
        sequence.before = Before::new(master);
        sequence
    }

    fn check_invariants(_: &Self, _: &Master) {}
}

/// Functions of the table that the sequences call on their own.
fn walked() -> impl Iterator<Item = &'static str> {
    let needs_no_instance = ["GetTypesPlatform", "GetVersion"];
    // Made before every `fmi2SerializeFMUstate`.
    let never_alone = ["SerializedFMUstateSize"];
    table::functions()
        .filter(move |function| !needs_no_instance.contains(function) && !never_alone.contains(function))
}

/// States that an FMU without asynchronous steps can be in.
const WALKED: &str = "IMCFTE";

#[test]
fn any_sequence_of_calls_is_answered_by_the_table() {
    let usual = client::short_or_long(CALLS / 3, CALLS);
    let expected = std::env::var("HELIOTORQUE_CALLS").ok().and_then(|it| it.parse().ok()).unwrap_or(usual);
    let made = || MADE.lock().unwrap_or_else(PoisonError::into_inner);
    let mut batch = 0;
    while made().values().sum::<u64>() < expected {
        let mut config = Config { cases: 500, failure_persistence: None, ..Config::default() };
        if let RngSeed::Fixed(seed) = config.rng_seed {
            config.rng_seed = RngSeed::Fixed(seed.wrapping_add(batch));
        }
        batch += 1;
        let sequences = Master::sequential_strategy(1..LONGEST_SEQUENCE);
        TestRunner::new(config.clone())
            .run(&sequences, |(initial, calls, seen)| {
                Sequence::test_sequential(config.clone(), initial, calls, seen);
                Ok(())
            })
            .unwrap_or_else(|failure| panic!("{failure}"));
    }
    // Every cell was tried.
    let made = made();
    for function in walked() {
        for state in WALKED.chars() {
            let count = made.get(&(function, state)).copied().unwrap_or_default();
            assert!(count >= expected / 200_000, "{function} was called {count} times in {state}");
        }
    }
}

/// Calls until an instance answers otherwise than a reference with a broken table, if ever.
fn calls_until_noticed(misprint: Misprint, runner: &mut TestRunner) -> Option<u64> {
    let mut calls = 0;
    while calls < 10 * CALLS {
        let (mut master, mut subject) = (Master::misled(misprint), Subject::new());
        let mut noticed = false;
        for _ in 0..LONGEST_SEQUENCE {
            let call = strategies::next(master.now.state).new_tree(runner).unwrap().current();
            let before = Before::new(&master);
            master.call(&call);
            let answer = subject.call(&call, before);
            calls += 1;
            noticed = compare(&master, &call, &answer, &subject.instance.drain_messages()).is_err();
            if noticed {
                break;
            }
        }
        // These are not the calls that are counted for the right table.
        subject.made.clear();
        if noticed {
            return Some(calls);
        }
    }
    None
}

/// The walk above finds a cell that is broken, whichever it is.
#[test]
fn every_broken_cell_is_noticed() {
    let mut runner = TestRunner::new(Config { failure_persistence: None, ..Config::default() });
    // A step that is never pending cannot be cancelled, and there is no derivative before anything was computed: errors
    // in any case.
    let alike = |function, state| {
        let derivative = ["GetDirectionalDerivative", "GetRealOutputDerivatives"].contains(&function);
        function == "CancelStep" || (derivative && state == 'I')
    };
    let flipped = |function: &'static str, state| {
        let set = ["SetReal", "SetInteger", "SetBoolean", "SetString"].contains(&function);
        let cell = if table::cell(function, state) != '.' {
            '.'
        } else if set {
            '6'
        } else {
            'x'
        };
        Misprint { function, state, cell }
    };
    let notes = [('I', '3'), ('I', '6'), ('M', '1'), ('M', '6'), ('C', '1'), ('C', '3')];
    let mut misprints = notes.map(|(state, cell)| Misprint { function: "SetReal", state, cell }).to_vec();
    for function in walked() {
        let states = WALKED.chars().filter(|state| !alike(function, *state));
        misprints.extend(states.map(|state| flipped(function, state)));
    }
    let every = client::short_or_long(8, 1);
    for misprint in misprints.into_iter().step_by(every) {
        assert!(calls_until_noticed(misprint, &mut runner).is_some(), "{misprint:?} was not noticed");
    }
}
