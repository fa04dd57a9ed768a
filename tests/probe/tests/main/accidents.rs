//! A panic or failure in any callback ends as a status of the call that met it: the process, the other
//! instances and freeing go on.

use client::{InProcess, StatePointer};
use fmi_export::{BaseType, Enumeration, Status, fmi2::references};
use probe::{LIBRARY, panicking::Accident};

const ACCIDENT: [u32; 1] = [references::first(BaseType::Integer)];
const INPUT: [u32; 1] = [0];
const OUTPUT: [u32; 1] = [1];

/// One instance of `Panicking` that will have this accident.
fn instance(accident: Accident) -> InProcess {
    let mut instance = InProcess::of(&LIBRARY, "Panicking").unwrap();
    assert_eq!(instance.set_integer(&ACCIDENT, &[accident.value()]), Status::Ok);
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
fn every_accident_is_a_status_of_its_call() {
    let mut neighbour = instance(Accident::Nowhere);
    assert_eq!(neighbour.start(0.0, None), Status::Ok);
    for (step, item) in Accident::TYPE.items.iter().enumerate() {
        let accident = Accident::from_value(item.value).unwrap();
        let expected = match accident {
            Accident::Nowhere | Accident::StepShort => Ok(()),
            Accident::Initialize | Accident::FailInitialize => Err(("start", Status::Error)),
            Accident::Step
            | Accident::StepPayload
            | Accident::StepPayloadDrop
            | Accident::StepIndex
            | Accident::StepStill
            | Accident::FailStep => Err(("doStep", Status::Error)),
            Accident::TerminateStep => Err(("doStep", Status::Discard)),
            Accident::OutputDerivative => Err(("outputDerivatives", Status::Error)),
            Accident::DirectionalDerivative => Err(("directionalDerivative", Status::Error)),
            Accident::CloneState => Err(("getState", Status::Error)),
            Accident::SerializeState | Accident::FailSerializeState => Err(("serialize", Status::Error)),
            Accident::DeserializeState | Accident::CheckState | Accident::FailCheckState => {
                Err(("deserialize", Status::Error))
            }
            // Restoring drops the state there was.
            Accident::DropState => Err(("setState", Status::Error)),
        };
        let mut unlucky = instance(accident);
        assert_eq!(use_everything(&mut unlucky), expected, "{accident:?}");
        if expected.is_err() {
            let messages = unlucky.take_messages();
            assert!(messages.iter().any(|it| !it.text.is_empty()), "{accident:?} is not reported");
        }
        let time_s = step as f64 * 0.5;
        assert_eq!(neighbour.do_step(time_s, 0.5), Status::Ok, "the neighbour of {accident:?}");
    }
}

#[test]
fn a_panic_poisons_but_a_failure_can_be_reset() {
    for (accident, after_reset) in [(Accident::Step, Status::Error), (Accident::FailStep, Status::Ok)] {
        let mut unlucky = instance(accident);
        assert_eq!(unlucky.start(0.0, None), Status::Ok);
        assert_eq!(unlucky.do_step(0.0, 1.0), Status::Error);
        assert!(
            unlucky.take_messages().iter().any(|it| it.text.contains("100 %% deliberate")),
            "{accident:?}"
        );
        assert_eq!(unlucky.do_step(0.0, 1.0), Status::Error, "{accident:?}");
        assert_eq!(unlucky.reset(), after_reset, "{accident:?}");
    }
}

#[test]
fn a_model_that_ends_says_so_and_can_be_read() {
    let mut ending = instance(Accident::TerminateStep);
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
    assert_eq!(instance(Accident::Nowhere).start(0.0, None), Status::Ok);
}
