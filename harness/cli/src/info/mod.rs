//! `heliotorque info`: what an FMU is, takes and gives; what a system joins.

mod causality;
mod experiment;
mod json;
mod system;

use std::path::{Path, PathBuf};

use clap::Args;
use files::outcome::{self, Outcome};
use fmi::Fmu;
use inputs::{
    kind, values,
    variables::{VariableRow, rows, selected, start_text, warn_of_repeated},
};
use model_description::{Causality, Description, ScalarVariable, SimpleTypeKind, VariableKind};
use packing::{carried, manual::standard};
use systems::System;

use crate::patience::Patience;
use causality::{CAUSALITIES, causality};
use experiment::times;

/// `heliotorque info`.
#[derive(Debug, Args)]
pub(crate) struct Info {
    /// The FMU, an .fmu file or the folder it was unpacked into; or a system, an .ssp file
    pub fmu: PathBuf,
    /// List the variables too
    #[arg(long)]
    pub variables: bool,
    /// Show only these variables and the options they take: names, vectors, patterns with *
    #[arg(long, value_name = "NAMES")]
    pub only: Vec<String>,
    /// Show what the FMU computes from its parameters: the sunshade's torque coefficients, torque and force by source at
    /// the start, what the wheels guarantee
    #[arg(long, conflicts_with_all = ["variables", "only"])]
    pub coefficients: bool,
    /// Set a parameter before --coefficients; repeatable, written as for `run`: sunshade.shape=cylinder,
    /// 'spacecraft.centerOfMass[3]=-2.54cm'
    #[arg(long, value_name = "NAME=VALUE", requires = "coefficients")]
    pub set: Vec<String>,
    /// Print one JSON object: the description with all variables, or those of --only
    #[arg(long, conflicts_with = "coefficients")]
    pub json: bool,
    /// How long --coefficients waits
    #[command(flatten)]
    pub patience: Patience,
}

/// Prints the tables.
pub(crate) fn run(arguments: &Info) -> Outcome {
    kind::check_archive(&arguments.fmu)?;
    let text = if systems::is_system(&arguments.fmu) {
        if arguments.coefficients {
            return Err("--coefficients is for an FMU, and this is a system".into());
        }
        let system = System::open(&arguments.fmu)?;
        let description = system.description();
        if arguments.json {
            return json(arguments, description, Some(&system));
        }
        match chosen(description, arguments)? {
            Some(tables) => tables,
            None if arguments.variables => {
                let all: Vec<usize> = (0..description.variables.len()).collect();
                [vec![system::text(&system)], variables_and_options(description, &all)].concat()
            }
            None => vec![system::text(&system)],
        }
    } else {
        let fmu = Fmu::open(&arguments.fmu)?;
        let description = fmu.description();
        if arguments.coefficients {
            warn_of_repeated("--set", &arguments.set);
            return outcome::printed(&packing::coefficients::text(&fmu, &arguments.set)?);
        }
        if arguments.json {
            return json(arguments, description, None);
        }
        match chosen(description, arguments)? {
            Some(tables) => tables,
            None => {
                let mut text = vec![summary(&fmu), capabilities(&fmu)];
                if arguments.variables {
                    let all: Vec<usize> = (0..description.variables.len()).collect();
                    text.push(units(description));
                    text.extend(enumerations(description, &all));
                    text.push(variables(description, &all));
                }
                text
            }
        }
    };
    outcome::printed(&text.join("\n\n"))
}

/// Prints the JSON object.
fn json(arguments: &Info, description: &Description, system: Option<&System>) -> Outcome {
    let positions = match &arguments.only[..] {
        [] => (0..description.variables.len()).collect(),
        only => selected(description, &values::all_names(only), fmi::select)?,
    };
    let object = json::object(&arguments.fmu.display().to_string(), description, &positions, system);
    outcome::printed(&serde_json::to_string_pretty(&object)?)
}

/// The tables of what `--only` names, if it is given.
fn chosen(description: &Description, arguments: &Info) -> Result<Option<Vec<String>>, fmi::Error> {
    if arguments.only.is_empty() {
        return Ok(None);
    }
    let positions = selected(description, &values::all_names(&arguments.only), fmi::select)?;
    Ok(Some(variables_and_options(description, &positions)))
}

fn variables_and_options(description: &Description, positions: &[usize]) -> Vec<String> {
    [variables(description, positions)].into_iter().chain(enumerations(description, positions)).collect()
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
        row("default experiment", Some(times(&experiment)));
    }
    let library = match fmu.binary_path() {
        Ok(path) => {
            let shown = path.strip_prefix(fmu.folder()).unwrap_or(&path).display().to_string();
            format!("{shown} (for this computer)")
        }
        Err(error) => error.to_string(),
    };
    row("library", Some(library));
    let requirements = fmu.requirements();
    row("platforms", Some(platforms(requirements.iter().map(|(path, _)| path.as_path()))));
    for (path, read) in requirements {
        let requirements = read.map_or_else(|error| error.to_string(), |it| it.to_string());
        row(&path.display().to_string(), Some(requirements));
    }
    for (file, read) in carried::summaries(fmu) {
        let problems =
            |problems: String| format!("with {} problems: see `heliotorque check`", problems.lines().count());
        row(file.trim_end_matches(".toml"), Some(read.unwrap_or_else(problems)));
    }
    if description.model_exchange.is_some() {
        row("also", Some("model exchange, which is not used here".to_owned()));
    }
    table.to_string()
}

/// The platforms of libraries, by the names of their folders.
fn platforms<'a>(libraries: impl Iterator<Item = &'a Path>) -> String {
    let folders = libraries.filter_map(|path| path.parent().and_then(Path::file_name));
    let mut names: Vec<_> = folders.map(|folder| folder.to_string_lossy().into_owned()).collect();
    names.dedup();
    names.join(", ")
}

fn count_by_causality(description: &Description) -> String {
    let parts = CAUSALITIES.into_iter().filter_map(|(causality, name)| {
        let count = description.variables.iter().filter(|variable| variable.causality == causality).count();
        let plural = if causality == Causality::Independent { "" } else { "s" };
        (count > 0).then(|| format!("{count} {name}{plural}"))
    });
    parts.collect::<Vec<_>>().join(", ")
}

fn capabilities(fmu: &Fmu) -> String {
    let Some(flags) = &fmu.description().co_simulation else {
        return "No co-simulation: this FMU cannot be stepped here.".to_owned();
    };
    let mut table = terminal::table(&["co-simulation", ""]);
    standard::capability_rows(flags).for_each(|(name, value)| table.add_row([name, value.as_str()]));
    table.to_string()
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

/// Columns from which on a description stands beside its variable, and those before it on a narrower terminal.
const WIDE: u16 = 120;
const INDENT: usize = 4;

/// A vector is one row.
fn variables(description: &Description, positions: &[usize]) -> String {
    let chosen: Vec<&ScalarVariable> =
        positions.iter().map(|&position| &description.variables[position]).collect();
    let cells = |row: &VariableRow<'_>| {
        let unit = fmi::unit(description, row.first()).unwrap_or_default();
        [row.name(), causality(row.first()), row.joined(|it| start_text(description, it)), unit.to_owned()]
    };
    let says = |row: &VariableRow<'_>| row.first().description.clone().unwrap_or_default();
    if let Some(columns) = terminal::screen().output_columns.filter(|columns| *columns < WIDE) {
        let lines = rows(&chosen).map(|row| below(&cells(&row), &says(&row), usize::from(columns)));
        return lines.collect::<Vec<_>>().join("\n");
    }
    let mut table = terminal::table(&["variable", "causality", "start", "unit", "description"]);
    for row in rows(&chosen) {
        let [name, causality, start, unit] = cells(&row);
        table.add_row([name, causality, start, unit, says(&row)]);
    }
    table.to_string()
}

/// A variable with its description below it.
fn below([name, causality, start, unit]: &[String; 4], description: &str, columns: usize) -> String {
    let start = if start.is_empty() { String::new() } else { format!("start {start}") };
    let head: Vec<&str> =
        [name.as_str(), causality, &start, unit].into_iter().filter(|text| !text.is_empty()).collect();
    let mut lines = vec![head.join("  "), " ".repeat(INDENT)];
    for word in description.split_whitespace() {
        let last = lines.len() - 1;
        let is_begun = lines[last].len() > INDENT;
        if is_begun && lines[last].chars().count() + 1 + word.chars().count() > columns {
            lines.push(format!("{:INDENT$}{word}", ""));
        } else {
            lines[last].push_str(if is_begun { " " } else { "" });
            lines[last].push_str(word);
        }
    }
    lines.retain(|line| !line.trim().is_empty());
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_narrow_terminal_has_the_description_below() {
        let cells = ["a[1..3]", "output", "", "N.m"].map(str::to_owned);
        assert_eq!(
            below(&cells, "Torque about the centre of mass.", 20),
            "a[1..3]  output  N.m\n    Torque about the\n    centre of mass."
        );
        assert_eq!(
            below(&["b".to_owned(), "input".to_owned(), "4".to_owned(), String::new()], "", 20),
            "b  input  start 4"
        );
    }
}
