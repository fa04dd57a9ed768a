//! `modelDescription/golden` holds what the library describes today, to the byte.
//!
//! After a deliberate change: `cargo xtask bless golden` rewrites it.

use std::path::{Path, PathBuf};

use fmi::{Binary, Fmu};

use model_description::{Causality, Code, ScalarVariable};

use crate::support::{LIBRARY, SHIPPED, built, description};

fn golden_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join("modelDescription").join("golden")
}

#[test]
fn every_shipped_model_is_described_as_in_its_golden_file() {
    let bless = std::env::var_os("HELIOTORQUE_BLESS").is_some();
    for model in SHIPPED {
        let path = golden_folder().join(format!("{model}.xml"));
        let found = model_description::to_xml(&description(model));
        if bless {
            std::fs::create_dir_all(golden_folder()).unwrap();
            std::fs::write(&path, &found).unwrap();
        }
        let golden = std::fs::read_to_string(&path).unwrap_or_default();
        let differs = golden.lines().zip(found.lines()).position(|(golden, found)| golden != found);
        assert!(
            golden == found,
            "{} differs from line {}: found\n{}\nIf that is meant: cargo xtask bless golden",
            path.display(),
            differs.map_or(golden.lines().count(), |line| line) + 1,
            differs.and_then(|line| found.lines().nth(line)).unwrap_or("(one file is longer)"),
        );
    }
}

#[test]
fn annotations_name_what_is_there() {
    let all: Vec<_> = SHIPPED.iter().map(|model| description(model)).collect();
    for description in &all {
        let annotated = description.variables.iter().filter_map(|it| Some((it, it.annotation.as_deref()?)));
        let is_output = |name: &String| {
            let mut variables = all.iter().flat_map(|it| &it.variables);
            variables.any(|it| it.name == *name && it.causality == Causality::Output)
        };
        for (variable, annotation) in annotated {
            assert!(annotation.also_called.iter().all(is_output), "{}: {annotation:?}", variable.name);
        }
        let found = model_description::validate(description);
        let found: Vec<_> = found.iter().filter(|it| it.code == Code::Annotation).collect();
        assert!(found.is_empty(), "{}: {found:?}", description.model_name);
        let is_annotated = |it: &ScalarVariable| it.annotation.is_some();
        assert!(description.variables.iter().any(is_annotated), "{}", description.model_name);
    }
}

/// An option that the file gives has no item for `wire` to set.
#[test]
fn an_option_of_the_file_is_nobody_elses_choice() {
    let set = |text: &str| {
        let plant = LIBRARY.find("MomentumPlant").unwrap();
        let text = plant.default_setup.replacen("[start]\n", &format!("[start]\n{text}\n"), 1);
        let described = LIBRARY.describe(plant, None, Some(&text)).unwrap();
        let input = described.variables.iter().find(|it| it.name == "command.q[1]").unwrap();
        let options = input.annotation.as_ref().unwrap().read_where.iter();
        options.map(|it| it.set.clone().unwrap_or_default()).collect::<Vec<_>>()
    };
    assert_eq!(set(""), ["commanded", "inputs"]);
    assert_eq!(set("\"attitude.source\" = \"free\""), ["", "inputs"]);
}

/// PyFMI stores results by reference alone; elements of a vector are read as one block.
#[test]
fn value_references_are_unique_over_all_base_types_and_consecutive_in_a_vector() {
    for model in ["Empty", "AllTypes", "Panicking"].iter().chain(SHIPPED) {
        let description = description(model);
        let mut seen = std::collections::BTreeMap::new();
        for variable in &description.variables {
            if let Some(other) = seen.insert(variable.value_reference, &variable.name) {
                panic!(
                    "{model}: {other} and {} have the reference {}",
                    variable.name, variable.value_reference
                );
            }
        }
        let vector =
            |name: &str| name.strip_suffix(']')?.rsplit_once('[').map(|(vector, _)| vector.to_owned());
        for pair in description.variables.windows(2) {
            if vector(&pair[0].name).is_some() && vector(&pair[0].name) == vector(&pair[1].name) {
                assert_eq!(pair[0].value_reference + 1, pair[1].value_reference, "{model}: {}", pair[1].name);
            }
        }
    }
}

#[test]
fn the_packed_fmus_carry_the_golden_descriptions() {
    let Some(dist) = built("HELIOTORQUE_DIST") else { return };
    for model in SHIPPED {
        let fmu = Fmu::open(dist.join(format!("{model}.fmu"))).unwrap();
        let golden = std::fs::read(golden_folder().join(format!("{model}.xml"))).unwrap();
        assert!(fmu.xml() == golden, "{model}.fmu was packed with another description");
    }
}

/// An FMI library exports the standard's functions, our own ones, and nothing that could clash with another FMU.
#[test]
#[cfg(target_os = "linux")]
fn the_library_exports_what_it_must_and_nothing_else() {
    for variable in ["HELIOTORQUE_LIBRARY", "HELIOTORQUE_PROBE_LIBRARY"] {
        let Some(library) = built(variable) else { continue };
        let Ok(output) =
            std::process::Command::new("nm").args(["-D", "--defined-only"]).arg(&library).output()
        else {
            assert!(std::env::var_os("CI").is_none(), "nm is missing");
            eprintln!("skipped: there is no nm on this machine");
            return;
        };
        assert!(output.status.success(), "{output:?}");
        let listed = String::from_utf8(output.stdout).unwrap();
        let mut found: Vec<&str> = listed.lines().filter_map(|line| line.split_whitespace().last()).collect();
        found.sort_unstable();
        let mut expected = EXPORTS.to_vec();
        expected.sort_unstable();
        assert_eq!(found, expected, "{}", library.display());
        Binary::load(&library).unwrap();
    }
}

/// `fmi2Functions.h` of the standard without the model-exchange part, and the packer's function.
const EXPORTS: [&str; 36] = [
    "fmi2GetTypesPlatform",
    "fmi2GetVersion",
    "fmi2SetDebugLogging",
    "fmi2Instantiate",
    "fmi2FreeInstance",
    "fmi2SetupExperiment",
    "fmi2EnterInitializationMode",
    "fmi2ExitInitializationMode",
    "fmi2Terminate",
    "fmi2Reset",
    "fmi2GetReal",
    "fmi2GetInteger",
    "fmi2GetBoolean",
    "fmi2GetString",
    "fmi2SetReal",
    "fmi2SetInteger",
    "fmi2SetBoolean",
    "fmi2SetString",
    "fmi2GetFMUstate",
    "fmi2SetFMUstate",
    "fmi2FreeFMUstate",
    "fmi2SerializedFMUstateSize",
    "fmi2SerializeFMUstate",
    "fmi2DeSerializeFMUstate",
    "fmi2GetDirectionalDerivative",
    "fmi2SetRealInputDerivatives",
    "fmi2GetRealOutputDerivatives",
    "fmi2DoStep",
    "fmi2CancelStep",
    "fmi2GetStatus",
    "fmi2GetRealStatus",
    "fmi2GetIntegerStatus",
    "fmi2GetBooleanStatus",
    "fmi2GetStringStatus",
    "fmi_export_describe",
    "fmi_export_check_schedule_file",
];
