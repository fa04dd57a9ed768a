//! Parameter bindings of a system as values of its FMUs' variables.

use fmi::{Fmu, Value};
use model_description::{ScalarVariable, Unit, value};

use crate::{
    joint::{ConnectedVariable, near},
    own::Own,
    parameter_mapping::Mapped,
    structure::{Linear, Parameter, Structure, Written},
    units::{base, conversion, is_same_dimension, shown},
};

/// A value of a component's variable, by the component's number.
pub(crate) type Assigned = (usize, String, Value);

/// The values of parameters, whose units are defined in `units` or in the system. `component` is where the binding stands; a
/// system's parameters name theirs.
pub(crate) fn values(
    structure: &Structure,
    (fmus, own): (&[Fmu], &[Own]),
    component: Option<usize>,
    units: &[Unit],
    parameters: &[Mapped],
) -> Result<Vec<Assigned>, (u32, String)> {
    let units = [units, &structure.units];
    let mut found = Vec::new();
    for mapped @ Mapped { parameter, is_optional, .. } in parameters {
        let name = parameter.name.as_str();
        let refuse = |what: String| (parameter.line, format!("parameter {name:?}: {what}"));
        let own = own.iter().find(|it| component.is_none() && it.gives() && it.connector.name == name);
        if let Some(own) = own {
            for place in &own.places {
                let (number, position) = place.at;
                let variable = &fmus[number].description().variables[position];
                let value = read(&fmus[number], variable, (mapped, *place), &units).map_err(refuse)?;
                found.push((number, variable.name.clone(), value));
            }
            continue;
        }
        let (number, name) = match component {
            Some(number) => (number, name),
            None => match owner(structure, name) {
                Some(owned) => owned,
                None if *is_optional => continue,
                None => {
                    let all = structure.components.iter().map(|it| it.name.as_str());
                    let near = near(name, all);
                    return Err(refuse(format!(
                        "found no component before the name, allowed: one of {near}"
                    )));
                }
            },
        };
        let fmu = &fmus[number];
        let Some((position, variable)) =
            fmu.description().variables.iter().enumerate().find(|(_, it)| it.name == name)
        else {
            if *is_optional {
                continue;
            }
            let names = fmu.description().variables.iter().map(|variable| variable.name.as_str());
            let near = near(name, names);
            return Err(refuse(format!("{} has no variable {name:?}, near it: {near}", fmu.name())));
        };
        let place = ConnectedVariable { at: (number, position), linear: Linear::IDENTITY };
        let value = read(fmu, variable, (mapped, place), &units).map_err(refuse)?;
        found.push((number, variable.name.clone(), value));
    }
    Ok(found)
}

/// A parameter of one of the system's own connectors at a variable: a number without a unit is in the connector's.
fn in_variables_unit(parameter: &Parameter, place: ConnectedVariable) -> Parameter {
    let value = match parameter.value {
        Written::Real { value, unit: None } => Written::Real { value: place.linear.apply(value), unit: None },
        ref other => other.clone(),
    };
    Parameter { value, ..parameter.clone() }
}

/// The component whose name begins a parameter's, and the rest of the name.
fn owner<'a>(structure: &Structure, name: &'a str) -> Option<(usize, &'a str)> {
    let rest = |component: &str| name.strip_prefix(component)?.strip_prefix('.');
    let named = structure.components.iter().enumerate();
    named
        .filter_map(|(number, it)| rest(&it.name).map(|rest| (it.name.len(), number, rest)))
        .max_by_key(|(length, ..)| *length)
        .map(|(_, number, rest)| (number, rest))
}

fn read(
    fmu: &Fmu,
    variable: &ScalarVariable,
    (mapped, place): (&Mapped, ConnectedVariable),
    units: &[&[Unit]],
) -> Result<Value, String> {
    fmi::set_early(variable).map_err(|error| error.to_string())?;
    let description = fmu.description();
    let parameter = in_variables_unit(&mapped.parameter, place);
    let (found, allowed) = (parameter.value.word(), variable.kind.name());
    let is_item = mapped.is_number && allowed == "Enumeration";
    if found != allowed && !is_item {
        return Err(format!("found type {found}, allowed: {allowed}"));
    }
    let value = match &parameter.value {
        Written::Real { value, unit } => {
            let converted = in_own_unit(fmu, variable, *value, unit.as_deref(), units)?;
            // In the unit of the target, which one of the system's own connectors may have another of.
            let linear = place.linear.inverse().then(mapped.linear).then(place.linear);
            let is_same = mapped.linear == Linear::IDENTITY;
            Value::Real(if is_same { converted } else { linear.apply(converted) })
        }
        Written::Integer(value) => Value::Integer(*value),
        Written::Boolean(value) => Value::Boolean(*value),
        Written::Text(value) => Value::Text(value.clone()),
        Written::Enumeration(name) => {
            let items = value::items(description, variable);
            let item = items.iter().find(|item| item.name == *name).ok_or_else(|| {
                let all = items.iter().map(|item| item.name.as_str());
                format!("found item {name:?}, allowed: {}", near(name, all))
            })?;
            Value::Integer(item.value)
        }
    };
    value::check(description, variable, &value).map_err(|misfit| misfit.to_string())?;
    Ok(value)
}

/// A number in the variable's own unit. Units are those of the files, of the FMU, and the FMU's display units.
fn in_own_unit(
    fmu: &Fmu,
    variable: &ScalarVariable,
    number: f64,
    unit: Option<&str>,
    lists: &[&[Unit]],
) -> Result<f64, String> {
    let description = fmu.description();
    let own = value::unit(description, variable);
    let (Some(unit), Some(own)) = (unit, own) else {
        return match unit {
            Some(unit) if unit != "1" => Err(format!("found unit {unit:?}, allowed: {}", shown(own))),
            _ => Ok(number),
        };
    };
    if unit == own {
        return Ok(number);
    }
    let definition = description.units.iter().find(|it| it.name == own);
    let all: Vec<&[Unit]> = lists.iter().copied().chain([description.units.as_slice()]).collect();
    if let (Some(found), Some(own_base)) = (base(unit, &all), definition.and_then(|it| it.base)) {
        if !is_same_dimension(&found, &own_base) {
            return Err(format!("found unit {unit:?}, which measures something else than {own:?}"));
        }
        return Ok(conversion(&found, &own_base).apply(number));
    }
    let displays = definition.map(|it| it.display_units.as_slice()).unwrap_or_default();
    match displays.iter().find(|display| display.name == unit) {
        Some(display) => Ok((number - display.offset) / display.factor),
        None => Err(format!("found unit {unit:?}, which is not defined, allowed: {own}, units of the files")),
    }
}
