//! The default experiment simulated, and how a call's outcome is judged.

use loader::{Fmu, Options, Status, Value};
use model_description::{SimpleTypeKind, VariableKind};

use super::{Finding, Findings, bench};

/// Runs the default experiment, or a hundredth of it if it is long, under the strict call checker.
pub fn simulation(fmu: &Fmu) -> Findings {
    /// Steps enough to see a model at work, few enough to wait for.
    const LONGEST: u64 = 2000;
    let times = bench::times(fmu)?;
    let stop_s = times.point_s(times.steps().min(LONGEST));
    let options = Options { stop_s: Some(stop_s), instance: bench::strict(), ..Options::default() };
    let simulation = match loader::simulate(fmu, options) {
        Ok(simulation) => simulation,
        Err(stopped) => return Err(stopped.error),
    };
    let recording = simulation.recording;
    let steps = recording.times_s.len().saturating_sub(1);
    let mut findings = vec![Finding::good(format!("{steps} steps of {} s", times.step_s))];
    for (name, column) in recording.names.iter().zip(&recording.columns) {
        let Some(variable) = fmu.find(name) else { continue };
        let values = column.numbers();
        if matches!(column, loader::Column::Real(_))
            && let Some(row) = values.iter().position(|value| !value.is_finite())
        {
            findings.push(Finding::bad(format!("{name} is {} at {} s", values[row], recording.times_s[row])));
        }
        let (low, high) = limits(fmu, &variable.kind);
        if let Some(row) = values.iter().position(|value| *value < low || *value > high) {
            let at_s = recording.times_s[row];
            findings.push(Finding::note(format!(
                "{name} is {} at {at_s} s, outside its limits {low} to {high}",
                values[row]
            )));
        }
    }
    let troubled =
        simulation.messages.iter().find(|message| !matches!(message.status, Status::Ok | Status::Warning));
    if let Some(message) = troubled {
        findings.push(Finding::note(format!("logged on the way: {message}")));
    }
    Ok(findings)
}

fn limits(fmu: &Fmu, kind: &VariableKind) -> (f64, f64) {
    let whole = |limit: &Option<i32>, otherwise: f64| limit.map_or(otherwise, f64::from);
    match kind {
        VariableKind::Real { attributes, .. } => {
            (attributes.min.unwrap_or(f64::NEG_INFINITY), attributes.max.unwrap_or(f64::INFINITY))
        }
        VariableKind::Integer { min, max, .. } => (whole(min, f64::NEG_INFINITY), whole(max, f64::INFINITY)),
        VariableKind::Enumeration { declared_type, .. } => {
            let items = fmu.description().types.iter().find_map(|it| match &it.kind {
                SimpleTypeKind::Enumeration { items, .. } if it.name == *declared_type => Some(items),
                _ => None,
            });
            let numbers = items.into_iter().flatten().map(|item| f64::from(item.value));
            numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), n| (low.min(n), high.max(n)))
        }
        VariableKind::Boolean { .. } | VariableKind::String { .. } => (f64::NEG_INFINITY, f64::INFINITY),
    }
}

/// Good if it was done.
pub fn verdict(what: &str, outcome: Result<(), loader::Error>) -> Finding {
    match outcome {
        Ok(()) => Finding::good(what),
        Err(error) => Finding::bad(format!("not so: {what}\n{error}")),
    }
}

/// Good if it was refused with a status; a note if it was let through.
pub fn refused(what: &str, outcome: Result<(), loader::Error>) -> Finding {
    match outcome {
        Err(error) if matches!(error.status(), Some(Status::Error | Status::Discard)) => {
            Finding::good(format!("refuses {what}"))
        }
        Err(error) if error.status() == Some(Status::Fatal) => {
            Finding::bad(format!("condemns all its instances by fmi2Fatal for {what}"))
        }
        Err(error) => Finding::note(format!("{what}: {error}")),
        Ok(()) => Finding::note(format!("lets through {what}")),
    }
}

/// A value as bits, for comparing.
pub fn same(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Real(a), Value::Real(b)) => a.to_bits() == b.to_bits() || a == b,
        (a, b) => a == b,
    }
}
