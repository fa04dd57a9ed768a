//! Variables: start values, limits, references, and derivatives.

use crate::{Instance, Status, Value};
use model_description::call_table::{Condition, State};
use model_description::{BaseType, Causality, Initial, Variability, VariableKind, rules, value::start};

use crate::conformance::{
    experiment,
    findings::{Findings, Outcome},
};

/// Start values read back, limits are kept, unknown references refused.
pub(crate) fn probe(findings: &mut Findings<'_>) -> Outcome {
    start_values(findings)?;
    limits(findings)?;
    references(findings)
}

fn start_values(findings: &mut Findings<'_>) -> Outcome {
    let fmu = findings.fmu;
    let mut instance = experiment::ready(fmu, &experiment::strict())?;
    let mut checked = 0;
    for variable in &fmu.description().variables {
        let exact = rules::effective_initial(variable) == Some(Initial::Exact)
            || variable.causality == Causality::Input;
        let (true, Some(expected)) = (exact, start(variable)) else { continue };
        let found = instance.get_variable(variable)?;
        checked += 1;
        if !same(&found, &expected) {
            findings.bad(format!("{} starts at {found}, its XML has {expected}", variable.name));
        }
    }
    findings.good(format!("{checked} start values read back as in the XML"));
    Ok(())
}

/// Whether two values are one; a NaN is itself.
fn same(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Real(a), Value::Real(b)) => a.to_bits() == b.to_bits() || a == b,
        (a, b) => a == b,
    }
}

/// Inputs, else parameters, with limits: just outside is refused, the instance continues, nothing is written.
fn limits(findings: &mut Findings<'_>) -> Outcome {
    let fmu = findings.fmu;
    let mut tried = 0;
    for variable in &fmu.description().variables {
        if tried >= 20 || !Condition::SettableInInitialization.admits(variable, false) {
            continue;
        }
        let outside = match &variable.kind {
            VariableKind::Real { attributes, .. } => attributes
                .max
                .filter(|max| max.abs() < 1e300)
                .map(|max| Value::Real(max + max.abs().max(1.0)))
                .or_else(|| {
                    let min = attributes.min.filter(|min| min.abs() < 1e300);
                    min.map(|min| Value::Real(min - min.abs().max(1.0)))
                }),
            VariableKind::Integer { max, .. } => max.and_then(|max| max.checked_add(1)).map(Value::Integer),
            VariableKind::Enumeration { .. } => Some(Value::Integer(i32::MAX)),
            _ => None,
        };
        let Some(outside) = outside else { continue };
        tried += 1;
        let mut instance = experiment::at(fmu, &experiment::unchecked(), State::InitializationMode)?;
        let what = format!("{}={outside}, outside its limits", variable.name);
        findings.refused(&what, instance.set_variable(variable, &outside));
    }
    let real_input = fmu.description().variables.iter().find(|variable| {
        variable.causality == Causality::Input && matches!(variable.kind, VariableKind::Real { .. })
    });
    if let Some(input) = real_input {
        let nan = Value::Real(f64::NAN);
        findings
            .try_refused(&format!("{}=NaN", input.name), |instance| instance.set_variable(input, &nan))?;
    }
    if tried == 0 {
        findings.skipped("limits: no variable that can be set has any");
    }
    Ok(())
}

fn references(findings: &mut Findings<'_>) -> Outcome {
    let fmu = findings.fmu;
    let [reals, ..] = experiment::references(fmu, Causality::Input);
    let unknown = |base: BaseType| {
        let used = fmu.description().variables.iter().filter(|it| it.kind.base_type() == base);
        used.map(|it| it.value_reference)
            .max()
            .and_then(|highest| highest.checked_add(1000))
            .unwrap_or(u32::MAX)
    };
    let no_real = unknown(BaseType::Real);
    findings.try_refused("reading a Real reference it does not have", |instance| {
        instance.get_reals(&[no_real], &mut [0.0])
    })?;
    findings.try_refused("reading a Boolean reference it does not have", |instance| {
        instance.get_booleans(&[unknown(BaseType::Boolean)], &mut [0])
    })?;
    if let Some(&known) = reals.first() {
        let mut instance = experiment::ready(fmu, &experiment::unchecked())?;
        let mut before = [0.0];
        instance.get_reals(&[known], &mut before)?;
        let value = before[0] + 1e-3;
        let outcome = instance.set_reals(&[known, no_real], &[value, 1.0]);
        let was_refused = outcome.is_err();
        findings.refused("a vector to set with one reference it does not have", outcome);
        let mut after = [0.0];
        if was_refused && instance.get_reals(&[known], &mut after).is_ok() {
            let text = "a refused vector leaves nothing written";
            if after[0].to_bits() == before[0].to_bits() {
                findings.good(text);
            } else {
                findings.note(format!("not so: {text}: the first element is {}", after[0]));
            }
        }
    }
    let constant = fmu.description().variables.iter().find(|it| it.variability == Variability::Constant);
    if let Some((constant, value)) = constant.and_then(|it| Some((it, start(it)?))) {
        findings.try_refused("setting a constant", |instance| instance.set_variable(constant, &value))?;
    }
    Ok(())
}

/// Derivatives of inputs and outputs, and directional ones.
pub(crate) fn derivatives(findings: &mut Findings<'_>) -> Outcome {
    let fmu = findings.fmu;
    let flags = fmu.co_simulation()?;
    let inputs = experiment::continuous(fmu, Causality::Input);
    let outputs = experiment::continuous(fmu, Causality::Output);
    match inputs.first() {
        Some(&input) if flags.can_interpolate_inputs => {
            let mut instance = experiment::ready(fmu, &experiment::strict())?;
            let outcome = instance
                .set_input_derivatives(&[input, input], &[1, 2], &[1e-9, 0.0])
                .and_then(|()| experiment::simulate(&mut instance, 0, 2));
            findings.done("takes first and second input derivatives and steps on", outcome);
            findings.try_refused("an input derivative of order 0", |instance| {
                instance.set_input_derivatives(&[input], &[0], &[1.0])
            })?;
        }
        _ => findings.skipped("input derivatives: not claimed, or no continuous Real input"),
    }
    match outputs.first() {
        Some(_) if flags.max_output_derivative_order > 0 => {
            let order = i32::try_from(flags.max_output_derivative_order).unwrap_or(i32::MAX);
            let mut instance = experiment::ready(fmu, &experiment::strict())?;
            experiment::simulate(&mut instance, 0, 2)?;
            let mut values = vec![f64::NAN; outputs.len()];
            let orders = vec![order; outputs.len()];
            instance.take_messages();
            let outcome = instance.get_output_derivatives(&outputs, &orders, &mut values);
            let claim = format!("gives output derivatives of order {order}");
            let warning = instance.take_messages().into_iter().find(|it| it.status == Status::Warning);
            match warning {
                Some(warning) => findings.bad(format!("not so: {claim}: {}", warning.text)),
                None => findings.done(&claim, outcome),
            }
            let finite = values.iter().all(|value| value.is_finite());
            findings.expect(finite, "every output derivative is finite");
            let mut instance = experiment::ready(fmu, &experiment::unchecked())?;
            experiment::simulate(&mut instance, 0, 1)?;
            let outcome = instance.get_output_derivatives(&outputs[..1], &[0], &mut [0.0]);
            findings.refused("an output derivative of order 0", outcome);
        }
        _ => findings.skipped("output derivatives: not claimed, or no continuous Real output"),
    }
    if flags.provides_directional_derivative && !inputs.is_empty() && !outputs.is_empty() {
        let mut instance = experiment::ready(fmu, &experiment::strict())?;
        directional(findings, &mut instance, &outputs, &inputs)
    } else {
        findings.skipped("directional derivatives: not claimed");
        Ok(())
    }
}

fn directional(
    findings: &mut Findings<'_>,
    instance: &mut Instance,
    outputs: &[u32],
    inputs: &[u32],
) -> Outcome {
    let mut result = vec![f64::NAN; outputs.len()];
    for (index, _) in inputs.iter().enumerate() {
        let mut seed = vec![0.0; inputs.len()];
        seed[index] = 1.0;
        instance.directional_derivative(outputs, inputs, &seed, &mut result)?;
        if let Some(position) = result.iter().position(|value| !value.is_finite()) {
            findings.bad(format!(
                "d(reference {})/d(reference {}) is {}",
                outputs[position], inputs[index], result[position]
            ));
        }
    }
    // The derivative is linear in its seed.
    let ones = vec![1.0; inputs.len()];
    let twos = vec![2.0; inputs.len()];
    let mut doubled = result.clone();
    instance.directional_derivative(outputs, inputs, &ones, &mut result)?;
    instance.directional_derivative(outputs, inputs, &twos, &mut doubled)?;
    let linear = result.iter().zip(&doubled).all(|(one, two)| (2.0 * one - two).abs() <= 1e-9 * two.abs());
    findings.expect(linear, "directional derivatives are finite and linear in their seed");
    Ok(())
}
