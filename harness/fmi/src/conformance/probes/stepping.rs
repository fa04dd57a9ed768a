//! The default experiment, simulated.

use crate::{Fmu, Options, Status};
use model_description::{ScalarVariable, VariableKind, value::items};

use crate::conformance::{
    experiment,
    findings::{Findings, Outcome},
};

/// Runs the default experiment, or a hundredth of it if it is long, under the strict call checker.
pub(crate) fn simulation(findings: &mut Findings<'_>) -> Outcome {
    /// Steps enough to see a model at work, few enough to wait for.
    const LONGEST: u64 = 2000;
    let fmu = findings.fmu;
    let times = experiment::times(fmu)?;
    let stop_s = times.point_s(times.steps().min(LONGEST));
    let options = Options { stop_s: Some(stop_s), instance: experiment::strict(), ..Options::default() };
    let simulation = crate::simulate(fmu, options).map_err(|stopped| stopped.error)?;
    let recording = simulation.recording;
    let steps = recording.times_s.len().saturating_sub(1);
    findings.good(format!("{steps} steps of {} s", times.step_s));
    for (name, column) in recording.names.iter().zip(&recording.columns) {
        let Some(variable) = fmu.find(name) else { continue };
        let values = column.numbers();
        if matches!(column, crate::Column::Real(_))
            && let Some(row) = values.iter().position(|value| !value.is_finite())
        {
            findings.bad(format!("{name} is {} at {} s", values[row], recording.times_s[row]));
        }
        let (low, high) = limits(fmu, variable);
        if let Some(row) = values.iter().position(|value| *value < low || *value > high) {
            let at_s = recording.times_s[row];
            let value = values[row];
            findings.note(format!("{name} is {value} at {at_s} s, outside its limits {low} to {high}"));
        }
    }
    let troubled =
        simulation.messages.iter().find(|message| !matches!(message.status, Status::Ok | Status::Warning));
    if let Some(message) = troubled {
        findings.note(format!("logged on the way: {message}"));
    }
    Ok(())
}

fn limits(fmu: &Fmu, variable: &ScalarVariable) -> (f64, f64) {
    let between =
        |min: Option<f64>, max: Option<f64>| (min.unwrap_or(f64::NEG_INFINITY), max.unwrap_or(f64::INFINITY));
    match &variable.kind {
        VariableKind::Real { attributes, .. } => between(attributes.min, attributes.max),
        VariableKind::Integer { min, max, .. } => between(min.map(f64::from), max.map(f64::from)),
        VariableKind::Enumeration { .. } => {
            let numbers = items(fmu.description(), variable).iter().map(|item| f64::from(item.value));
            numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), n| (low.min(n), high.max(n)))
        }
        VariableKind::Boolean { .. } | VariableKind::String { .. } => between(None, None),
    }
}
