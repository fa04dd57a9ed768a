//! Parameter mappings: `.ssm` files and those that stand in the description of a system (SSP 1.0, sections 5.5 and 7).

use model_description::{ReadError, Start, Xml};

use crate::{
    elements::{boolean, file, integer, leaves, linear, missing, required, unknown},
    joint::near,
    structure::{Linear, Mapping, MappingEntry, Parameter, ParameterSet, Transformation, Written},
};

const TRANSFORMATIONS: &str = "LinearTransformation, BooleanMappingTransformation, IntegerMappingTransformation, \
                               EnumerationMappingTransformation, Annotations";

/// A parameter on its way to a component or system.
#[derive(Debug)]
pub(crate) struct Mapped {
    /// Under the name that it has there; a number without a unit is in the target's.
    pub parameter: Parameter,
    /// Transformation of a Real in the target's unit.
    pub linear: Linear,
    /// Whether an Integer may be the number of an Enumeration's item.
    pub is_number: bool,
    /// Whether it is an entry's.
    pub is_mapped: bool,
    /// Whether it is left out where there is no such target.
    pub is_optional: bool,
}

/// Reads a file.
pub(crate) fn read(bytes: &[u8]) -> Result<Vec<MappingEntry>, ReadError> {
    file(bytes, "ParameterMapping", element)
}

/// Reads a `ParameterMapping` after its start tag. Entries without a source are those of a template that nobody filled in.
pub(crate) fn element(xml: &mut Xml<'_>, start: &Start) -> Result<Vec<MappingEntry>, ReadError> {
    let mut entries = Vec::new();
    while let Some(child) = xml.child(start)? {
        match child.local() {
            "MappingEntry" if child.attribute("source") == Some("") => xml.skip(&child)?,
            "MappingEntry" => entries.push(entry(xml, &child)?),
            "Annotations" => xml.skip(&child)?,
            _ => return Err(unknown(&child, start, "MappingEntry, Annotations")),
        }
    }
    Ok(entries)
}

fn entry(xml: &mut Xml<'_>, start: &Start) -> Result<MappingEntry, ReadError> {
    let mut entry = MappingEntry {
        source: required(start, "source")?,
        target: required(start, "target")?,
        transformation: None,
        suppress_unit_conversion: boolean(start, "suppressUnitConversion")?.unwrap_or(false),
        line: start.line,
    };
    while let Some(child) = xml.child(start)? {
        let found = match child.local() {
            "LinearTransformation" => {
                let linear = linear(&child)?;
                xml.skip(&child)?;
                Transformation::Linear(linear)
            }
            "BooleanMappingTransformation" => {
                let end = |map: &Start, name: &str| boolean(map, name)?.ok_or_else(|| missing(map, name));
                Transformation::Boolean(pairs(xml, &child, end)?)
            }
            "IntegerMappingTransformation" => {
                let end = |map: &Start, name: &str| integer(map, name)?.ok_or_else(|| missing(map, name));
                Transformation::Integer(pairs(xml, &child, end)?)
            }
            "EnumerationMappingTransformation" => Transformation::Enumeration(pairs(xml, &child, required)?),
            "Annotations" => {
                xml.skip(&child)?;
                continue;
            }
            _ => return Err(unknown(&child, start, TRANSFORMATIONS)),
        };
        entry.transformation = Some(found);
    }
    Ok(entry)
}

/// The entries of a table of values.
fn pairs<T>(
    xml: &mut Xml<'_>,
    start: &Start,
    end: impl Fn(&Start, &str) -> Result<T, ReadError>,
) -> Result<Vec<(T, T)>, ReadError> {
    leaves(xml, start, "MapEntry", |map| Ok((end(map, "source")?, end(map, "target")?)))
}

impl Mapping {
    /// Refuses an entry whose source is in none of the sets.
    pub(crate) fn check(&self, prefix: &str, sets: &[&ParameterSet]) -> Result<(), (u32, String)> {
        let names: Vec<String> =
            sets.iter().flat_map(|set| &set.parameters).map(|it| format!("{prefix}{}", it.name)).collect();
        match self.entries.iter().find(|entry| !names.contains(&entry.source)) {
            None => Ok(()),
            Some(MappingEntry { source, target, line, .. }) => {
                let near = near(source, names.iter().map(String::as_str));
                Err((*line, format!("entry to {target:?}: found no parameter {source:?}, near it: {near}")))
            }
        }
    }
}

/// The parameters of a set under the names that they have in the component or system. With a mapping, a parameter without an
/// entry keeps its name and is left out where nothing has it.
///
/// # Errors
/// Line and reason of an entry that does not fit its parameter.
pub(crate) fn mapped(
    mapping: Option<&Mapping>,
    prefix: &str,
    set: &ParameterSet,
) -> Result<Vec<Mapped>, (u32, String)> {
    let mut all = Vec::new();
    for parameter in &set.parameters {
        let name = format!("{prefix}{}", parameter.name);
        let entries = mapping.iter().flat_map(|it| &it.entries).filter(|entry| entry.source == name);
        let before = all.len();
        for entry in entries {
            let refuse = |what| (entry.line, format!("entry of parameter {name:?}: {what}"));
            all.push(applied(entry, parameter).map_err(refuse)?);
        }
        if all.len() == before {
            let parameter = Parameter { name, ..parameter.clone() };
            let is_optional = mapping.is_some();
            let linear = Linear::IDENTITY;
            all.push(Mapped { parameter, linear, is_number: false, is_mapped: false, is_optional });
        }
    }
    // The later one of two wins: an entry over a parameter that has its target's name.
    all.sort_by_key(|mapped| mapped.is_mapped);
    Ok(all)
}

fn applied(entry: &MappingEntry, parameter: &Parameter) -> Result<Mapped, String> {
    let (mut linear, mut is_number) = (Linear::IDENTITY, false);
    let value = match (&entry.transformation, &parameter.value) {
        (None, value) => value.clone(),
        (Some(Transformation::Linear(given)), value @ Written::Real { .. }) => {
            linear = *given;
            value.clone()
        }
        (Some(Transformation::Boolean(pairs)), Written::Boolean(value)) => {
            Written::Boolean(*taken(pairs, value)?)
        }
        (Some(Transformation::Integer(pairs)), Written::Integer(value)) => {
            is_number = true;
            Written::Integer(*taken(pairs, value)?)
        }
        (Some(Transformation::Enumeration(pairs)), Written::Enumeration(value)) => {
            Written::Enumeration(taken(pairs, value)?.clone())
        }
        (Some(transformation), value) => {
            let (found, allowed) = (transformation.word(), transformation.base_type());
            return Err(format!("found {found} of type {}, allowed: {allowed}", value.word()));
        }
    };
    let value = match value {
        Written::Real { value, .. } if entry.suppress_unit_conversion => Written::Real { value, unit: None },
        value => value,
    };
    let parameter = Parameter { name: entry.target.clone(), value, line: entry.line };
    Ok(Mapped { parameter, linear, is_number, is_mapped: true, is_optional: false })
}

/// The target of a value.
fn taken<'p, T: PartialEq + std::fmt::Debug>(pairs: &'p [(T, T)], value: &T) -> Result<&'p T, String> {
    let all = || pairs.iter().map(|(source, _)| format!("{source:?}")).collect::<Vec<_>>().join(", ");
    let found = pairs.iter().find(|(source, _)| source == value).map(|(_, target)| target);
    found.ok_or_else(|| format!("found {value:?}, which no MapEntry takes, allowed: {}", all()))
}

impl Transformation {
    /// The standard's word.
    fn word(&self) -> &'static str {
        match self {
            Self::Linear(_) => "LinearTransformation",
            Self::Boolean(_) => "BooleanMappingTransformation",
            Self::Integer(_) => "IntegerMappingTransformation",
            Self::Enumeration(_) => "EnumerationMappingTransformation",
        }
    }

    /// The type that it takes.
    fn base_type(&self) -> &'static str {
        match self {
            Self::Linear(_) => "Real",
            Self::Boolean(_) => "Boolean",
            Self::Integer(_) => "Integer",
            Self::Enumeration(_) => "Enumeration",
        }
    }
}
