//! Reads `modelDescription.xml` (feature `reader`).
//!
//! Everything that the schema allows is read; unknown elements and attributes give warnings. What cannot be
//! represented (a missing required attribute, a value of the wrong type) is an error with line and element.
//! The input may be hostile: size, depth and attribute count are bounded, entities are never expanded, and
//! time grows linearly with size.

mod annotations;
mod definitions;
mod variables;
mod xml;

use crate::element::{Element, Fields, ReadError};
use crate::finding::{Code, Finding, Lines};
use crate::{CoSimulation, Description, ModelExchange, validate};

pub use xml::{MAX_BYTES, Start, Xml};

/// Result of reading a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Parsed {
    /// The content.
    pub description: Description,
    /// Faults that did not stop the reader: unknown XML, wrong order of elements.
    pub warnings: Vec<Finding>,
    /// Lines of the elements.
    pub lines: Lines,
}

impl Parsed {
    /// The reader's warnings and everything the validator finds, with lines, ordered by line.
    pub fn findings(&self) -> Vec<Finding> {
        let mut all = self.warnings.clone();
        all.extend(validate::with_lines(&self.description, &self.lines));
        all.sort_by_key(|finding| finding.line);
        all
    }
}

/// The children of the root in schema order; those marked are required.
const SECTIONS: [(&str, bool); 9] = [
    ("ModelExchange", false),
    ("CoSimulation", false),
    ("UnitDefinitions", false),
    ("TypeDefinitions", false),
    ("LogCategories", false),
    ("DefaultExperiment", false),
    ("VendorAnnotations", false),
    ("ModelVariables", true),
    ("ModelStructure", true),
];

/// Reads the bytes of a `modelDescription.xml` of FMI 2.0, co-simulation or model exchange.
///
/// # Errors
/// Not UTF-8, not well-formed, not FMI 2.0, required elements or attributes missing, elements twice, values
/// of the wrong type, or larger than any real file.
pub fn parse(bytes: &[u8]) -> Result<Parsed, ReadError> {
    let mut read =
        Read { xml: Xml::new(bytes)?, description: Description::default(), lines: Lines::default() };
    let mut root = read.xml.root()?;
    read.root_attributes(&mut root)?;
    read.sections(&root)?;
    Ok(Parsed { warnings: read.xml.finish()?, description: read.description, lines: read.lines })
}

struct Read<'a> {
    xml: Xml<'a>,
    description: Description,
    lines: Lines,
}

impl Read<'_> {
    fn root_attributes(&mut self, root: &mut Start) -> Result<(), ReadError> {
        if root.name != "fmiModelDescription" {
            let message = format!("the root element is <{}>; allowed is <fmiModelDescription>", root.name);
            return Err(ReadError::new(Code::Root, root.line, &root.name, message));
        }
        self.lines.root = root.line;
        let mut fields = root.fields();
        let version: String = fields.required("fmiVersion")?;
        if version != "2.0" {
            let message = format!("fmiVersion is `{version}`; allowed is `2.0`");
            return Err(ReadError::new(Code::Version, root.line, &root.name, message));
        }
        self.description = Description::read(&mut fields)?;
        self.xml.warn_of_unknown(&fields);
        Ok(())
    }

    fn sections(&mut self, root: &Start) -> Result<(), ReadError> {
        let names = SECTIONS.map(|(name, _)| name);
        // Either of ModelExchange and CoSimulation may come first.
        let seen = self.ordered(root, names, 2, |read, _, start| read.section(start))?;
        for ((name, required), seen) in SECTIONS.iter().zip(seen) {
            if *required && !seen {
                return Err(lacks(root, name));
            }
        }
        Ok(())
    }

    /// Reads the children of `parent` with `child`, which gets the place of each in `names`; those after the first `free` should
    /// stand in this order. Says which there were.
    fn ordered<const N: usize>(
        &mut self,
        parent: &Start,
        names: [&str; N],
        free: usize,
        mut child: impl FnMut(&mut Self, usize, &mut Start) -> Result<(), ReadError>,
    ) -> Result<[bool; N], ReadError> {
        let mut seen = [false; N];
        let mut last = 0;
        while let Some(mut start) = self.xml.child(parent)? {
            let Some(rank) = names.iter().position(|name| *name == start.name) else {
                self.unknown(&start)?;
                continue;
            };
            if core::mem::replace(&mut seen[rank], true) {
                return Err(twice(&start));
            }
            if rank < last && last >= free {
                let message = format!("stands after <{}>; the schema requires it before", names[last]);
                self.xml.warn(Code::ElementOrder, start.line, &start.name, message);
            }
            last = last.max(rank);
            child(self, rank, &mut start)?;
        }
        Ok(seen)
    }

    fn section(&mut self, start: &mut Start) -> Result<(), ReadError> {
        match start.name.as_str() {
            "ModelExchange" => {
                self.lines.model_exchange = start.line;
                let (flags, source_files) = (self.attributes(start)?, self.source_files(start)?);
                self.description.model_exchange = Some(ModelExchange { source_files, ..flags });
            }
            "CoSimulation" => {
                self.lines.co_simulation = start.line;
                let (flags, source_files) = (self.attributes(start)?, self.source_files(start)?);
                self.description.co_simulation = Some(CoSimulation { source_files, ..flags });
            }
            "UnitDefinitions" => self.list(start, "Unit", Self::unit)?,
            "TypeDefinitions" => self.list(start, "SimpleType", Self::simple_type)?,
            "LogCategories" => self.list(start, "Category", |read, start| {
                read.lines.log_categories.push(start.line);
                let category = read.leaf(start)?;
                read.description.log_categories.push(category);
                Ok(())
            })?,
            "DefaultExperiment" => {
                self.lines.default_experiment = start.line;
                self.description.default_experiment = Some(self.leaf(start)?);
            }
            "VendorAnnotations" => self.annotations(start, |read, tool| read.xml.skip(tool))?,
            "ModelVariables" => {
                self.lines.model_variables = start.line;
                self.list(start, "ScalarVariable", Self::variable)?;
            }
            _ => self.structure(start)?,
        }
        Ok(())
    }

    /// Reads every child `name` of `start` with `item`.
    fn list(
        &mut self,
        start: &mut Start,
        name: &str,
        mut item: impl FnMut(&mut Self, &mut Start) -> Result<(), ReadError>,
    ) -> Result<(), ReadError> {
        self.xml.warn_of_unknown(&start.fields());
        let mut empty = true;
        while let Some(mut child) = self.xml.child(start)? {
            if child.name == name {
                empty = false;
                item(self, &mut child)?;
            } else {
                self.unknown(&child)?;
            }
        }
        // The validator reports these two.
        if empty && !matches!(start.name.as_str(), "ModelVariables" | "Enumeration") {
            let message = format!("has no <{name}>; allowed is at least one, or to leave the list out");
            self.xml.warn(Code::EmptyList, start.line, &start.name, message);
        }
        Ok(())
    }

    /// The attributes of an element; others give warnings.
    fn attributes<T: Element>(&mut self, start: &mut Start) -> Result<T, ReadError> {
        let mut fields = start.fields();
        let read = T::read(&mut fields)?;
        self.xml.warn_of_unknown(&fields);
        Ok(read)
    }

    /// An element that has attributes only.
    fn leaf<T: Element>(&mut self, start: &mut Start) -> Result<T, ReadError> {
        let read = self.attributes(start)?;
        self.end(start)?;
        Ok(read)
    }

    /// The element of one of several names, with its attributes; `None`, and a warning, for any other.
    fn kind<T>(
        &mut self,
        start: &mut Start,
        read: fn(&str, &mut Fields) -> Result<Option<T>, ReadError>,
    ) -> Result<Option<T>, ReadError> {
        let mut fields = start.fields();
        let kind = read(&start.name, &mut fields)?;
        match kind {
            Some(_) => self.xml.warn_of_unknown(&fields),
            None => self.unknown(start)?,
        }
        Ok(kind)
    }

    /// Reads past an element that holds nothing more that FMI knows.
    fn end(&mut self, start: &Start) -> Result<(), ReadError> {
        while let Some(child) = self.xml.child(start)? {
            self.unknown(&child)?;
        }
        Ok(())
    }

    fn unknown(&mut self, start: &Start) -> Result<(), ReadError> {
        let message = "is no element of FMI 2.0 at this place; it is ignored".to_owned();
        self.xml.warn(Code::UnknownElement, start.line, &start.name, message);
        self.xml.skip(start)
    }
}

fn twice(start: &Start) -> ReadError {
    let message = "stands a second time; allowed is once".to_owned();
    ReadError::new(Code::DuplicateElement, start.line, &start.name, message)
}

fn lacks(parent: &Start, what: &str) -> ReadError {
    let message = format!("<{what}> is missing; it is required");
    ReadError::new(Code::MissingElement, parent.line, &parent.name, message)
}
