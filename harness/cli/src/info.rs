//! `heliotorque info`: what an FMU is, takes and gives; what a system joins.

mod system;

use std::process::ExitCode;

use loader::Fmu;
use model_description::{
    Causality, CoSimulation, Description, ScalarVariable, SimpleTypeKind, Variability, VariableKind,
};
use systems::System;

use crate::{args::Info, coefficients, ephemeris, epoch, outcome::Outcome, timeline};

/// Prints the tables.
pub fn run(arguments: &Info) -> Outcome {
    if systems::is_system(&arguments.fmu) {
        return of_system(arguments);
    }
    let fmu = Fmu::open(&arguments.fmu)?;
    if arguments.coefficients {
        terminal::print(&coefficients::text(&fmu, &arguments.set)?)?;
        return Ok(ExitCode::SUCCESS);
    }
    let description = fmu.description();
    let text = if arguments.only.is_empty() {
        let mut text = vec![summary(&fmu), capabilities(&fmu)];
        if arguments.variables {
            let all: Vec<usize> = (0..description.variables.len()).collect();
            text.push(units(description));
            text.extend(enumerations(description, &all));
            text.push(variables(description, &all));
        }
        text
    } else {
        let mut positions = Vec::new();
        for pattern in &arguments.only {
            for position in fmu.select(pattern)? {
                if !positions.contains(&position) {
                    positions.push(position);
                }
            }
        }
        let mut text = vec![variables(description, &positions)];
        text.extend(enumerations(description, &positions));
        text
    };
    terminal::print(&text.join("\n\n"))?;
    Ok(ExitCode::SUCCESS)
}

/// Prints what a system joins, and its variables where they are requested.
fn of_system(arguments: &Info) -> Outcome {
    if arguments.coefficients {
        return Err("--coefficients is for an FMU, and this is a system".into());
    }
    let system = System::open(&arguments.fmu)?;
    let description = system.description();
    let mut text = Vec::new();
    let mut positions = Vec::new();
    for pattern in &arguments.only {
        positions.extend(loader::select(description, pattern)?);
    }
    if arguments.only.is_empty() {
        text.push(system::text(&system));
        if arguments.variables {
            positions.extend(0..description.variables.len());
        }
    }
    if !positions.is_empty() {
        text.push(variables(description, &positions));
        text.extend(enumerations(description, &positions));
    }
    terminal::print(&text.join("\n\n"))?;
    Ok(ExitCode::SUCCESS)
}

fn summary(fmu: &Fmu) -> String {
    let description = fmu.description();
    let mut table = terminal::table(&[description.model_name.as_str(), ""]);
    let mut row = |name: &str, value: Option<String>| {
        if let Some(value) = value.filter(|value| !value.is_empty()) {
            table.add_row([name.to_owned(), value]);
        }
    };
    row("description", description.description.clone());
    row("version", description.version.clone());
    row("author", description.author.clone());
    row("copyright", description.copyright.clone());
    row("license", description.license.clone());
    row("made by", description.generation_tool.clone());
    row("GUID", Some(description.guid.clone()));
    row("variables", Some(count_by_causality(description)));
    if let Some(experiment) = description.default_experiment {
        let time = |name: &str, value: Option<f64>| {
            value.map(|value| format!("{name} {} s", terminal::short(value)))
        };
        let times: Vec<String> = [
            time("start", experiment.start_time),
            time("stop", experiment.stop_time),
            time("step", experiment.step_size),
            experiment.tolerance.map(|tolerance| format!("tolerance {}", terminal::short(tolerance))),
        ]
        .into_iter()
        .flatten()
        .collect();
        row("default experiment", Some(times.join(", ")));
    }
    let platforms = match fmu.binary_path() {
        Ok(path) => {
            let shown = path.strip_prefix(fmu.folder()).unwrap_or(&path).display().to_string();
            format!("{shown} (for this computer)")
        }
        Err(error) => error.to_string(),
    };
    row("library", Some(platforms));
    row(
        "timeline",
        timeline::of(fmu).map(|read| match read {
            Ok(timeline) => timeline::summary(&timeline),
            Err(problems) => format!("with {} problems: see `heliotorque check`", problems.lines().count()),
        }),
    );
    row(
        "ephemeris",
        ephemeris::of(fmu).map(|read| match read {
            Ok(carried) => ephemeris::summary(&carried),
            Err(problems) => format!("with {} problems: see `heliotorque check`", problems.lines().count()),
        }),
    );
    if description.model_exchange.is_some() {
        row("also", Some("model exchange, which is not used here".to_owned()));
    }
    table.to_string()
}

fn count_by_causality(description: &Description) -> String {
    let count = |causality: Causality| {
        description.variables.iter().filter(|variable| variable.causality == causality).count()
    };
    let parts: Vec<String> = [
        (Causality::Parameter, "parameters"),
        (Causality::CalculatedParameter, "calculated parameters"),
        (Causality::Input, "inputs"),
        (Causality::Output, "outputs"),
        (Causality::Local, "locals"),
        (Causality::Independent, "independent"),
    ]
    .into_iter()
    .filter(|(causality, _)| count(*causality) > 0)
    .map(|(causality, name)| format!("{} {name}", count(causality)))
    .collect();
    parts.join(", ")
}

fn capabilities(fmu: &Fmu) -> String {
    let Some(flags) = &fmu.description().co_simulation else {
        return "No co-simulation: this FMU cannot be stepped here.".to_owned();
    };
    let mut table = terminal::table(&["co-simulation", ""]);
    table.add_row(["modelIdentifier".to_owned(), flags.model_identifier.clone()]);
    for (name, value) in self::flags(flags) {
        table.add_row([name, if value { "yes" } else { "no" }]);
    }
    table.add_row(["maxOutputDerivativeOrder".to_owned(), flags.max_output_derivative_order.to_string()]);
    table.to_string()
}

/// The capability flags by the standard's names.
pub fn flags(flags: &CoSimulation) -> [(&'static str, bool); 9] {
    [
        ("canHandleVariableCommunicationStepSize", flags.can_handle_variable_communication_step_size),
        ("canInterpolateInputs", flags.can_interpolate_inputs),
        ("canGetAndSetFMUstate", flags.can_get_and_set_fmu_state),
        ("canSerializeFMUstate", flags.can_serialize_fmu_state),
        ("providesDirectionalDerivative", flags.provides_directional_derivative),
        ("canRunAsynchronuously", flags.can_run_asynchronuously),
        ("canBeInstantiatedOnlyOncePerProcess", flags.can_be_instantiated_only_once_per_process),
        ("canNotUseMemoryManagementFunctions", flags.can_not_use_memory_management_functions),
        ("needsExecutionTool", flags.needs_execution_tool),
    ]
}

fn units(description: &Description) -> String {
    let mut table = terminal::table(&["unit", "also shown as"]);
    for unit in &description.units {
        let displays: Vec<&str> = unit.display_units.iter().map(|display| display.name.as_str()).collect();
        table.add_row([unit.name.clone(), displays.join(", ")]);
    }
    table.to_string()
}

/// The items of the options that these variables take.
fn enumerations(description: &Description, positions: &[usize]) -> Option<String> {
    let is_taken = |name: &str| {
        positions.iter().any(|&position| match &description.variables[position].kind {
            VariableKind::Enumeration { declared_type, .. } => declared_type == name,
            _ => false,
        })
    };
    let mut table = terminal::table(&["option", "item", "number", "meaning"]);
    for simple_type in description.types.iter().filter(|it| is_taken(&it.name)) {
        let SimpleTypeKind::Enumeration { items, .. } = &simple_type.kind else { continue };
        for (index, item) in items.iter().enumerate() {
            table.add_row([
                if index == 0 { simple_type.name.clone() } else { String::new() },
                item.name.clone(),
                item.value.to_string(),
                item.description.clone().unwrap_or_default(),
            ]);
        }
    }
    (!table.is_empty()).then(|| table.to_string())
}

fn variables(description: &Description, positions: &[usize]) -> String {
    let mut table = terminal::table(&["variable", "causality", "start", "unit", "description"]);
    for &position in positions {
        let variable = &description.variables[position];
        table.add_row([
            variable.name.clone(),
            causality(variable),
            start(description, variable),
            loader::unit(description, variable).unwrap_or_default().to_owned(),
            variable.description.clone().unwrap_or_default(),
        ]);
    }
    table.to_string()
}

/// Causality, with what the variability adds to it.
pub fn causality(variable: &ScalarVariable) -> String {
    let name = match variable.causality {
        Causality::Parameter => "parameter",
        Causality::CalculatedParameter => "calculated parameter",
        Causality::Input => "input",
        Causality::Output => "output",
        Causality::Local => "local",
        Causality::Independent => "independent",
    };
    match (variable.causality, variable.variability) {
        (Causality::Parameter, Variability::Tunable) => "tunable parameter".to_owned(),
        (_, Variability::Constant) => format!("constant {name}"),
        (Causality::Input | Causality::Output, Variability::Discrete) => format!("{name}, discrete"),
        _ => name.to_owned(),
    }
}

/// The start value, in the variable's unit, with the display unit or date behind it and the item's name.
pub fn start(description: &Description, variable: &ScalarVariable) -> String {
    match &variable.kind {
        VariableKind::Real { start: Some(start), .. } => {
            let own = terminal::short(*start);
            let date = epoch::is_epoch(description, variable).then(|| epoch::date(*start)).flatten();
            if let Some(date) = date {
                return format!("{start} ({date})");
            }
            match loader::display_unit(description, variable) {
                Some((name, factor, offset)) if *start != 0.0 => {
                    format!("{own} ({} {name})", terminal::short(factor * start + offset))
                }
                _ => own,
            }
        }
        VariableKind::Integer { start: Some(start), .. } => start.to_string(),
        VariableKind::Boolean { start: Some(start), .. } => start.to_string(),
        VariableKind::String { start: Some(start), .. } => format!("{start:?}"),
        VariableKind::Enumeration { start: Some(start), declared_type, .. } => {
            let item = description.types.iter().find_map(|simple_type| match &simple_type.kind {
                SimpleTypeKind::Enumeration { items, .. } if simple_type.name == *declared_type => {
                    items.iter().find(|item| item.value == *start)
                }
                _ => None,
            });
            item.map_or_else(|| start.to_string(), |item| format!("{start} ({})", item.name))
        }
        _ => String::new(),
    }
}
