//! Connections held against the FMUs they join: names, roles, types, items, units.

use fmi::Fmu;
use model_description::{Causality, EnumerationItem, ScalarVariable, names::similar, value};

use crate::{
    structure::{Connection, Connector, ConnectorKind, End, Linear, Signal, Structure},
    units::{self, base, conversion, is_same_dimension},
};

/// A connection between two variables.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Component and position in its `ModelVariables` of the output.
    pub from: (usize, usize),
    /// Component and position of the input.
    pub to: (usize, usize),
    /// Linear transformation of the value, if any.
    pub linear: Option<Linear>,
}

/// Kind of a connection.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Link {
    /// From variable to variable.
    Joint(Joint),
    /// Between one of the system's own connectors, by its name, and a variable.
    Own(String, ConnectedVariable),
}

/// A variable that one of the system's own connectors stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConnectedVariable {
    /// Component and position in its `ModelVariables`.
    pub at: (usize, usize),
    /// From the connector's number to the variable's, of an output from the variable's to the connector's.
    pub linear: Linear,
}

/// A list of near names for a refusal.
pub(crate) fn near<'a>(name: &str, all: impl Iterator<Item = &'a str> + Clone) -> String {
    let found = similar(name, all.clone());
    let shown: Vec<&str> = if found.is_empty() { all.take(12).collect() } else { found };
    if shown.is_empty() { "none".to_owned() } else { shown.join(", ") }
}

/// Holds a component's connectors against its FMU.
pub(crate) fn check_connector(structure: &Structure, fmu: &Fmu, connector: &Connector) -> Result<(), String> {
    let name = &connector.name;
    let description = fmu.description();
    let Some(variable) = fmu.find(name) else {
        let names = description.variables.iter().map(|variable| variable.name.as_str());
        let model = fmu.name();
        return Err(format!("{model} has no variable of that name, near it: {}", near(name, names)));
    };
    let expected = match connector.kind {
        ConnectorKind::Input => Causality::Input,
        ConnectorKind::Output => Causality::Output,
        ConnectorKind::Parameter => Causality::Parameter,
        ConnectorKind::CalculatedParameter => Causality::CalculatedParameter,
        ConnectorKind::Inout => return Err("found kind inout, allowed for an FMU: input, output".to_owned()),
    };
    if variable.causality != expected {
        let word = connector.kind.word();
        return Err(format!("found kind {word}, the variable is of causality {:?}", variable.causality));
    }
    let Some(signal) = &connector.signal else { return Ok(()) };
    if signal.word() != variable.kind.name() {
        return Err(format!("found type {}, the variable is {}", signal.word(), variable.kind.name()));
    }
    match signal {
        Signal::Real { unit: Some(unit) } => {
            let own = value::unit(description, variable);
            if own == Some(unit) {
                return Ok(());
            }
            let Some(found) = base(unit, &[&structure.units, &description.units]) else {
                return Err(format!(
                    "found unit {unit:?}, which is not defined, allowed: {}",
                    units::shown(own)
                ));
            };
            let own_base = own.and_then(|own| base(own, &[&description.units]));
            if own_base.is_some_and(|own| !is_same_dimension(&own, &found)) {
                let own = units::shown(own);
                return Err(format!("found unit {unit:?}, which measures something else than {own}"));
            }
            Ok(())
        }
        Signal::Enumeration { name } if !structure.enumerations.iter().any(|it| it.name == *name) => {
            let all = structure.enumerations.iter().map(|it| it.name.as_str());
            Err(format!("found Enumeration {name:?}, which is not defined, allowed: {}", near(name, all)))
        }
        _ => Ok(()),
    }
}

/// One end of a connection: component, position, variable, connector.
#[derive(Clone, Copy)]
struct Joined<'a> {
    at: (usize, usize),
    fmu: &'a Fmu,
    variable: &'a ScalarVariable,
    connector: &'a Connector,
}

/// One of the system's own connectors: one that gives is an input or a parameter of the system, one that takes an output.
fn find_own<'a>(structure: &'a Structure, end: &End, gives: bool) -> Result<&'a Connector, String> {
    let name = &end.connector;
    let Some(own) = structure.connectors.iter().find(|it| it.name == *name) else {
        let near = near(name, structure.connectors.iter().map(|it| it.name.as_str()));
        return Err(format!("the system has no connector {name:?} of its own, near it: {near}"));
    };
    let allowed: &[ConnectorKind] =
        if gives { &[ConnectorKind::Input, ConnectorKind::Parameter] } else { &[ConnectorKind::Output] };
    if !allowed.contains(&own.kind) {
        let (place, found) = (if gives { "start" } else { "end" }, own.kind.word());
        let allowed: Vec<&str> = allowed.iter().map(|kind| kind.word()).collect();
        let allowed = allowed.join(", ");
        return Err(format!(
            "at its {place} found the system's own {name} of kind {found}, allowed: {allowed}"
        ));
    }
    Ok(own)
}

fn find<'a>(
    structure: &'a Structure,
    fmus: &'a [Fmu],
    end: &End,
    kind: ConnectorKind,
) -> Result<Joined<'a>, String> {
    let name = end.component.as_deref().unwrap_or_default();
    let Some(number) = structure.components.iter().position(|component| component.name == name) else {
        let all = structure.components.iter().map(|component| component.name.as_str());
        return Err(format!("there is no component {name:?}, allowed: {}", near(name, all)));
    };
    let component = &structure.components[number];
    let fmu = &fmus[number];
    let Some(connector) = component.connectors.iter().find(|it| it.name == end.connector) else {
        let all = component.connectors.iter().map(|it| it.name.as_str());
        let near = near(&end.connector, all);
        return Err(format!("component {name:?} has no connector {:?}, near it: {near}", end.connector));
    };
    if connector.kind != kind {
        let (found, allowed) = (connector.kind.word(), kind.word());
        let place = if kind == ConnectorKind::Output { "start" } else { "end" };
        return Err(format!("at its {place} found {end} of kind {found}, allowed: {allowed}"));
    }
    let position = fmu.position(&end.connector).unwrap_or_default();
    Ok(Joined { at: (number, position), fmu, variable: &fmu.description().variables[position], connector })
}

/// Holds a connection against the FMUs.
pub(crate) fn link(structure: &Structure, fmus: &[Fmu], connection: &Connection) -> Result<Link, String> {
    let Connection { start, end, .. } = connection;
    match (&start.component, &end.component) {
        (Some(_), Some(_)) => joint(structure, fmus, connection).map(Link::Joint),
        (None, Some(_)) | (Some(_), None) => {
            let inwards = start.component.is_none();
            let (outer, inner) = if inwards { (start, end) } else { (end, start) };
            let own = find_own(structure, outer, inwards)?;
            let inner = find(structure, fmus, inner, if inwards { own.kind } else { ConnectorKind::Output })?;
            let linear = own_linear(structure, connection, (own, &inner), inwards)?;
            Ok(Link::Own(own.name.clone(), ConnectedVariable { at: inner.at, linear }))
        }
        (None, None) => {
            Err("found the system's own connectors at both ends, allowed: a component's at one".to_owned())
        }
    }
}

/// Linear transformation of a Real between one of the system's own connectors, which holds it in its own unit, and a variable.
fn own_linear(
    structure: &Structure,
    connection: &Connection,
    (own, inner): (&Connector, &Joined<'_>),
    inwards: bool,
) -> Result<Linear, String> {
    let kind = inner.variable.kind.name();
    if let Some(found) = own.signal.as_ref().map(Signal::word).filter(|found| *found != kind) {
        return Err(format!("found the system's own {} of type {found}, allowed: {kind}", own.name));
    }
    if kind != "Real" {
        let transformed = format!("found a LinearTransformation of type {kind}, allowed: Real");
        return if connection.transformation.is_some() { Err(transformed) } else { Ok(Linear::IDENTITY) };
    }
    let outer = Joined { connector: own, ..*inner };
    let (start, end) = if inwards { (&outer, inner) } else { (inner, &outer) };
    linear(structure, connection, (start, !inwards), (end, inwards))
}

/// Holds a connection of two components against their FMUs.
fn joint(structure: &Structure, fmus: &[Fmu], connection: &Connection) -> Result<Joint, String> {
    let start = find(structure, fmus, &connection.start, ConnectorKind::Output)?;
    let end = find(structure, fmus, &connection.end, ConnectorKind::Input)?;
    let (one, other) = (start.variable.kind.name(), end.variable.kind.name());
    if one != other {
        return Err(format!("found type {one} at its start and {other} at its end, allowed: one type"));
    }
    if one == "String" {
        return Err("found type String, allowed: Real, Integer, Boolean, Enumeration".to_owned());
    }
    let [given, taken] = [&start, &end].map(|it| value::items(it.fmu.description(), it.variable));
    if let Some(foreign) = foreign_item(given, taken) {
        let allowed: Vec<String> = taken.iter().map(|it| format!("{} {}", it.value, it.name)).collect();
        return Err(format!(
            "the output may be item {} {}, which the input does not have, allowed: {}",
            foreign.value,
            foreign.name,
            allowed.join(", ")
        ));
    }
    if one != "Real" && connection.transformation.is_some() {
        return Err(format!("found a LinearTransformation of type {one}, allowed: Real"));
    }
    let linear = match one {
        "Real" => linear(structure, connection, (&start, true), (&end, true))?,
        _ => Linear::IDENTITY,
    };
    Ok(Joint { from: start.at, to: end.at, linear: (linear != Linear::IDENTITY).then_some(linear) })
}

/// Whether both items have one number and one name.
pub(crate) fn is_same_item(one: &EnumerationItem, other: &EnumerationItem) -> bool {
    one.value == other.value && one.name == other.name
}

/// An item of the output's Enumeration that the input's does not have.
pub(crate) fn foreign_item<'a>(
    given: &'a [EnumerationItem],
    taken: &[EnumerationItem],
) -> Option<&'a EnumerationItem> {
    given.iter().find(|item| !taken.iter().any(|it| is_same_item(it, item)))
}

/// Linear transformation of a Real from variable to variable: to the connector's unit, to the other connector's unit, through the
/// connection's own transformation, to the other variable's unit. An end that is no variable begins or ends in its connector's.
fn linear(
    structure: &Structure,
    connection: &Connection,
    (start, start_is_variable): (&Joined<'_>, bool),
    (end, end_is_variable): (&Joined<'_>, bool),
) -> Result<Linear, String> {
    let own = |it: &Joined<'_>| value::unit(it.fmu.description(), it.variable).map(str::to_owned);
    let shown = |it: &Joined<'_>| match &it.connector.signal {
        Some(Signal::Real { unit: Some(unit) }) => Some(unit.clone()),
        _ => own(it),
    };
    let between = |from: (Option<String>, &Joined<'_>), to: (Option<String>, &Joined<'_>)| {
        let ((Some(from), of), (Some(to), at)) = (from, to) else { return Ok(Linear::IDENTITY) };
        if from == to {
            return Ok(Linear::IDENTITY);
        }
        let base = |name: &str, it: &Joined<'_>| {
            base(name, &[&structure.units, &it.fmu.description().units])
                .ok_or_else(|| format!("unit {name:?} is not defined, so it cannot be converted"))
        };
        let (one, other) = (base(&from, of)?, base(&to, at)?);
        if !is_same_dimension(&one, &other) {
            return Err(format!(
                "found unit {from:?} at its start and {to:?} at its end, allowed: units of one dimension"
            ));
        }
        Ok(conversion(&one, &other))
    };
    let converted = if connection.suppress_unit_conversion {
        Linear::IDENTITY
    } else {
        between((shown(start), start), (shown(end), end))?
    };
    let transformation = connection.transformation.unwrap_or(Linear::IDENTITY);
    if connection.transformation.is_some() && converted != Linear::IDENTITY {
        return Err("found a LinearTransformation between different units, which the standard does not \
                    put in order, allowed: suppressUnitConversion=\"true\" or equal units"
            .to_owned());
    }
    let within =
        |is_variable: bool, from: (Option<String>, &Joined<'_>), to: (Option<String>, &Joined<'_>)| {
            if is_variable { between(from, to) } else { Ok(Linear::IDENTITY) }
        };
    let first = within(start_is_variable, (own(start), start), (shown(start), start))?;
    let last = within(end_is_variable, (shown(end), end), (own(end), end))?;
    Ok(first.then(converted).then(transformation).then(last))
}
