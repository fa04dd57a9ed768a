//! `heliotorque info`: what an FMU is, takes and gives; what a system joins.

mod system;

use std::path::PathBuf;

use clap::Args;
use files::outcome::{self, Outcome};
use fmi::Fmu;
use inputs::{
    kind, values,
    variables::{selected, warn_of_repeated},
};
use model_description::Description;
use packing::overview::{self, variables_and_options};
use serde_json::json;
use systems::System;

use crate::patience::Patience;

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
            return print_json(arguments, description, Some(&system));
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
            return print_json(arguments, description, None);
        }
        match chosen(description, arguments)? {
            Some(tables) => tables,
            None => {
                let mut text = overview::tables(&fmu).to_vec();
                if arguments.variables {
                    let all: Vec<usize> = (0..description.variables.len()).collect();
                    text.push(overview::units(description));
                    text.extend(variables_and_options(description, &all).into_iter().rev());
                }
                text
            }
        }
    };
    outcome::printed(&text.join("\n\n"))
}

/// Prints the JSON object.
fn print_json(arguments: &Info, description: &Description, system: Option<&System>) -> Outcome {
    let positions = match &arguments.only[..] {
        [] => (0..description.variables.len()).collect(),
        only => selected(description, &values::all_names(only), fmi::select)?,
    };
    let mut object = overview::object(&arguments.fmu.display().to_string(), description, &positions);
    if let Some(system) = system {
        let structure = system.structure();
        let components = structure.components.iter().map(|it| json!({ "name": it.name, "fmu": it.source }));
        object["components"] = components.collect();
        let joined = structure.connections.iter();
        object["connections"] =
            joined.map(|it| json!({ "from": it.start.to_string(), "to": it.end.to_string() })).collect();
    }
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
