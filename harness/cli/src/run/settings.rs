//! What the arguments of `heliotorque run` mean for an FMU or a system.

use std::path::Path;

use loader::{InputTable, Times};
use model_description::Description;

use super::subject::Subject;
use crate::{args::Run, epoch};

/// What the arguments mean for an FMU or a system.
pub struct Settings {
    /// Start, stop and step.
    pub times: Times,
    /// Values set before the run.
    pub sets: Vec<(String, loader::Value)>,
    /// Inputs over time.
    pub inputs: Option<InputTable>,
    /// What is recorded.
    pub positions: Vec<usize>,
}

impl Settings {
    /// Of the arguments; the error names the flag. What `--input` names may stand in a copy.
    pub fn of(
        subject: &Subject,
        arguments: &Run,
        input_copy: Option<&Path>,
    ) -> Result<Self, Box<dyn std::error::Error>> {
        let times = subject.times(arguments)?;
        let described = subject.description();
        let mut sets = Vec::new();
        for setting in &arguments.set {
            sets.extend(loader::parse_assignment(described, &epoch::in_seconds(described, setting)?)?);
        }
        let inputs = arguments.input.as_deref();
        let inputs =
            inputs.map(|path| read_table(described, path, input_copy.unwrap_or(path))).transpose()?;
        let positions =
            selection(described, &arguments.record)?.unwrap_or_else(|| loader::outputs(described));
        Ok(Self { times, sets, inputs, positions })
    }
}

/// Positions of the variables to record; `None` for all outputs.
fn selection(described: &Description, patterns: &[String]) -> Result<Option<Vec<usize>>, loader::Error> {
    if patterns.is_empty() {
        return Ok(None);
    }
    let mut positions = Vec::new();
    for pattern in patterns {
        for position in loader::select_outputs(described, pattern)? {
            if !positions.contains(&position) {
                positions.push(position);
            }
        }
    }
    Ok(Some(positions))
}

/// Reads the input table of a path, from where it stands.
fn read_table(
    described: &Description,
    path: &Path,
    at: &Path,
) -> Result<InputTable, Box<dyn std::error::Error>> {
    let in_file =
        |error: &dyn std::error::Error| format!("{}: {}", path.display(), loader::Error::chain(error));
    let file = files::open(at).map_err(|error| format!("{}: see --input", in_file(&error)))?;
    let mut rows = loader::csv::read_rows(file).map_err(|error| in_file(&error))?;
    let header = if rows.is_empty() { Vec::new() } else { rows.remove(0) };
    Ok(InputTable::parse(described, &header, &rows).map_err(|error| in_file(&error))?)
}
