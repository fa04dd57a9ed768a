//! Records a reference flight.

use crate::{Fmu, InputTable, Options, Recording, Simulation, Times, Value, outputs};
use model_description::{Causality, ScalarVariable, VariableKind, value};

use crate::reference::{
    FOLDER, MANIFEST,
    manifest::{Manifest, ReferenceSimulation, Related},
};

/// Communication steps of a reference flight.
const STEPS: u64 = 40;

/// Deviation that is allowed on another computer, as a fraction of the largest magnitude of a vector or scalar.
///
/// Sine and cosine come from the host's mathematical library; what they differ by in their last digit grows along a flight.
const TOLERANCE: f64 = 1e-9;

/// Why there is no flight.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// The FMU fails in it.
    #[error("its reference flight, the first {STEPS} steps of the default experiment, fails")]
    Flight(#[source] crate::Error),
    /// The inputs do not fit.
    #[error("the inputs of its reference flight: {0}")]
    Inputs(String),
}

/// The files of a reference flight, with their paths in the FMU: the first steps of the default experiment under these inputs.
///
/// `inputs` is a CSV whose times count communication steps; columns that the FMU does not have are left out.
///
/// # Errors
/// An FMU that fails in it.
pub fn record(fmu: &Fmu, inputs: &str) -> Result<Vec<(String, Vec<u8>)>, RecordError> {
    let times = Times::from_fmu(fmu, None, None, None).map_err(RecordError::Flight)?;
    let stop_s = times.point_s(STEPS.min(times.steps()));
    let table = table(fmu, inputs, &times)?;
    // Not every reader of CSV takes texts.
    let is_number = |position: &usize| {
        !matches!(fmu.description().variables[*position].kind, VariableKind::String { .. })
    };
    let options = Options {
        stop_s: Some(stop_s),
        inputs: table.as_ref().map(|(_, table)| table),
        record: Some(outputs(fmu.description()).into_iter().filter(is_number).collect()),
        ..Options::default()
    };
    let Simulation { recording, .. } =
        crate::simulate(fmu, options).map_err(|stopped| RecordError::Flight(stopped.error))?;

    let name = &fmu.co_simulation().map_err(RecordError::Flight)?.model_identifier;
    let mut files = Vec::new();
    let mut manifest = Manifest::default();
    let inputs_name = format!("{name}_in.csv");
    if let Some((text, _)) = &table {
        manifest.related.push(Related {
            kind: "text/csv".to_owned(),
            source: inputs_name.clone(),
            role: "testcase".to_owned(),
            description: "Inputs of the reference flight".to_owned(),
            flight: None,
        });
        files.push((format!("{FOLDER}/{inputs_name}"), text.clone().into_bytes()));
    }
    let outputs_name = format!("{name}_out.csv");
    manifest.related.push(Related {
        kind: "text/csv".to_owned(),
        source: outputs_name.clone(),
        role: "result".to_owned(),
        description: format!(
            "Outputs of the reference flight, {} to {} s in steps of {} s from the start values; to be met to {TOLERANCE:e} of \
             the largest magnitude of each vector or scalar",
            times.start_s, stop_s, times.step_s
        ),
        flight: Some(ReferenceSimulation { tolerance: TOLERANCE, inputs: table.is_some().then_some(inputs_name) }),
    });
    files.push((format!("{FOLDER}/{outputs_name}"), csv(&recording)));
    files.push((format!("{FOLDER}/{MANIFEST}"), manifest.to_xml().into_bytes()));
    Ok(files)
}

fn csv(recording: &Recording) -> Vec<u8> {
    let mut text = Vec::new();
    // A vector takes whatever is written.
    let columns = recording.columns.len();
    let _ = crate::csv::write_header(recording, columns, &mut text);
    let _ = crate::csv::write_rows(recording, columns, 0..recording.times_s.len(), &mut text);
    text
}

/// A table of every input, in s: these inputs, and the others at their start values; `None` where the FMU has none of these.
fn table(fmu: &Fmu, inputs: &str, times: &Times) -> Result<Option<(String, InputTable)>, RecordError> {
    let wrong = |error: &dyn std::error::Error| RecordError::Inputs(crate::Error::chain(error));
    let mut rows = crate::csv::read_rows(inputs.as_bytes()).map_err(|error| wrong(&error))?;
    let Some(header) = rows.first().cloned() else { return Ok(None) };
    let kept: Vec<usize> =
        (0..header.len()).filter(|&column| column == 0 || fmu.find(&header[column]).is_some()).collect();
    if kept.len() < 2 {
        return Ok(None);
    }
    let is_other = |variable: &&ScalarVariable| {
        variable.causality == Causality::Input && !header.contains(&variable.name)
    };
    let others: Vec<(&str, String)> = fmu
        .description()
        .variables
        .iter()
        .filter(is_other)
        .filter_map(|variable| Some((variable.name.as_str(), start(variable)?)))
        .collect();
    for (line, row) in rows.iter_mut().enumerate() {
        *row = kept.iter().filter_map(|&column| row.get(column).cloned()).collect();
        row.extend(others.iter().map(|(name, start)| match line {
            0 => (*name).to_owned(),
            _ => start.clone(),
        }));
    }
    let header = rows.remove(0);
    for row in &mut rows {
        let Some(cell) = row.first_mut() else { continue };
        let steps = cell.parse::<u64>().map_err(|error| wrong(&error))?;
        *cell = times.point_s(steps.min(times.steps())).to_string();
    }
    let table = InputTable::parse(fmu.description(), &header, &rows).map_err(|error| wrong(&error))?;
    let lines = std::iter::once(&header).chain(&rows).map(|cells| format!("{}\n", cells.join(",")));
    Ok(Some((lines.collect(), table)))
}

/// The start value of a number.
fn start(variable: &ScalarVariable) -> Option<String> {
    let start = value::start(variable).filter(|start| !matches!(start, Value::Text(_)))?;
    Some(start.to_f64().to_string())
}
