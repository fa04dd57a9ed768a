//! A panic or failure in any callback ends as a status of the call that met it: the process, the other
//! instances and freeing go on.

use client::{InProcess, StatePointer};
use fmi_export::{BaseType, Enumeration, Status, fmi2::references};
use probe::{LIBRARY, panicking::Fault};

const FAULT: [u32; 1] = [references::first(BaseType::Integer)];
const INPUT: [u32; 1] = [0];
const OUTPUT: [u32; 1] = [1];

/// One instance of `Panicking` that will have this fault.
fn instance(fault: Fault) -> InProcess {
    let mut instance = InProcess::of(&LIBRARY, "Panicking").unwrap();
    assert_eq!(instance.set_integer(&FAULT, &[fault.value()]), Status::Ok);
    instance
}

/// Uses everything once; the error is the first call that is not OK, and its status.
fn use_everything(instance: &mut InProcess) -> Result<(), (&'static str, Status)> {
    let ok = |call, status| if status == Status::Ok { Ok(()) } else { Err((call, status)) };
    let mut saved = StatePointer::null();
    ok("start", instance.start(0.0, None))?;
    ok("doStep", instance.do_step(0.0, 0.5))?;
    ok("outputDerivatives", instance.get_output_derivatives(&OUTPUT, &[1], &mut [0.0]))?;
    let status = instance.get_directional_derivative(&OUTPUT, &INPUT, &[1.0], &mut [0.0]);
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
fn every_fault_is_a_status_of_its_call() {
    let mut other = instance(Fault::Nowhere);
    assert_eq!(other.start(0.0, None), Status::Ok);
    for (step, item) in Fault::TYPE.items.iter().enumerate() {
        let fault = Fault::from_value(item.value).unwrap();
        let expected = match fault {
            Fault::Nowhere | Fault::StepShort => Ok(()),
            Fault::Initialize | Fault::FailInitialize => Err(("start", Status::Error)),
            Fault::Step
            | Fault::StepPayload
            | Fault::StepPayloadDrop
            | Fault::StepIndex
            | Fault::StepStill
            | Fault::FailStep => Err(("doStep", Status::Error)),
            Fault::TerminateStep => Err(("doStep", Status::Discard)),
            Fault::OutputDerivative => Err(("outputDerivatives", Status::Error)),
            Fault::DirectionalDerivative => Err(("directionalDerivative", Status::Error)),
            Fault::CloneState => Err(("getState", Status::Error)),
            // What could not be read is not written.
            Fault::SerializeState | Fault::FailSerializeState | Fault::CheckState | Fault::FailCheckState => {
                Err(("serialize", Status::Error))
            }
            Fault::DeserializeState => Err(("deserialize", Status::Error)),
            // Restoring drops the state there was.
            Fault::DropState => Err(("setState", Status::Error)),
        };
        let mut failing = instance(fault);
        assert_eq!(use_everything(&mut failing), expected, "{fault:?}");
        if expected.is_err() {
            let messages = failing.take_messages();
            assert!(messages.iter().any(|it| !it.text.is_empty()), "{fault:?} is not reported");
        }
        let time_s = step as f64 * 0.5;
        assert_eq!(other.do_step(time_s, 0.5), Status::Ok, "the instance beside {fault:?}");
    }
}

#[test]
fn a_panic_poisons_but_a_failure_can_be_reset() {
    for (fault, after_reset) in [(Fault::Step, Status::Error), (Fault::FailStep, Status::Ok)] {
        let mut failing = instance(fault);
        assert_eq!(failing.start(0.0, None), Status::Ok);
        assert_eq!(failing.do_step(0.0, 1.0), Status::Error);
        assert!(failing.take_messages().iter().any(|it| it.text.contains("100 %% deliberate")), "{fault:?}");
        assert_eq!(failing.do_step(0.0, 1.0), Status::Error, "{fault:?}");
        assert_eq!(failing.reset(), after_reset, "{fault:?}");
    }
}

#[test]
fn a_model_that_ends_says_so_and_can_be_read() {
    let mut ending = instance(Fault::TerminateStep);
    assert_eq!(ending.start(2.0, None), Status::Ok);
    assert_eq!(ending.do_step(2.0, 1.0), Status::Discard);
    assert_eq!(ending.terminated(), (Status::Ok, true));
    assert_eq!(ending.last_successful_time(), (Status::Ok, 2.0));
}

#[test]
fn a_panic_over_the_setup_refuses_the_instance_only() {
    let guid = LIBRARY.find("Panicking").unwrap().describe(None, None).unwrap().guid;
    for place in ["parseSetup", "about", "declare", "serializeSetup"] {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("panicking.toml"), format!("panic_in = '{place}'")).unwrap();
        let location = format!("file://{}", folder.path().display());
        let messages = InProcess::instantiate(&LIBRARY, &guid, Some(&location)).unwrap_err();
        assert!(messages.iter().any(|it| it.text.contains("100 %% deliberate")), "{place}: {messages:?}");
    }
    assert_eq!(instance(Fault::Nowhere).start(0.0, None), Status::Ok);
}
