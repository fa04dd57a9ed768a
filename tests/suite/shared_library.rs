//! The shared library itself, not the code it was made from: panics do not cross its boundary, two copies of it
//! run side by side.

use std::fs;
use std::path::{Path, PathBuf};

use fmi::{Fmu, Instance, InstanceOptions, Requirements, Value, platform_folders};
use fmi_export::Enumeration;
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

fn running(fmu: &Fmu, name: &str) -> fmi::Instance {
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

/// Returns the library of a platform, if `cargo xtask dist` has built it: in a folder of its own beside that of this machine.
fn of_platform(library: &Path, target: &str, name: &str) -> Option<PathBuf> {
    let (profile, folder) = (library.parent()?, library.parent()?.parent()?);
    let path = folder.join(target).join(profile.file_name()?).join(name);
    if !path.exists() {
        eprintln!("skipped: {} is not built: `cargo xtask dist --all-platforms`", path.display());
    }
    path.exists().then_some(path)
}

const OF_LINUX: [(&str, &str); 2] =
    [("x86_64-unknown-linux-gnu", "libheliotorque.so"), ("aarch64-unknown-linux-gnu", "libheliotorque.so")];
const OF_WINDOWS: (&str, &str) = ("x86_64-win7-windows-gnu", "heliotorque.dll");

/// The rounding of these is the system's own: with one of them, results would hang on the platform.
#[test]
fn the_library_takes_no_elementary_function_from_the_system() {
    let Some(library) = built("HELIOTORQUE_LIBRARY") else { return };
    let others = OF_LINUX.into_iter().chain([OF_WINDOWS]);
    let others = others.filter_map(|(target, name)| of_platform(&library, target, name));
    for library in others.chain([library.clone()]) {
        let requirements = Requirements::read(&library).unwrap();
        assert!(!requirements.imports.is_empty(), "{}", library.display());
        let found: Vec<&str> = requirements.elementary_functions().collect();
        assert!(found.is_empty(), "{} imports {found:?}: see physics::math", library.display());
    }
}

#[test]
fn the_libraries_for_old_systems_ask_for_no_later_glibc() {
    let Some(library) = built("HELIOTORQUE_LIBRARY") else { return };
    for library in OF_LINUX.iter().filter_map(|(target, name)| of_platform(&library, target, name)) {
        let requirements = Requirements::read(&library).unwrap();
        let version: Vec<u32> =
            requirements.glibc.as_ref().unwrap().split('.').map(|part| part.parse().unwrap()).collect();
        assert!(version[..] <= [2, 17][..], "{}: {requirements}", library.display());
    }
}

/// The libraries of Windows 7 are enough, without those of mingw.
#[test]
fn the_library_for_windows_needs_windows_alone() {
    const OF_THE_SYSTEM: [&str; 7] = [
        "advapi32.dll",
        "kernel32.dll",
        "msvcrt.dll",
        "ntdll.dll",
        "user32.dll",
        "userenv.dll",
        "ws2_32.dll",
    ];
    let Some(library) = built("HELIOTORQUE_LIBRARY") else { return };
    let Some(library) = of_platform(&library, OF_WINDOWS.0, OF_WINDOWS.1) else { return };
    let requirements = Requirements::read(&library).unwrap();
    assert_eq!(requirements.platform_folders().first(), Some(&"win64"));
    let foreign = |name: &&String| !OF_THE_SYSTEM.contains(&&*name.to_lowercase());
    let found: Vec<&String> = requirements.libraries.iter().filter(foreign).collect();
    assert!(!requirements.libraries.is_empty() && found.is_empty(), "{found:?}");
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
    // Otherwise the library is that of another profile.
    if std::env::var_os("HELIOTORQUE_SHIPPED").is_none() {
        return;
    }
    let bytes = fs::read(library).unwrap();
    let holds = |name: &[u8]| bytes.windows(name.len()).any(|window| window == name);
    assert!(holds(b".dynsym\0") && holds(b"fmi2DoStep\0"));
    assert!(!holds(b".symtab\0"), "the shipped library holds a symbol table");
}
