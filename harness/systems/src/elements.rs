//! Elements of SSP files, read by their local names: attributes by type, definitions that several files share.

use model_description::{BaseUnit, Code, EnumerationItem, ReadError, Start, Unit, Xml};

use crate::structure::{Enumeration, Linear};

/// The name without its prefix.
pub(crate) fn local(start: &Start) -> &str {
    start.name.rsplit_once(':').map_or(start.name.as_str(), |(_, name)| name)
}

/// A refusal at an element.
pub(crate) fn refuse(start: &Start, message: String) -> ReadError {
    ReadError::new(Code::Malformed, start.line, &start.name, message)
}

/// A refusal of an element that does not belong where it stands.
pub(crate) fn unknown(child: &Start, parent: &Start, allowed: &str) -> ReadError {
    refuse(child, format!("found in <{}>, allowed there: {allowed}", parent.name))
}

/// An attribute.
pub(crate) fn attribute<'a>(start: &'a Start, name: &str) -> Option<&'a str> {
    start.attributes.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
}

/// An attribute that has to be there and not empty.
pub(crate) fn required(start: &Start, name: &str) -> Result<String, ReadError> {
    match attribute(start, name) {
        Some(value) if !value.is_empty() => Ok(value.to_owned()),
        Some(_) => Err(refuse(start, format!("attribute `{name}` is empty"))),
        None => Err(refuse(start, format!("attribute `{name}` is missing"))),
    }
}

/// An attribute as a value of a type.
pub(crate) fn parsed<T: std::str::FromStr>(
    start: &Start,
    name: &str,
    allowed: &str,
) -> Result<Option<T>, ReadError> {
    attribute(start, name)
        .map(|text| {
            text.trim()
                .parse()
                .map_err(|_| refuse(start, format!("attribute `{name}`: found {text:?}, allowed: {allowed}")))
        })
        .transpose()
}

/// A finite number.
pub(crate) fn number(start: &Start, name: &str) -> Result<Option<f64>, ReadError> {
    const ALLOWED: &str = "a finite number";
    match parsed::<f64>(start, name, ALLOWED)? {
        Some(number) if !number.is_finite() => {
            Err(refuse(start, format!("attribute `{name}`: found {number}, allowed: {ALLOWED}")))
        }
        found => Ok(found),
    }
}

/// A whole number.
pub(crate) fn integer(start: &Start, name: &str) -> Result<Option<i32>, ReadError> {
    parsed(start, name, "a whole number of 32 bits")
}

/// `true`, `false`, `1` or `0`.
pub(crate) fn boolean(start: &Start, name: &str) -> Result<Option<bool>, ReadError> {
    match attribute(start, name).map(str::trim) {
        None => Ok(None),
        Some("true" | "1") => Ok(Some(true)),
        Some("false" | "0") => Ok(Some(false)),
        Some(text) => {
            Err(refuse(start, format!("attribute `{name}`: found {text:?}, allowed: true, false, 1, 0")))
        }
    }
}

/// Reads every child of `parent`; each has to be an element `name`.
pub(crate) fn list<T>(
    xml: &mut Xml<'_>,
    parent: &Start,
    name: &str,
    mut read: impl FnMut(&mut Xml<'_>, &Start) -> Result<T, ReadError>,
) -> Result<Vec<T>, ReadError> {
    let mut all = Vec::new();
    while let Some(element) = xml.child(parent)? {
        if local(&element) != name {
            return Err(unknown(&element, parent, name));
        }
        all.push(read(xml, &element)?);
    }
    Ok(all)
}

/// Reads the children of this name, which hold nothing themselves; others are left alone.
pub(crate) fn leaves<T>(
    xml: &mut Xml<'_>,
    parent: &Start,
    name: &str,
    mut read: impl FnMut(&Start) -> Result<T, ReadError>,
) -> Result<Vec<T>, ReadError> {
    let mut all = Vec::new();
    while let Some(child) = xml.child(parent)? {
        if local(&child) == name {
            all.push(read(&child)?);
        }
        xml.skip(&child)?;
    }
    Ok(all)
}

/// Reads the attributes of a `LinearTransformation`.
pub(crate) fn linear(start: &Start) -> Result<Linear, ReadError> {
    let [factor, offset] = [number(start, "factor")?, number(start, "offset")?];
    Ok(Linear { factor: factor.unwrap_or(1.0), offset: offset.unwrap_or(0.0) })
}

/// Reads `Units`.
pub(crate) fn units(xml: &mut Xml<'_>, parent: &Start) -> Result<Vec<Unit>, ReadError> {
    list(xml, parent, "Unit", |xml, element| {
        let name = required(element, "name")?;
        let base = leaves(xml, element, "BaseUnit", base_unit)?.pop();
        if base.is_none() {
            return Err(refuse(element, format!("unit {name:?} has no BaseUnit")));
        }
        Ok(Unit { name, base, display_units: Vec::new() })
    })
}

fn base_unit(start: &Start) -> Result<BaseUnit, ReadError> {
    let factor = number(start, "factor")?.unwrap_or(1.0);
    if factor == 0.0 {
        return Err(refuse(start, "attribute `factor`: found 0, allowed: any other number".to_owned()));
    }
    let offset = number(start, "offset")?.unwrap_or(0.0);
    BaseUnit::from_exponents(|symbol| Ok(integer(start, symbol)?.unwrap_or(0)), factor, offset)
}

/// Reads `Enumerations`.
pub(crate) fn enumerations(xml: &mut Xml<'_>, parent: &Start) -> Result<Vec<Enumeration>, ReadError> {
    list(xml, parent, "Enumeration", |xml, element| {
        let name = required(element, "name")?;
        let items = leaves(xml, element, "Item", |item| {
            let value = integer(item, "value")?
                .ok_or_else(|| refuse(item, "attribute `value` is missing".to_owned()))?;
            Ok(EnumerationItem { name: required(item, "name")?, value, description: None })
        })?;
        Ok(Enumeration { name, items })
    })
}
