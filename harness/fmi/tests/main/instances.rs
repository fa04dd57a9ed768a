//! An instance obeys the call table, its errors name call and reason, and its states come back to the bit.

use fmi::{Callbacks, Checking, Error, Fmu, Instance, InstanceOptions, Outcome, Resources, Status, Value};

use crate::probe;

fn ready(fmu: &Fmu) -> Instance {
    let mut instance = Instance::new(fmu, "it", &InstanceOptions::default()).unwrap();
    instance.setup_experiment(None, 0.0, None).unwrap();
    instance.enter_initialization_mode().unwrap();
    instance.exit_initialization_mode().unwrap();
    instance
}

fn refused(outcome: Result<(), Error>) -> String {
    match outcome {
        Err(Error::Call(call)) if matches!(call.outcome, Outcome::NotAllowed(_)) => call.to_string(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn every_type_goes_there_and_back() {
    let Some((_folder, fmu)) = probe("AllTypes") else { return };
    let mut instance = ready(&fmu);
    for (name, value) in [
        ("input.real", Value::Real(-2.5)),
        ("input.integer", Value::Integer(-5)),
        ("input.boolean", Value::Boolean(true)),
        ("input.text", Value::Text("naïve % ## 火星".to_owned())),
        ("input.choice", Value::Integer(4)),
    ] {
        instance.set(name, &value).unwrap();
        assert_eq!(instance.get(name).unwrap(), value, "{name}");
    }
    instance.do_step(0.0, 1.0, true).unwrap();
    assert_eq!(instance.get_real("output.real").unwrap(), -2.5);
    assert_eq!(instance.get("output.text").unwrap(), Value::Text("naïve % ## 火星".to_owned()));
    assert_eq!(instance.get("output.choice").unwrap(), Value::Integer(4));
    let error = instance.set("input.real", &Value::Integer(1)).unwrap_err().to_string();
    assert!(error.contains("input.real") && error.contains("Real"), "{error}");
    assert!(instance.get_real("output.integer").is_err());
}

#[test]
fn forbidden_calls_never_reach_the_fmu() {
    let Some((_folder, fmu)) = probe("AllTypes") else { return };
    let mut instance = Instance::new(&fmu, "it", &InstanceOptions::default()).unwrap();
    assert!(refused(instance.do_step(0.0, 1.0, true)).contains("instantiated"));
    assert!(refused(instance.enter_initialization_mode()).contains("fmi2SetupExperiment"));
    let text = refused(instance.set_real("input.real", 1.0));
    assert!(text.contains("input.real") && text.contains("exact or approx"), "{text}");
    assert!(refused(instance.terminate()).contains("fmi2Terminate"));

    instance.setup_experiment(None, 0.0, None).unwrap();
    instance.enter_initialization_mode().unwrap();
    instance.set_real("input.real", 1.0).unwrap();
    instance.exit_initialization_mode().unwrap();
    assert!(refused(instance.set_real("parameter.real", 1.0)).contains("parameter.real"));
    assert!(refused(instance.set_reals(&[4_000_000], &[1.0])).contains("4000000"));
    assert!(refused(instance.setup_experiment(None, 0.0, None)).contains("stepComplete"));
    instance.do_step(0.0, 1.0, true).unwrap();
    instance.terminate().unwrap();
    assert!(refused(instance.do_step(1.0, 1.0, true)).contains("terminated"));
    instance.get_real("output.real").unwrap();
    instance.reset().unwrap();
    assert!(refused(instance.enter_initialization_mode()).contains("fmi2SetupExperiment"));
}

#[test]
fn lengths_are_checked_before_the_call() {
    let Some((_folder, fmu)) = probe("AllTypes") else { return };
    let mut instance = ready(&fmu);
    let reference = fmu.variable("output.real").unwrap().value_reference;
    let error = instance.get_reals(&[reference], &mut [0.0, 0.0]).unwrap_err().to_string();
    assert!(error.contains("1 value references but 2 values"), "{error}");
    assert!(instance.set_input_derivatives(&[reference], &[], &[1.0]).is_err());
    assert!(instance.directional_derivative(&[reference], &[], &[1.0], &mut [0.0]).is_err());
    let error = instance.set("input.text", &Value::Text("a\0b".to_owned())).unwrap_err().to_string();
    assert!(error.contains("zero byte"), "{error}");
    instance.do_step(0.0, 1.0, true).unwrap();
}

#[test]
fn an_error_shows_call_status_and_log() {
    let Some((_folder, fmu)) = probe("AllTypes") else { return };
    let options = InstanceOptions { logging: true, checking: Checking::Off, ..InstanceOptions::default() };
    let mut instance = Instance::new(&fmu, "my % ship", &options).unwrap();
    let error = instance.do_step(0.0, 1.0, true).unwrap_err();
    assert_eq!(error.status(), Some(Status::Error));
    let text = error.to_string();
    for part in
        ["AllTypes", "my % ship", "fmi2DoStep(currentCommunicationPoint=0", "fmi2Error", "instantiated"]
    {
        assert!(text.contains(part), "{text} lacks {part}");
    }
    assert!(!instance.take_messages().is_empty());
    assert!(instance.messages().is_empty());
}

#[test]
fn an_fmu_that_is_not_made_says_why() {
    let Some((folder, fmu)) = probe("AllTypes") else { return };
    let options = InstanceOptions { guid: Some("{wrong}".to_owned()), ..InstanceOptions::default() };
    let text = Instance::new(&fmu, "it", &options).unwrap_err().to_string();
    assert!(text.contains("fmi2Instantiate: gave no instance") && text.contains("{wrong}"), "{text}");
    let options = InstanceOptions {
        resources: Resources::Uri("file:///no/such/place".to_owned()),
        ..InstanceOptions::default()
    };
    assert!(Instance::new(&fmu, "it", &options).is_err());
    assert!(Instance::new(&fmu, "a\0b", &InstanceOptions::default()).is_err());

    // No library for this computer.
    std::fs::rename(folder.path().join("binaries"), folder.path().join("binaries.old")).unwrap();
    let bare = Fmu::open(folder.path()).unwrap();
    let text = Instance::new(&bare, "it", &InstanceOptions::default()).unwrap_err().to_string();
    assert!(
        text.contains("no shared library for this computer") && text.contains(fmi::platform_folders()[0])
    );

    // A library that is none, under a path that was not loaded before.
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("modelDescription.xml"), fmu.xml()).unwrap();
    let platform = folder.path().join("binaries").join(fmi::platform_folders()[0]);
    std::fs::create_dir_all(&platform).unwrap();
    let file = platform.join(format!("AllTypes{}", std::env::consts::DLL_SUFFIX));
    std::fs::write(&file, "not a library").unwrap();
    let text = Fmu::open(folder.path()).unwrap().binary().unwrap_err().to_string();
    assert!(text.contains("does not load") && text.contains("AllTypes"), "{text}");
}

#[test]
fn states_come_back_to_the_bit_here_and_elsewhere() {
    let Some((_folder, fmu)) = probe("AllTypes") else { return };
    let mut instance = ready(&fmu);
    instance.set_real("input.real", 0.1).unwrap();
    let advance = |instance: &mut Instance, from: u32, to: u32| {
        for k in from..to {
            instance.do_step(f64::from(k) * 0.3, 0.3, false).unwrap();
        }
        instance.get_real("output.integral").unwrap().to_bits()
    };
    advance(&mut instance, 0, 7);
    let saved = instance.save_state().unwrap();
    let bytes = instance.serialize_state(saved).unwrap();
    let first = advance(&mut instance, 7, 19);
    instance.restore_state(saved).unwrap();
    assert_eq!(advance(&mut instance, 7, 19), first);
    // Restoring leads out of every state.
    instance.terminate().unwrap();
    instance.restore_state(saved).unwrap();
    assert_eq!(advance(&mut instance, 7, 19), first);

    let mut other = Instance::new(&fmu, "other", &InstanceOptions::default()).unwrap();
    let there = other.deserialize_state(&bytes).unwrap();
    other.restore_state(there).unwrap();
    assert_eq!(advance(&mut other, 7, 19), first);

    // A state is its instance's own, and gone once freed.
    assert!(other.restore_state(saved).unwrap_err().to_string().contains("another instance"));
    instance.free_state(saved).unwrap();
    assert!(instance.restore_state(saved).is_err());
    let next = instance.save_state().unwrap();
    assert!(instance.serialize_state(saved).is_err(), "a freed state's place was taken by {next:?}");
    assert!(other.deserialize_state(&bytes[1..]).is_err());
}

#[test]
fn instances_move_between_threads_and_outlive_the_fmu() {
    let Some((folder, fmu)) = probe("AllTypes") else { return };
    let handles: Vec<_> = (0..4)
        .map(|thread| {
            let mut instance = ready(&fmu);
            std::thread::spawn(move || {
                instance.set_real("input.real", f64::from(thread)).unwrap();
                for k in 0..50 {
                    instance.do_step(f64::from(k), 1.0, true).unwrap();
                }
                instance.get_real("output.integral").unwrap()
            })
        })
        .collect();
    drop(fmu);
    drop(folder);
    for (thread, handle) in (0..4).zip(handles) {
        assert!((handle.join().unwrap() - 50.0 * f64::from(thread)).abs() < 1e-9);
    }
}

#[test]
fn callbacks_may_be_rubbish_after_instantiation() {
    let Some((_folder, fmu)) = probe("AllTypes") else { return };
    let options = InstanceOptions {
        logging: true,
        checking: Checking::Off,
        callbacks: Callbacks { null_memory: true, overwritten: true },
        ..InstanceOptions::default()
    };
    let mut instance = Instance::new(&fmu, "it", &options).unwrap();
    assert!(instance.do_step(0.0, 1.0, true).is_err());
    assert!(!instance.messages().is_empty(), "the logger was lost with the struct");
    for (name, answer) in instance.probe_nulls() {
        assert!(answer.is_ok(), "{name}");
    }
}
