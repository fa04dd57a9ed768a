//! Elements of SSP files, read by their local names: attributes by type, definitions that several files share.

use model_description::{BaseUnit, Code, EnumerationItem, ReadError, Start, Unit, Xml};

use crate::structure::{Enumeration, Linear};

/// A refusal at an element.
pub(crate) fn refuse(start: &Start, message: String) -> ReadError {
    ReadError::new(Code::Malformed, start.line, &start.name, message)
}

/// A refusal of an element without this attribute.
pub(crate) fn missing(start: &Start, name: &str) -> ReadError {
    refuse(start, format!("attribute `{name}` is missing"))
}

/// A refusal of an element that does not belong where it stands.
pub(crate) fn unknown(child: &Start, parent: &Start, allowed: &str) -> ReadError {
    refuse(child, format!("found in <{}>, allowed there: {allowed}", parent.name))
}

/// An attribute that has to be there and not empty.
pub(crate) fn required(start: &Start, name: &str) -> Result<String, ReadError> {
    match start.attribute(name) {
        Some(value) if !value.is_empty() => Ok(value.to_owned()),
        Some(_) => Err(refuse(start, format!("attribute `{name}` is empty"))),
        None => Err(missing(start, name)),
    }
}

/// An attribute as a value of a type.
pub(crate) fn parsed<T: std::str::FromStr>(
    start: &Start,
    name: &str,
    allowed: &str,
) -> Result<Option<T>, ReadError> {
    start
        .attribute(name)
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
    match start.attribute(name).map(str::trim) {
        None => Ok(None),
        Some("true" | "1") => Ok(Some(true)),
        Some("false" | "0") => Ok(Some(false)),
        Some(text) => {
            Err(refuse(start, format!("attribute `{name}`: found {text:?}, allowed: true, false, 1, 0")))
        }
    }
}

/// Reads a file with an element `name` at its root.
pub(crate) fn file<T>(
    bytes: &[u8],
    name: &str,
    read: impl FnOnce(&mut Xml<'_>, &Start) -> Result<T, ReadError>,
) -> Result<T, ReadError> {
    let mut xml = Xml::new(bytes)?;
    let root = xml.root()?;
    if root.local() != name {
        return Err(refuse(&root, format!("found at the root, allowed: {name} of SSP 1.0")));
    }
    let found = read(&mut xml, &root)?;
    xml.finish()?;
    Ok(found)
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
        if element.local() != name {
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
        if child.local() == name {
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
            let value = integer(item, "value")?.ok_or_else(|| missing(item, "value"))?;
            Ok(EnumerationItem { name: required(item, "name")?, value, description: None })
        })?;
        Ok(Enumeration { name, items })
    })
}
