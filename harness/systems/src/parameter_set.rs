//! Reads parameter sets: `.ssv` files and those that stand in the description of a system (SSP 1.0, section 6).

use model_description::{ReadError, Start, Xml};

use crate::{
    elements::{attribute, boolean, integer, list, local, number, refuse, required, units, unknown},
    structure::{Parameter, ParameterSet, Written},
};

/// Reads a file.
pub(crate) fn read(bytes: &[u8]) -> Result<ParameterSet, ReadError> {
    let mut xml = Xml::new(bytes)?;
    let root = xml.root()?;
    if local(&root) != "ParameterSet" {
        return Err(refuse(&root, "found at the root, allowed: ParameterSet of SSP 1.0".to_owned()));
    }
    let set = element(&mut xml, &root)?;
    xml.finish()?;
    Ok(set)
}

/// Reads a `ParameterSet` after its start tag.
pub(crate) fn element(xml: &mut Xml<'_>, start: &Start) -> Result<ParameterSet, ReadError> {
    let mut set =
        ParameterSet { name: attribute(start, "name").unwrap_or_default().to_owned(), ..Default::default() };
    while let Some(child) = xml.child(start)? {
        match local(&child) {
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
        if local(&child) != "Annotations" {
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
    let missing = || refuse(child, "attribute `value` is missing".to_owned());
    Ok(match local(child) {
        "Real" => Written::Real {
            value: number(child, "value")?.ok_or_else(missing)?,
            unit: attribute(child, "unit").map(str::to_owned),
        },
        "Integer" => Written::Integer(integer(child, "value")?.ok_or_else(missing)?),
        "Boolean" => Written::Boolean(boolean(child, "value")?.ok_or_else(missing)?),
        "String" => Written::Text(attribute(child, "value").ok_or_else(missing)?.to_owned()),
        "Enumeration" => Written::Enumeration(required(child, "value")?),
        _ => return Err(unknown(child, parent, TYPES)),
    })
}
