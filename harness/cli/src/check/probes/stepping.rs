//! Steps: the default experiment, and times that test how an FMU compares times.

use fmi_export::call_table::State;
use loader::{Fmu, Options, Status, Value};
use model_description::{SimpleTypeKind, VariableKind};

use super::{
    Finding, Findings,
    bench::{self, STEPS},
};

/// Flies the default experiment, or a hundredth of it if it is long, under the strict call checker.
pub fn flight(fmu: &Fmu) -> Findings {
    /// Steps enough to see a model at work, few enough to wait for.
    const LONGEST: u64 = 2000;
    let times = bench::times(fmu)?;
    let stop_s = times.point_s(times.steps().min(LONGEST));
    let options = Options { stop_s: Some(stop_s), instance: bench::strict(), ..Options::default() };
    let flight = match loader::simulate(fmu, options) {
        Ok(flight) => flight,
        Err(stopped) => return Err(stopped.error),
    };
    let recording = flight.recording;
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
        flight.messages.iter().find(|message| !matches!(message.status, Status::Ok | Status::Warning));
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

/// Times as masters really give them, and times that are wrong.
pub fn times(fmu: &Fmu) -> Findings {
    let times = bench::times(fmu)?;
    let mut findings = Vec::new();
    let variable_steps = fmu.co_simulation()?.can_handle_variable_communication_step_size;

    // A master that adds up its steps drifts by rounding.
    let mut instance = bench::ready(fmu, &bench::strict())?;
    let step_s = (times.stop_s - times.start_s) / 1000.0 / 3.0;
    let step_s = if variable_steps { step_s } else { times.step_s };
    let count = (((times.stop_s - times.start_s) / step_s).floor() as u64).min(500);
    let mut time_s = times.start_s;
    let outcome = (0..count).try_for_each(|_| {
        instance.do_step(time_s, step_s, false)?;
        time_s += step_s;
        Ok::<(), loader::Error>(())
    });
    findings.push(verdict("accepts communication points that carry the rounding of a sum", outcome));

    let mut instance = bench::ready(fmu, &bench::strict())?;
    let outcome = (0..STEPS.min(times.steps() - 1)).try_for_each(|k| {
        // Off by one in the last place, to either side.
        let exact_s = times.point_s(k);
        let time_s = match k % 3 {
            1 => exact_s.next_up(),
            2 => exact_s.next_down(),
            _ => exact_s,
        };
        instance.do_step(time_s, times.step_s, false)
    });
    findings.push(verdict("accepts communication points that are off in the last place", outcome));

    if variable_steps {
        let mut instance = bench::ready(fmu, &bench::strict())?;
        let mut time_s = times.start_s;
        let outcome = [1.0, 0.1, 0.37, 1e-3, 0.5].into_iter().try_for_each(|part| {
            let end_s = (time_s + part * times.step_s).min(times.stop_s);
            if end_s > time_s {
                instance.do_step(time_s, end_s - time_s, false)?;
                time_s = end_s;
            }
            Ok::<(), loader::Error>(())
        });
        findings.push(verdict("accepts steps of changing size", outcome));
    } else {
        findings.push(Finding::skipped("steps of changing size: it does not claim to take them"));
    }

    let step_s = times.step_s;
    let wrong: [(&str, f64, f64); 6] = [
        ("a step from a time that is not its own", times.start_s + 0.5 * step_s, step_s),
        ("a step from before its own time", times.start_s - step_s, step_s),
        ("a step of no length", times.start_s, 0.0),
        ("a step backwards", times.start_s, -step_s),
        ("a step of NaN", times.start_s, f64::NAN),
        ("a step from an infinite time", f64::INFINITY, step_s),
    ];
    for (what, time_s, step_s) in wrong {
        let mut instance = bench::ready(fmu, &bench::lawless())?;
        findings.push(refused(what, instance.do_step(time_s, step_s, false)));
    }
    let mut instance = bench::ready(fmu, &bench::lawless())?;
    let span_s = times.stop_s - times.start_s;
    findings.push(refused(
        "a step past the stop time it was given (2.1.6)",
        instance.do_step(times.start_s, 1.5 * span_s, false),
    ));
    let mut instance = bench::at(fmu, &bench::lawless(), State::Instantiated)?;
    if let Some(instance) = &mut instance {
        let outcome = instance.setup_experiment(None, f64::NAN, None).and_then(|()| {
            instance.enter_initialization_mode()?;
            instance.exit_initialization_mode()
        });
        findings.push(refused("a start time that is NaN", outcome));
    }
    Ok(findings)
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
