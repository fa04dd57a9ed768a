//! The shared library itself, not the code it was made from: panics do not cross its boundary, two copies of it
//! run side by side.

use std::fs;
use std::path::Path;

use fmi_export::Enumeration;
use loader::{Fmu, Instance, InstanceOptions, Value, platform_folders};
use probe::panicking::Fault;

use crate::support::{LIBRARY, built, description};

/// An unpacked FMU of a probe model around the library.
pub fn folder(base: &Path, model: &str, library: &Path) -> Fmu {
    let folder = base.join(model);
    let binaries = folder.join("binaries").join(platform_folders()[0]);
    fs::create_dir_all(&binaries).unwrap();
    let entry = LIBRARY.find(model).unwrap();
    if let Some(file) = entry.setup_file {
        fs::create_dir_all(folder.join("resources")).unwrap();
        fs::write(folder.join("resources").join(file), entry.default_setup).unwrap();
    }
    fs::write(folder.join("modelDescription.xml"), model_description::to_xml(&description(model))).unwrap();
    fs::copy(library, binaries.join(format!("{model}{}", std::env::consts::DLL_SUFFIX))).unwrap();
    Fmu::open(&folder).unwrap()
}

fn running(fmu: &Fmu, name: &str) -> loader::Instance {
    let mut instance = Instance::new(fmu, name, &InstanceOptions::default()).unwrap();
    instance.setup_experiment(None, 0.0, None).unwrap();
    instance.enter_initialization_mode().unwrap();
    instance.exit_initialization_mode().unwrap();
    instance
}

#[test]
fn panics_stay_inside_the_library() {
    let Some(library) = built("HELIOTORQUE_PROBE_LIBRARY") else { return };
    let base = tempfile::tempdir().unwrap();
    let fmu = folder(base.path(), "Panicking", &library);
    let other = folder(base.path(), "AllTypes", &library);
    let (mut other, mut other_model) = (running(&fmu, "other"), running(&other, "other_model"));
    let in_step = [Fault::Step, Fault::StepPayload, Fault::StepPayloadDrop, Fault::StepIndex];
    for (number, fault) in in_step.into_iter().enumerate() {
        let mut failing = running(&fmu, "failing");
        let value = Value::Integer(fault.value());
        failing.set("fault", &value).unwrap();
        let error = failing.do_step(0.0, 0.5, true).unwrap_err().to_string();
        assert!(error.contains("fmi2DoStep"), "{fault:?}: {error}");
        assert!(failing.messages().iter().any(|it| it.text.contains("panic")), "{fault:?}");
        // Nothing but freeing works, and that does.
        assert!(failing.reset().is_err(), "{fault:?}");
        drop(failing);
        let time_s = 0.5 * number as f64;
        other.do_step(time_s, 0.5, true).unwrap();
        other_model.do_step(time_s, 0.5, true).unwrap();
        assert_eq!(other.get_real("clock").unwrap(), time_s + 0.5);
    }
}

/// An importer may run where GCC's runtime is not installed; the names of needed libraries stand in the file as they are.
#[cfg(target_os = "linux")]
#[test]
fn the_unwinder_is_part_of_the_library() {
    for variable in ["HELIOTORQUE_LIBRARY", "HELIOTORQUE_PROBE_LIBRARY"] {
        let Some(library) = built(variable) else { return };
        let bytes = fs::read(library).unwrap();
        let names = |name: &[u8]| bytes.windows(name.len()).any(|part| part == name);
        assert!(names(b"libc.so.6"), "{variable}");
        assert!(!names(b"libgcc_s"), "{variable} needs libgcc_s");
    }
}

#[test]
fn both_copies_of_a_library_serve_their_own_states() {
    let Some(library) = built("HELIOTORQUE_PROBE_LIBRARY") else { return };
    let base = tempfile::tempdir().unwrap();
    let copies = ["one", "two"].map(|name| folder(&base.path().join(name), "AllTypes", &library));
    let mut instances = copies.each_ref().map(|fmu| running(fmu, "all types"));
    for (number, instance) in instances.iter_mut().enumerate() {
        instance.set_real("input.real", number as f64 + 1.0).unwrap();
        instance.do_step(0.0, 1.0, true).unwrap();
    }
    for (number, instance) in instances.iter_mut().enumerate() {
        assert_eq!(instance.get_real("output.integral").unwrap(), number as f64 + 1.0);
    }
}

/// The symbols that importers look up stand in the dynamic table; the others are of no use to them.
#[test]
fn the_shipped_library_is_stripped() {
    let Some(library) = built("HELIOTORQUE_LIBRARY") else { return };
    let bytes = fs::read(library).unwrap();
    let holds = |name: &[u8]| bytes.windows(name.len()).any(|window| window == name);
    assert!(holds(b".dynsym\0") && holds(b"fmi2DoStep\0"));
    assert!(!holds(b".symtab\0"), "the shipped library holds a symbol table");
}
