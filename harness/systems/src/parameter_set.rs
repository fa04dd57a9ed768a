//! Reads parameter sets: `.ssv` files and those that stand in the description of a system (SSP 1.0, section 6).

use model_description::{ReadError, Start, Xml};

use crate::{
    elements::{boolean, file, integer, list, missing, number, refuse, required, units, unknown},
    structure::{Parameter, ParameterSet, Written},
};

/// Reads a file.
pub(crate) fn read(bytes: &[u8]) -> Result<ParameterSet, ReadError> {
    file(bytes, "ParameterSet", element)
}

/// Reads a `ParameterSet` after its start tag.
pub(crate) fn element(xml: &mut Xml<'_>, start: &Start) -> Result<ParameterSet, ReadError> {
    let mut set =
        ParameterSet { name: start.attribute("name").unwrap_or_default().to_owned(), ..Default::default() };
    while let Some(child) = xml.child(start)? {
        match child.local() {
            "Parameters" => set.parameters.extend(list(xml, &child, "Parameter", parameter)?),
            "Units" => set.units = units(xml, &child)?,
            "Enumerations" | "Annotations" => xml.skip(&child)?,
            _ => return Err(unknown(&child, start, "Parameters, Enumerations, Units, Annotations")),
        }
    }
    Ok(set)
}

fn parameter(xml: &mut Xml<'_>, start: &Start) -> Result<Parameter, ReadError> {
    let name = required(start, "name")?;
    let mut value = None;
    while let Some(child) = xml.child(start)? {
        if child.local() != "Annotations" {
            value = Some(written(&child, start)?);
        }
        xml.skip(&child)?;
    }
    let value =
        value.ok_or_else(|| refuse(start, format!("parameter {name:?} has no value; allowed: {TYPES}")))?;
    Ok(Parameter { name, value, line: start.line })
}

const TYPES: &str = "Real, Integer, Boolean, String, Enumeration";

fn written(child: &Start, parent: &Start) -> Result<Written, ReadError> {
    let missing = || missing(child, "value");
    Ok(match child.local() {
        "Real" => Written::Real {
            value: number(child, "value")?.ok_or_else(missing)?,
            unit: child.attribute("unit").map(str::to_owned),
        },
        "Integer" => Written::Integer(integer(child, "value")?.ok_or_else(missing)?),
        "Boolean" => Written::Boolean(boolean(child, "value")?.ok_or_else(missing)?),
        "String" => Written::Text(child.attribute("value").ok_or_else(missing)?.to_owned()),
        "Enumeration" => Written::Enumeration(required(child, "value")?),
        _ => return Err(unknown(child, parent, TYPES)),
    })
}
