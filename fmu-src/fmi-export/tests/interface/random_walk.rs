//! Random legal and illegal calls are answered as the standard's text says, state by state.

use client::{InProcess, StatePointer};
use fmi_export::Enumeration;
use fmi_export::model_description::Status::{self, Discard, Error, Ok, Warning};
use probe::panicking::Fault;

use super::{Random, fresh, reference};

/// States as the text of 4.2.4 names them; those that we never reach are left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum SpecifiedState {
    Instantiated,
    Initializing,
    Complete,
    Failed,
    Terminated,
    Erroneous,
}

/// What the text of 4.2.4 lists under each state, in its own order; common to all: `COMMON`.
fn listed(place: SpecifiedState) -> &'static [&'static str] {
    match place {
        SpecifiedState::Instantiated => {
            &["SetupExperiment", "EnterInitializationMode", "Set", "GetFMUstate", "InputDerivatives"]
        }
        SpecifiedState::Initializing => {
            &["ExitInitializationMode", "Get", "Set", "GetFMUstate", "Directional", "InputDerivatives"]
        }
        SpecifiedState::Complete => &[
            "DoStep",
            "Terminate",
            "Get",
            "Set",
            "GetFMUstate",
            "Directional",
            "InputDerivatives",
            "OutputDerivatives",
            "Status",
        ],
        SpecifiedState::Failed => {
            &["Terminate", "Get", "GetFMUstate", "Directional", "OutputDerivatives", "Status"]
        }
        SpecifiedState::Terminated => &["Get", "GetFMUstate", "Directional", "OutputDerivatives", "Status"],
        SpecifiedState::Erroneous => &["Get", "GetFMUstate", "Directional", "OutputDerivatives"],
    }
}

fn legal(place: SpecifiedState, call: &str) -> bool {
    COMMON.contains(&call) || listed(place).contains(&call)
}

const COMMON: &[&str] = &["SetDebugLogging", "Reset", "SetFMUstate", "Serialize"];

const CALLS: &[&str] = &[
    "SetupExperiment",
    "EnterInitializationMode",
    "ExitInitializationMode",
    "DoStep",
    "DoStep",
    "Terminate",
    "CancelStep",
    "Get",
    "Set",
    "GetFMUstate",
    "SetFMUstate",
    "Directional",
    "InputDerivatives",
    "OutputDerivatives",
    "Status",
    "SetDebugLogging",
    "Reset",
    "Serialize",
    "Advance",
];

/// What an observer who knows only the standard keeps in mind.
#[derive(Clone, Copy)]
struct Expected {
    place: SpecifiedState,
    experiment: bool,
    computed: bool,
    time_s: f64,
}

const FRESH: Expected =
    Expected { place: SpecifiedState::Instantiated, experiment: false, computed: false, time_s: 0.0 };

struct Walk {
    instance: InProcess,
    expected: Expected,
    saved: Option<Expected>,
    state: StatePointer,
    fault: u32,
    output: u32,
    input: u32,
    random: Random,
    visits: [usize; 6],
}

impl Walk {
    /// Makes a call and says what it answered and what it had to answer if it was legal.
    fn call(&mut self, call: &str) -> (Status, Status) {
        let (instance, expected) = (&mut self.instance, &mut self.expected);
        match call {
            "SetupExperiment" => {
                let status = instance.setup_experiment(0.0, None);
                expected.experiment |= expected.place == SpecifiedState::Instantiated;
                (status, Ok)
            }
            "EnterInitializationMode" => {
                (instance.enter_initialization_mode(), if expected.experiment { Ok } else { Error })
            }
            "ExitInitializationMode" => (instance.exit_initialization_mode(), Ok),
            "DoStep" => {
                let ends = self.random.below(4) == 0;
                let fault = if ends { Fault::TerminateStep } else { Fault::Nowhere };
                if expected.place == SpecifiedState::Complete {
                    assert_eq!(instance.set_integer(&[self.fault], &[fault.value()]), Ok);
                }
                (instance.do_step(expected.time_s, 0.5), if ends { Discard } else { Ok })
            }
            "Terminate" => (instance.terminate(), Ok),
            "CancelStep" => (instance.cancel_step(), Ok),
            // Leniency: no reference is of a variable without start value.
            "Get" if expected.place == SpecifiedState::Instantiated => {
                assert_eq!(instance.get_real(&[self.input], &mut [0.0]), Warning);
                assert_eq!(instance.get_boolean(&[], &mut []), Warning);
                (instance.get_real(&[self.output], &mut [0.0]), Error)
            }
            "Get" => match self.random.below(4) {
                0 => {
                    expected.computed |= expected.place == SpecifiedState::Initializing;
                    (instance.get_real(&[self.output], &mut [0.0]), Ok)
                }
                1 => (instance.get_integer(&[], &mut []), Ok),
                2 => (instance.get_boolean(&[], &mut []), Ok),
                _ => (instance.get_string(&[]).0, Ok),
            },
            "Set" => match self.random.below(4) {
                // Fault is a tunable parameter: settable wherever anything is.
                0 => (instance.set_integer(&[self.fault], &[Fault::Nowhere.value()]), Ok),
                1 => (instance.set_real(&[], &[]), Ok),
                2 => (instance.set_boolean(&[], &[]), Ok),
                _ => (instance.set_string(&[], &[]), Ok),
            },
            "GetFMUstate" => (instance.get_state(&mut self.state), Ok),
            "SetFMUstate" => (instance.set_state(&self.state), if self.saved.is_some() { Ok } else { Error }),
            "Serialize" => {
                let (status, bytes) = instance.serialize(&self.state);
                if status != Ok {
                    return (status, if self.saved.is_some() { Ok } else { Error });
                }
                let (status, decoded) = instance.deserialize(&bytes);
                drop(decoded);
                (status, Ok)
            }
            "Directional" | "OutputDerivatives" => {
                // In Initialization Mode asking for it computes it.
                expected.computed |= expected.place == SpecifiedState::Initializing && call == "Directional";
                let computed = expected.computed;
                let status = match call {
                    "Directional" => {
                        instance.get_directional_derivative(&[self.output], &[self.input], &[1.0], &mut [0.0])
                    }
                    _ => instance.get_output_derivatives(&[self.output], &[1], &mut [0.0]),
                };
                (status, if computed { Ok } else { Error })
            }
            "InputDerivatives" => (instance.set_input_derivatives(&[self.input], &[1], &[1.0]), Ok),
            "Status" => match self.random.below(3) {
                0 => (instance.get_status(0), Discard),
                1 => (instance.last_successful_time().0, Ok),
                _ => (instance.terminated().0, Ok),
            },
            "SetDebugLogging" => (instance.set_debug_logging(false, &[]), Ok),
            "Reset" => (instance.reset(), Ok),
            other => panic!("{other}"),
        }
    }

    fn go(&mut self, call: &'static str) {
        let before = self.expected;
        let (status, if_legal) = self.call(call);
        let expected = if legal(before.place, call) { if_legal } else { Error };
        assert_eq!(status, expected, "{call} in {:?}", before.place);
        self.follow(call, status, before);
        self.visits[self.expected.place as usize] += 1;
        self.instance.drain_messages();
    }

    fn follow(&mut self, call: &str, status: Status, before: Expected) {
        let expected = &mut self.expected;
        match (call, status) {
            ("Reset", _) => *expected = FRESH,
            ("SetFMUstate", Ok) => *expected = self.saved.unwrap(),
            ("GetFMUstate", Ok) => self.saved = Some(before),
            (_, Error) => expected.place = SpecifiedState::Erroneous,
            ("DoStep", Discard) => expected.place = SpecifiedState::Failed,
            ("DoStep", Ok) => expected.time_s += 0.5,
            ("EnterInitializationMode", _) => expected.place = SpecifiedState::Initializing,
            ("ExitInitializationMode", _) => {
                (expected.place, expected.computed) = (SpecifiedState::Complete, true)
            }
            ("Terminate", _) => expected.place = SpecifiedState::Terminated,
            _ => {}
        }
    }
}

#[test]
fn two_hundred_thousand_random_calls() {
    let (instance, description) = fresh("Panicking");
    let at = |name| reference(&description, name);
    let (fault, output, input) = (at("fault"), at("output"), at("input"));
    let mut walk = Walk {
        instance,
        expected: FRESH,
        saved: None,
        state: StatePointer::null(),
        fault,
        output,
        input,
        random: Random(2026),
        visits: [0; 6],
    };
    for _ in 0..200_000 {
        match CALLS[walk.random.below(CALLS.len())] {
            // The legal way on, or pure chance would seldom leave the error state.
            "Advance" => match walk.expected.place {
                SpecifiedState::Instantiated => {
                    walk.go("SetupExperiment");
                    walk.go("EnterInitializationMode");
                }
                SpecifiedState::Initializing => walk.go("ExitInitializationMode"),
                SpecifiedState::Complete => walk.go("DoStep"),
                _ => walk.go("Reset"),
            },
            // Most illegal calls are left out, for each costs the way back.
            call if !legal(walk.expected.place, call) && walk.random.below(12) > 0 => {}
            call => walk.go(call),
        }
    }
    assert!(walk.visits.iter().all(|&visits| visits > 1000), "{:?}", walk.visits);
}
