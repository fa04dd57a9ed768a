//! Wires FMUs by the names and units of their variables.

use std::path::Path;

use fmi::Fmu;
use model_description::{
    Causality, DefaultExperiment, Description, ScalarVariable, VariableKind, names, value,
};

use crate::{
    connectors::{add_connector, connection},
    error::Error,
    experiment::complete,
    joint::foreign_item,
    merged::{Merged, merge},
    structure::{
        Binding, Component, Connector, ConnectorKind, End, Parameter, ParameterSet, Structure, Written,
    },
    units::shown,
    unread::{Unread, unread},
};

/// An input that was left open.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OpenInput {
    /// Its component.
    pub component: String,
    /// Its name.
    pub input: String,
    /// Why nothing was connected to it.
    pub why: String,
}

/// A wired system.
#[derive(Clone, Debug, PartialEq)]
pub struct Wired {
    /// Its description; the connectors are what is connected, and the outputs that were requested.
    pub structure: Structure,
    /// The inputs that were left open.
    pub left: Vec<OpenInput>,
    /// Options that were set because their inputs are connected, `component.name=item`.
    pub implied: Vec<String>,
    /// Inputs that are connected and not read.
    pub unread: Vec<Unread>,
}

/// Requests beside the connections of equal names.
#[derive(Clone, Debug, Default)]
pub struct Wiring {
    /// Patterns of further outputs to list, `component.variable`.
    pub outputs: Vec<String>,
    /// Patterns of open inputs, parameters and outputs that are connectors of the system too, `component.variable`; each by its
    /// variable's name.
    pub exports: Vec<String>,
    /// Enumerations are no connectors and stay open, for tools that do not know them.
    pub without_enumerations: bool,
    /// Parameters of components, `component.name=value`; written in the variables' own units.
    pub sets: Vec<String>,
}

/// The name of a component of an FMU: its file's, the first letter in lower case.
pub fn component_name(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let mut letters = stem.chars();
    letters.next().map_or_else(String::new, |first| first.to_lowercase().chain(letters).collect())
}

/// Connects every input of a component to the output of another one with its name, or with the name that its FMU annotates, where
/// there is one such output and type, unit and items agree.
///
/// # Errors
/// Names of components that stand twice or are none, patterns that fit nothing, values that no variable takes, FMUs without
/// co-simulation.
pub fn wire(
    name: &str,
    components: &[(String, Fmu)],
    experiment: DefaultExperiment,
    wiring: &Wiring,
) -> Result<Wired, Error> {
    for (number, (component, fmu)) in components.iter().enumerate() {
        if !names::is_c_identifier(component) {
            return Err(Error::Wire(format!(
                "found {component:?} for the name of a component, allowed: letters, digits and _, not \
                 starting with a digit: name={}",
                fmu.source().display()
            )));
        }
        if components[..number].iter().any(|(earlier, _)| earlier == component) {
            return Err(Error::Wire(format!("two components are named {component:?}: write name=FMU")));
        }
        fmu.co_simulation()?;
    }
    let mut wired = Wired {
        structure: Structure {
            name: name.to_owned(),
            components: components
                .iter()
                .map(|(component, _)| Component {
                    name: component.clone(),
                    source: format!("resources/{component}.fmu"),
                    ..Component::default()
                })
                .collect(),
            experiment: complete(experiment, components.iter().map(|(_, fmu)| fmu)),
            ..Structure::default()
        },
        left: Vec::new(),
        implied: Vec::new(),
        unread: Vec::new(),
    };
    bind(&mut wired.structure, components, &wiring.sets)?;
    for (number, (component, fmu)) in components.iter().enumerate() {
        let inputs = fmu.description().variables.iter().filter(|it| it.causality == Causality::Input);
        for input in inputs {
            let found = source(components, number, input);
            let found = found.and_then(|found| match &input.kind {
                VariableKind::Enumeration { .. } if wiring.without_enumerations => {
                    let component = &wired.structure.components[number];
                    Err(format!(
                        "an enumeration, left out: it stands at {}",
                        stands_at(component, fmu, input)
                    ))
                }
                _ => Ok(found),
            });
            match found {
                Ok((from, output)) => {
                    connect(&mut wired.structure, components, (from, output), (number, input))
                }
                Err(why) => wired.left.push(OpenInput {
                    component: component.clone(),
                    input: input.name.clone(),
                    why,
                }),
            }
        }
    }
    for number in 0..components.len() {
        imply(&mut wired, components, number)?;
    }
    let named = components.iter().map(|(component, fmu)| (component.as_str(), fmu));
    let merged = merge(name, DefaultExperiment::default(), named);
    list_outputs(&mut wired.structure, components, wiring, &merged)?;
    export(&mut wired, components, wiring, &merged)?;
    for (component, (_, fmu)) in wired.structure.components.iter_mut().zip(components) {
        component.connectors.sort_by_key(|it| (it.kind == ConnectorKind::Output, fmu.position(&it.name)));
    }
    Ok(wired)
}

/// Sets the options of a component that its connected inputs imply, and tells what is not read all the same.
fn imply(wired: &mut Wired, components: &[(String, Fmu)], number: usize) -> Result<(), Error> {
    let (component, fmu) = &components[number];
    let found = |structure: &Structure| {
        let ends = structure.connections.iter().map(|it| &it.end);
        let own = ends.filter(|end| end.component.as_ref() == Some(component));
        let connected: Vec<&str> = own.map(|end| end.connector.as_str()).collect();
        let at = |option: &str| stands_at_number(&structure.components[number], fmu, option);
        unread(component, fmu.description(), &connected, at)
    };
    for Unread { option, implied, .. } in found(&wired.structure) {
        let is_open = fmu.find(&option).is_some_and(|it| it.causality == Causality::Parameter);
        let is_given = |parameter: &Parameter| parameter.name == option;
        let sets = wired.structure.components[number].bindings.iter().flat_map(|binding| &binding.sets);
        let is_given = sets.flat_map(|set| &set.parameters).any(is_given);
        if let Some(item) = implied.as_ref().filter(|_| is_open && !is_given) {
            let set = format!("{component}.{option}={item}");
            bind(&mut wired.structure, components, std::slice::from_ref(&set))?;
            wired.implied.push(set);
        }
    }
    wired.unread.extend(found(&wired.structure));
    Ok(())
}

/// The number of an option's item: its parameter set's, else its start value.
fn stands_at_number(component: &Component, fmu: &Fmu, option: &str) -> Option<i32> {
    let variable = fmu.find(option)?;
    let name = stands_at(component, fmu, variable);
    value::items(fmu.description(), variable).iter().find(|item| item.name == name).map(|item| item.value)
}

/// The parameter sets of the components, in the variables' own units: not every tool converts.
fn bind(structure: &mut Structure, components: &[(String, Fmu)], sets: &[String]) -> Result<(), Error> {
    for set in sets {
        let refuse = |what: String| Error::Wire(format!("--set {set}: {what}"));
        let all = || components.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(", ");
        let named = set.split_once('.').and_then(|(component, assignment)| {
            Some((components.iter().position(|(name, _)| name == component)?, assignment))
        });
        let (number, assignment) = named.ok_or_else(|| {
            refuse(format!("found no component, allowed: component.name=value of {}", all()))
        })?;
        let description = components[number].1.description();
        let assigned = fmi::assignment(description, assignment).map_err(|error| refuse(error.to_string()))?;
        for assigned in assigned {
            let variable = assigned.variable;
            fmi::set_early(variable).map_err(|error| refuse(error.to_string()))?;
            value::check(description, variable, &assigned.value)
                .map_err(|misfit| refuse(format!("{}: {misfit}", variable.name)))?;
            let value = written(description, variable, assigned.value);
            let component = &mut structure.components[number];
            if component.bindings.is_empty() {
                let source = Some(format!("resources/{}.ssv", component.name));
                let set = ParameterSet { name: component.name.clone(), ..ParameterSet::default() };
                component.bindings.push(Binding { source, sets: vec![set], ..Binding::default() });
            }
            let parameters = &mut component.bindings[0].sets[0].parameters;
            parameters.retain(|known| known.name != variable.name);
            parameters.push(Parameter { name: variable.name.clone(), value, line: 0 });
        }
    }
    Ok(())
}

fn written(description: &Description, variable: &ScalarVariable, given: value::Value) -> Written {
    match given {
        value::Value::Real(value) => Written::Real { value, unit: None },
        value::Value::Boolean(truth) => Written::Boolean(truth),
        value::Value::Text(text) => Written::Text(text),
        value::Value::Integer(number) => {
            let item = value::items(description, variable).iter().find(|item| item.value == number);
            item.map_or(Written::Integer(number), |item| Written::Enumeration(item.name.clone()))
        }
    }
}

/// Returns the item of an enumeration that is not connected: its parameter set's value, else its start value.
fn stands_at(component: &Component, fmu: &Fmu, input: &ScalarVariable) -> String {
    let sets = component.bindings.iter().flat_map(|binding| &binding.sets);
    let set = sets.flat_map(|set| &set.parameters).find(|parameter| parameter.name == input.name);
    if let Some(Parameter { value: Written::Enumeration(item), .. }) = set {
        return item.clone();
    }
    let start = match input.kind {
        VariableKind::Enumeration { start, .. } => start,
        _ => None,
    };
    let items = value::items(fmu.description(), input);
    let item = items.iter().find(|item| Some(item.value) == start);
    item.map_or_else(String::new, |item| item.name.clone())
}

/// The output that an input takes: component and variable; else why there is none.
fn source<'a>(
    components: &'a [(String, Fmu)],
    number: usize,
    input: &ScalarVariable,
) -> Result<(usize, &'a ScalarVariable), String> {
    let named = |name: &str| -> Vec<(usize, &'a ScalarVariable)> {
        let others = components.iter().enumerate().filter(|(other, _)| *other != number);
        let found = others.filter_map(|(other, (_, fmu))| Some((other, fmu.find(name)?)));
        found.filter(|(_, variable)| variable.causality == Causality::Output).collect()
    };
    let mut found = named(&input.name);
    if found.is_empty() {
        let other_name = input.annotation.as_ref().and_then(|it| it.also_called.as_ref());
        found = other_name.map(|name| named(name)).unwrap_or_default();
    }
    match *found.as_slice() {
        [] => Err("no output of that name".to_owned()),
        [(other, output)] => {
            let own = components[number].1.description();
            fits((components[other].1.description(), output), (own, input)).map(|()| (other, output))
        }
        _ => {
            let all: Vec<String> = found
                .iter()
                .map(|(other, output)| format!("{}.{}", components[*other].0, output.name))
                .collect();
            Err(format!("two candidates: {}", all.join(", ")))
        }
    }
}

/// Whether type, unit and items agree.
fn fits(
    (from, output): (&Description, &ScalarVariable),
    (to, input): (&Description, &ScalarVariable),
) -> Result<(), String> {
    let (given, taken) = (output.kind.name(), input.kind.name());
    if given != taken || given == "String" {
        return Err(format!("other type: {given} to {taken}"));
    }
    let unit = |description, variable| value::unit(description, variable).filter(|unit: &&str| *unit != "1");
    if unit(from, output) != unit(to, input) {
        let (given, taken) = (unit(from, output), unit(to, input));
        return Err(format!("other unit: {} to {}", shown(given), shown(taken)));
    }
    match foreign_item(value::items(from, output), value::items(to, input)) {
        Some(item) => Err(format!(
            "other items: {} ({}) of the output is none of {}",
            item.name,
            item.value,
            value::allowed(to, input)
        )),
        None => Ok(()),
    }
}

fn connect(
    structure: &mut Structure,
    components: &[(String, Fmu)],
    (from, output): (usize, &ScalarVariable),
    (to, input): (usize, &ScalarVariable),
) {
    add_connector(structure, components, (from, output), ConnectorKind::Output);
    add_connector(structure, components, (to, input), ConnectorKind::Input);
    let end = |number: usize, variable: &ScalarVariable| End {
        component: Some(components[number].0.clone()),
        connector: variable.name.clone(),
    };
    structure.connections.push(connection(end(from, output), end(to, input)));
}

/// Lists the outputs that patterns name. Tools that cannot connect enumerations refuse them as connectors too.
fn list_outputs(
    structure: &mut Structure,
    components: &[(String, Fmu)],
    wiring: &Wiring,
    Merged { description, origins }: &Merged,
) -> Result<(), Error> {
    for pattern in &wiring.outputs {
        for position in fmi::select_outputs(description, pattern)? {
            let (number, at) = origins[position];
            let variable = &components[number].1.description().variables[at];
            if variable.causality != Causality::Output {
                let name = &description.variables[position].name;
                return Err(Error::Wire(format!("{name}: it is no output, allowed: outputs")));
            }
            let is_enumeration = matches!(variable.kind, VariableKind::Enumeration { .. });
            if !(is_enumeration && wiring.without_enumerations) {
                add_connector(structure, components, (number, variable), ConnectorKind::Output);
            }
        }
    }
    Ok(())
}

/// A variable's name as an identifier: `attitude.q[1]` is `attitude_q_1`. OMSimulator takes what stands before a dot for a
/// component.
fn identifier(name: &str) -> String {
    name.replace(['.', '['], "_").replace(']', "")
}

/// Makes variables that patterns name connectors of the system.
fn export(
    wired: &mut Wired,
    components: &[(String, Fmu)],
    wiring: &Wiring,
    Merged { description, origins }: &Merged,
) -> Result<(), Error> {
    let selected = wiring.exports.iter().map(|pattern| fmi::select_outputs(description, pattern));
    for position in selected.collect::<Result<Vec<_>, _>>()?.concat() {
        let (number, at) = origins[position];
        let variable = &components[number].1.description().variables[at];
        let refuse =
            |what: &str| Error::Wire(format!("--export {}: {what}", description.variables[position].name));
        let kind = match variable.causality {
            Causality::Output => ConnectorKind::Output,
            Causality::Input => ConnectorKind::Input,
            Causality::Parameter => ConnectorKind::Parameter,
            _ => return Err(refuse("it is internal, allowed: outputs, inputs, parameters")),
        };
        if matches!(variable.kind, VariableKind::String { .. }) {
            return Err(refuse("it is a String, which no connector carries"));
        }
        if matches!(variable.kind, VariableKind::Enumeration { .. }) && wiring.without_enumerations {
            continue;
        }
        let structure = &mut wired.structure;
        let inner = End { component: Some(components[number].0.clone()), connector: variable.name.clone() };
        if kind == ConnectorKind::Input && structure.connections.iter().any(|it| it.end == inner) {
            return Err(refuse("it is connected already, allowed: open inputs"));
        }
        let name = identifier(&variable.name);
        if structure.connectors.iter().any(|it| it.name == name) {
            return Err(refuse(&format!(
                "the system has a connector `{name}` already, allowed: one of each name"
            )));
        }
        add_connector(structure, components, (number, variable), kind);
        let known = structure.components[number].connectors.iter().find(|it| it.name == variable.name);
        structure.connectors.extend(known.map(|it| Connector { name: name.clone(), ..it.clone() }));
        let outer = End { component: None, connector: name };
        let (start, end) = if kind == ConnectorKind::Output { (inner, outer) } else { (outer, inner) };
        wired
            .left
            .retain(|left| end.component.as_ref() != Some(&left.component) || left.input != end.connector);
        structure.connections.push(connection(start, end));
    }
    Ok(())
}
