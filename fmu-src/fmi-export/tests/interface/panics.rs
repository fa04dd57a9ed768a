//! A fault of the model is a status of the call that met it; a panic ends its instance, and other instances continue.

use client::{InProcess, StatePointer};
use fmi_export::Enumeration;
use fmi_export::model_description::Status::{self, Discard, Error, Ok};
use probe::panicking::Fault;

use super::{fresh, only_message, reference, started};

/// An instance of `Panicking` that will have this fault.
fn with_fault(fault: Fault) -> InProcess {
    let (mut instance, description) = fresh("Panicking");
    assert_eq!(instance.set_integer(&[reference(&description, "fault")], &[fault.value()]), Ok);
    instance
}

/// Uses everything once; the error is the first call that is not OK, and its status.
fn use_everything(instance: &mut InProcess, output: u32, input: u32) -> Result<(), (&'static str, Status)> {
    let ok = |call, status| if status == Ok { Result::Ok(()) } else { Err((call, status)) };
    let mut saved = StatePointer::null();
    ok("start", instance.start(0.0, None))?;
    ok("doStep", instance.do_step(0.0, 0.5))?;
    ok("outputDerivatives", instance.get_output_derivatives(&[output], &[1], &mut [0.0]))?;
    let status = instance.get_directional_derivative(&[output], &[input], &[1.0], &mut [0.0]);
    ok("directionalDerivative", status)?;
    ok("getState", instance.get_state(&mut saved))?;
    let (status, bytes) = instance.serialize(&saved);
    ok("serialize", status)?;
    let (status, read) = instance.deserialize(&bytes);
    ok("deserialize", status)?;
    ok("setState", instance.set_state(&read))?;
    ok("reset", instance.reset())
}

#[test]
fn every_fault_is_a_status_of_its_call_and_stays_in_its_instance() {
    let (mut bystander, description) = started("AllTypes");
    let bystander_output = reference(&description, "output.integral");
    let (_, description) = fresh("Panicking");
    let at = |name| reference(&description, name);
    for (step, item) in Fault::TYPE.items.iter().enumerate() {
        let fault = Fault::from_value(item.value).unwrap();
        let (expected, panics) = match fault {
            Fault::Nowhere | Fault::StepShort => (None, false),
            Fault::Initialize => (Some(("start", Error)), true),
            Fault::FailInitialize => (Some(("start", Error)), false),
            Fault::Step | Fault::StepPayload | Fault::StepPayloadDrop | Fault::StepIndex => {
                (Some(("doStep", Error)), true)
            }
            Fault::StepStill | Fault::FailStep => (Some(("doStep", Error)), false),
            Fault::TerminateStep => (Some(("doStep", Discard)), false),
            Fault::OutputDerivative => (Some(("outputDerivatives", Error)), true),
            Fault::DirectionalDerivative => (Some(("directionalDerivative", Error)), true),
            Fault::CloneState => (Some(("getState", Error)), true),
            // What could not be read is not written.
            Fault::SerializeState | Fault::CheckState => (Some(("serialize", Error)), true),
            Fault::FailSerializeState | Fault::FailCheckState => (Some(("serialize", Error)), false),
            Fault::DeserializeState => (Some(("deserialize", Error)), true),
            // Restoring drops the state there was.
            Fault::DropState => (Some(("setState", Error)), true),
        };
        let mut instance = with_fault(fault);
        let found = use_everything(&mut instance, at("output"), at("input")).err();
        let messages = instance.drain_messages();
        assert_eq!(found, expected, "{fault:?} {messages:?}");
        assert_eq!(messages.is_empty(), expected.is_none(), "{fault:?}");
        let panicked = messages.iter().any(|message| message.text.contains("panic"));
        assert_eq!(panicked, panics, "{fault:?} {messages:?}");
        if panics {
            // Poisoned: nothing works but to free it.
            assert_eq!(instance.get_real(&[at("clock")], &mut [0.0]), Error);
            assert_eq!(instance.reset(), Error);
            assert_eq!(instance.set_debug_logging(true, &[]), Error);
            let poisoned = instance.drain_messages();
            assert!(poisoned.len() == 3 && poisoned[0].text.contains("a panic ended this instance"));
        } else {
            assert_eq!(instance.reset(), Ok);
        }
        drop(instance);
        assert_eq!(bystander.do_step(step as f64, 1.0), Ok);
        assert_eq!(bystander.get_real(&[bystander_output], &mut [0.0]), Ok);
    }
}

#[test]
fn a_panic_during_initialization_is_an_error_wherever_it_happens() {
    for read_first in [false, true] {
        let mut instance = with_fault(Fault::Initialize);
        let (_, description) = fresh("Panicking");
        assert_eq!(instance.setup_experiment(0.0, None), Ok);
        assert_eq!(instance.enter_initialization_mode(), Ok);
        let status = match read_first {
            true => instance.get_real(&[reference(&description, "output")], &mut [0.0]),
            false => instance.exit_initialization_mode(),
        };
        assert_eq!(status, Error);
        assert!(only_message(&instance).contains("panic: this is the fault in Initialize: 100 %%"));
    }
    let mut instance = with_fault(Fault::FailInitialize);
    assert_eq!(instance.start(0.0, None), Error);
    assert!(only_message(&instance).contains("initialize fails"));
    assert_eq!(instance.reset(), Ok);
    assert_eq!(instance.start(0.0, None), Ok);
}

#[test]
fn a_state_that_panics_when_dropped_is_freed_once() {
    let mut instance = with_fault(Fault::DropState);
    assert_eq!(instance.start(0.0, None), Ok);
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
    let mut state = StatePointer::null();
    assert_eq!(instance.get_state(&mut state), Ok);
    assert_eq!(instance.free_state(&mut state), Error);
    assert!(state.is_null());
    assert_eq!(instance.free_state(&mut state), Ok);
    let messages = instance.drain_messages();
    assert!(messages[0].text.contains("fmi2FreeFMUstate: panic"), "{messages:?}");
}
