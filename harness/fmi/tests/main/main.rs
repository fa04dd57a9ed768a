//! Tests of `fmi`: what it refuses, how it reads names, values and tables, and how it runs the probe FMUs.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::disallowed_methods,
    reason = "tests"
)]

mod archives;
mod instances;
mod interpolation;
mod names;
mod simulations;
mod tables;
mod times;

use std::path::{Path, PathBuf};

use fmi::{Binary, Fmu};
use model_description::{
    Causality, CoSimulation, DefaultExperiment, Description, DisplayUnit, EnumerationItem, RealAttributes,
    ScalarVariable, SimpleType, SimpleTypeKind, Unit, Variability, VariableKind, rules,
};

/// A Real with a unit.
pub fn real(name: &str, reference: u32, causality: Causality, variability: Variability) -> ScalarVariable {
    ScalarVariable {
        name: name.to_owned(),
        value_reference: reference,
        description: None,
        causality,
        variability,
        initial: None,
        can_handle_multiple_set_per_time_instant: None,
        kind: VariableKind::Real {
            start: matches!(causality, Causality::Input | Causality::Parameter).then_some(0.0),
            declared_type: None,
            attributes: RealAttributes {
                unit: Some("m".to_owned()),
                display_unit: Some("cm".to_owned()),
                ..RealAttributes::default()
            },
            derivative: None,
            reinit: None,
        },
        annotation: None,
    }
}

/// A description of a few variables, enough for names, values and tables.
pub fn description() -> Description {
    let [fixed, discrete] =
        [(Causality::Parameter, Variability::Fixed), (Causality::Input, Variability::Discrete)];
    let other = |name, reference, (causality, variability), kind| ScalarVariable {
        kind,
        ..real(name, reference, causality, variability)
    };
    let (declared_type, quantity, min, max) = (None, None, None, None);
    let mode = VariableKind::Enumeration {
        start: Some(1),
        declared_type: "Mode".to_owned(),
        quantity: None,
        min,
        max,
    };
    let turns = VariableKind::Integer { start: Some(0), declared_type: None, quantity, min, max };
    let text = VariableKind::String { start: Some("Ship".to_owned()), declared_type: None };
    let on = VariableKind::Boolean { start: Some(false), declared_type };
    let variables = vec![
        real("ship.mass", 0, Causality::Parameter, Variability::Tunable),
        real("ship.arm[1]", 1, Causality::Parameter, Variability::Fixed),
        real("ship.arm[2]", 2, Causality::Parameter, Variability::Fixed),
        real("ship.arm[3]", 3, Causality::Parameter, Variability::Fixed),
        real("drive.push", 4, Causality::Input, Variability::Continuous),
        real("drive.held", 5, Causality::Input, Variability::Discrete),
        other("drive.on", 0, discrete, on),
        other("drive.mode", 0, fixed, mode),
        other("drive.turns", 1, fixed, turns),
        other("ship.name", 0, fixed, text),
        real("position[1]", 6, Causality::Output, Variability::Continuous),
        real("position[2]", 7, Causality::Output, Variability::Continuous),
    ];
    let display = |name: &str, factor, offset| DisplayUnit { name: name.to_owned(), factor, offset };
    Description {
        model_name: "Ship".to_owned(),
        guid: "{ship}".to_owned(),
        co_simulation: Some(CoSimulation {
            model_identifier: "Ship".to_owned(),
            can_handle_variable_communication_step_size: true,
            ..CoSimulation::default()
        }),
        units: vec![Unit {
            name: "m".to_owned(),
            base: None,
            display_units: vec![
                display("cm", 100.0, 0.0),
                display("above sea", 1.0, -500.0),
                display("cm above sea", 100.0, -50_000.0),
            ],
        }],
        types: vec![SimpleType {
            name: "Mode".to_owned(),
            description: None,
            kind: SimpleTypeKind::Enumeration {
                quantity: None,
                items: [("coast", 1), ("burn", 7)]
                    .map(|(name, value)| EnumerationItem { name: name.to_owned(), value, description: None })
                    .to_vec(),
            },
        }],
        default_experiment: Some(DefaultExperiment {
            start_time: Some(0.0),
            stop_time: Some(10.0),
            tolerance: None,
            step_size: Some(0.1),
        }),
        structure: rules::structure(&variables),
        variables,
        ..Description::default()
    }
}

/// An FMU folder without a library.
pub fn folder(description: &Description) -> (tempfile::TempDir, Fmu) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("modelDescription.xml"), model_description::to_xml(description))
        .unwrap();
    let fmu = Fmu::open(folder.path()).unwrap();
    (folder, fmu)
}

/// The shared library of the probe models, or a line that gives the reason why a test is left out.
pub fn probe_library() -> Option<PathBuf> {
    let path = std::env::var_os("HELIOTORQUE_PROBE_LIBRARY").map(PathBuf::from);
    if path.is_none() {
        assert!(std::env::var_os("CI").is_none(), "HELIOTORQUE_PROBE_LIBRARY is not set");
        eprintln!("skipped: HELIOTORQUE_PROBE_LIBRARY is not set: run `cargo xtask test`");
    }
    path
}

/// An unpacked FMU of a probe model.
pub fn probe(model: &str) -> Option<(tempfile::TempDir, Fmu)> {
    Some(probe_from(&probe_library()?, model))
}

fn probe_from(library: &Path, model: &str) -> (tempfile::TempDir, Fmu) {
    let described = Binary::load(library).unwrap().describe(model, None, None).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let binaries = folder.path().join("binaries").join(fmi::platform_folders()[0]);
    std::fs::create_dir_all(&binaries).unwrap();
    std::fs::copy(library, binaries.join(format!("{model}{}", std::env::consts::DLL_SUFFIX))).unwrap();
    std::fs::write(folder.path().join("modelDescription.xml"), &described.xml).unwrap();
    if let Some(file) = &described.setup_file {
        std::fs::create_dir_all(folder.path().join("resources")).unwrap();
        std::fs::write(folder.path().join("resources").join(file), &described.default_setup).unwrap();
    }
    let fmu = Fmu::open(folder.path()).unwrap();
    (folder, fmu)
}
