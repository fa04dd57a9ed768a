//! The shared library itself, not the code it was made from: panics do not cross its boundary, two copies of it
//! run side by side.

use std::fs;
use std::path::{Path, PathBuf};

use fmi_export::Enumeration;
use loader::{Fmu, Instance, InstanceOptions, Requirements, Value, platform_folders};
use probe::panicking::Fault;

use crate::support::{LIBRARY, built, description};

/// An unpacked FMU of a probe model around the library.
pub(crate) fn folder(base: &Path, model: &str, library: &Path) -> Fmu {
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

/// An importer may run where GCC's runtime is not installed.
#[cfg(target_os = "linux")]
#[test]
fn the_unwinder_is_part_of_the_library() {
    for variable in ["HELIOTORQUE_LIBRARY", "HELIOTORQUE_PROBE_LIBRARY"] {
        let Some(library) = built(variable) else { return };
        let libraries = Requirements::read(&library).unwrap().libraries;
        assert!(libraries.iter().any(|name| name == "libc.so.6"), "{variable}: {libraries:?}");
        assert!(!libraries.iter().any(|name| name.starts_with("libgcc_s")), "{variable}: {libraries:?}");
    }
}

/// Where the library for old systems is, if `cargo xtask dist` has built it: in a folder of its own beside that of this machine.
fn portable(library: &Path) -> Option<PathBuf> {
    let (profile, target) = (library.parent()?, library.parent()?.parent()?);
    let path = target.join("x86_64-unknown-linux-gnu").join(profile.file_name()?).join(library.file_name()?);
    path.exists().then_some(path)
}

/// The rounding of these is the system's own: with one of them, results would hang on the platform.
#[test]
fn the_library_takes_no_elementary_function_from_the_system() {
    let Some(library) = built("HELIOTORQUE_LIBRARY") else { return };
    for library in [Some(library.clone()), portable(&library)].into_iter().flatten() {
        let requirements = Requirements::read(&library).unwrap();
        assert!(!requirements.imports.is_empty(), "{}", library.display());
        let found: Vec<&str> = requirements.elementary_functions().collect();
        assert!(found.is_empty(), "{} imports {found:?}: see physics::math", library.display());
    }
}

#[test]
fn the_library_for_old_systems_asks_for_no_later_glibc() {
    let Some(library) = built("HELIOTORQUE_LIBRARY") else { return };
    let Some(library) = portable(&library) else {
        eprintln!("skipped: `cargo xtask dist` has built no library for old systems");
        return;
    };
    let requirements = Requirements::read(&library).unwrap();
    let version: Vec<u32> =
        requirements.glibc.as_ref().unwrap().split('.').map(|part| part.parse().unwrap()).collect();
    assert!(version[..] <= [2, 17][..], "{requirements}");
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
