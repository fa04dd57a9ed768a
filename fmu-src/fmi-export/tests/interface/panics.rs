//! A panic in any callback ends its instance with an error and a message; other instances go on.

use client::{InProcess, StatePointer};
use fmi_export::Enumeration;
use fmi_export::model_description::Status::{self, Error, Ok};
use probe::panicking::Fault;

use super::{reference, started};

fn with_fault(fault: Fault) -> InProcess {
    let (mut instance, description) = started("Panicking");
    assert_eq!(instance.set_integer(&[reference(&description, "fault")], &[fault.value()]), Ok);
    instance
}

/// The worst status of a run that touches every callback; stops at the first error.
fn run(instance: &mut InProcess, output: u32, input: u32) -> Status {
    let mut state = StatePointer::null();
    let mut bytes = Vec::new();
    let calls: [&mut dyn FnMut(&mut InProcess) -> Status; 8] = [
        &mut |it| it.do_step(0.0, 1.0),
        &mut |it| it.get_output_derivatives(&[output], &[1], &mut [0.0]),
        &mut |it| it.get_directional_derivative(&[output], &[input], &[1.0], &mut [0.0]),
        &mut |it| it.get_state(&mut state),
        &mut |it| {
            let (status, found) = it.state_bytes();
            bytes = found;
            status
        },
        &mut |it| it.set_debug_logging(true, &[]),
        &mut |it| it.reset(),
        &mut |it| it.start(0.0, None),
    ];
    let mut worst = Ok;
    for call in calls {
        worst = worst.max(call(instance));
        if worst >= Error {
            return worst;
        }
    }
    let (status, decoded) = instance.deserialize(&bytes);
    worst.max(status).max(if status == Ok { instance.set_state(&decoded) } else { Ok })
}

#[test]
fn every_fault_stays_in_its_instance() {
    let (mut bystander, description) = started("AllTypes");
    let bystander_output = reference(&description, "output.integral");
    let (_, description) = started("Panicking");
    let at = |name| reference(&description, name);
    let mut time_s = 0.0;
    for item in Fault::TYPE.items {
        let fault = Fault::from_value(item.value).unwrap();
        if matches!(fault, Fault::Initialize | Fault::FailInitialize | Fault::TerminateStep) {
            continue;
        }
        let mut instance = with_fault(fault);
        let status = run(&mut instance, at("output"), at("input"));
        let messages = instance.take_messages();
        let panicked = messages.iter().any(|message| message.text.contains("panic"));
        match fault {
            Fault::Nowhere | Fault::StepShort => assert_eq!((status, panicked), (Ok, false)),
            Fault::FailStep | Fault::StepStill | Fault::FailSerializeState | Fault::FailCheckState => {
                assert_eq!((status, panicked), (Error, false), "{fault:?}");
                assert_eq!(instance.reset(), Ok);
            }
            _ => {
                assert_eq!((status, panicked), (Error, true), "{fault:?} {messages:?}");
                // Poisoned: nothing works but to free it.
                assert_eq!(instance.get_real(&[at("clock")], &mut [0.0]), Error);
                assert_eq!(instance.reset(), Error);
                assert_eq!(instance.set_debug_logging(true, &[]), Error);
                let poisoned = instance.take_messages();
                assert!(poisoned.len() == 3 && poisoned[0].text.contains("a panic ended this instance"));
            }
        }
        drop(instance);
        assert_eq!(bystander.do_step(time_s, 1.0), Ok);
        time_s += 1.0;
        assert_eq!(bystander.get_real(&[bystander_output], &mut [0.0]), Ok);
    }
}

#[test]
fn a_panic_during_initialization_is_an_error_wherever_it_happens() {
    for read_first in [false, true] {
        let (mut instance, description) = super::fresh("Panicking");
        let fault = [reference(&description, "fault")];
        assert_eq!(instance.set_integer(&fault, &[Fault::Initialize.value()]), Ok);
        assert_eq!(instance.setup_experiment(0.0, None), Ok);
        assert_eq!(instance.enter_initialization_mode(), Ok);
        let status = match read_first {
            true => instance.get_real(&[reference(&description, "output")], &mut [0.0]),
            false => instance.exit_initialization_mode(),
        };
        assert_eq!(status, Error);
        assert!(super::only_message(&instance).contains("panic: this is the fault in Initialize: 100 %%"));
    }
    let (mut instance, description) = super::fresh("Panicking");
    let fault = [reference(&description, "fault")];
    assert_eq!(instance.set_integer(&fault, &[Fault::FailInitialize.value()]), Ok);
    assert_eq!(instance.start(0.0, None), Error);
    assert!(super::only_message(&instance).contains("initialize fails"));
    assert_eq!(instance.reset(), Ok);
    assert_eq!(instance.start(0.0, None), Ok);
}

#[test]
fn a_state_that_panics_when_dropped_is_freed_once() {
    let mut instance = with_fault(Fault::DropState);
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
    let mut state = StatePointer::null();
    assert_eq!(instance.get_state(&mut state), Ok);
    assert_eq!(instance.free_state(&mut state), Error);
    assert!(state.is_null());
    assert_eq!(instance.free_state(&mut state), Ok);
    let messages = instance.take_messages();
    assert!(messages[0].text.contains("fmi2FreeFMUstate: panic"), "{messages:?}");
}
