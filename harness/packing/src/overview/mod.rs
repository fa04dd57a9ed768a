//! Description of an FMU or a system as text and as a JSON object: what it is, takes and gives.

mod causality;
pub mod experiment;
mod json;
mod variables;

use std::path::Path;

use files::outcome::Refusal;
use fmi::Fmu;
use model_description::{Causality, Description};

use self::{causality::CAUSALITIES, experiment::times};
use crate::{carried, manual::standard};
pub use json::object;
pub use variables::{units, variables_and_options};

/// Table of what an FMU is, and that of what it can.
pub fn tables(fmu: &Fmu) -> [String; 2] {
    [summary(fmu), capabilities(fmu)]
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
            |problems: Refusal| format!("with {} problems: see `heliotorque check`", problems.count);
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
