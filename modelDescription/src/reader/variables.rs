//! Model variables and model structure.

use super::xml::Start;
use super::{Read, lacks, twice};
use crate::element::ReadError;
use crate::finding::Code;
use crate::{ScalarVariable, VariableKind};

/// The children of `ModelStructure` in schema order.
const LISTS: [&str; 3] = ["Outputs", "Derivatives", "InitialUnknowns"];

impl Read<'_> {
    pub(super) fn variable(&mut self, start: &mut Start) -> Result<(), ReadError> {
        let read: ScalarVariable = self.attributes(start)?;
        let mut kind = None;
        let mut annotated = false;
        let mut annotation = None;
        while let Some(mut child) = self.xml.child(start)? {
            if child.name == "Annotations" {
                if core::mem::replace(&mut annotated, true) {
                    return Err(twice(&child));
                }
                if kind.is_none() {
                    let message = "stands before the base type; the schema requires it after".to_owned();
                    self.xml.warn(Code::ElementOrder, child.line, &child.name, message);
                }
                self.annotations(&mut child, |own, tool| {
                    annotation = own.annotation(tool, &read.name)?;
                    Ok(())
                })?;
            } else if let Some(read) = self.variable_kind(&mut child)?
                && kind.replace(read).is_some()
            {
                return Err(twice(&child));
            }
        }
        let kind = kind.ok_or_else(|| lacks(start, "Real, Integer, Boolean, String or Enumeration"))?;
        self.lines.variables.push(start.line);
        self.description.variables.push(ScalarVariable { kind, annotation, ..read });
        Ok(())
    }

    fn variable_kind(&mut self, start: &mut Start) -> Result<Option<VariableKind>, ReadError> {
        let kind = self.kind(start, VariableKind::read)?;
        if kind.is_some() {
            self.end(start)?;
        }
        Ok(kind)
    }

    pub(super) fn structure(&mut self, start: &mut Start) -> Result<(), ReadError> {
        self.xml.warn_of_unknown(&start.fields());
        self.ordered(start, LISTS, 0, |read, rank, child| {
            let (mut unknowns, mut lines) = (Vec::new(), Vec::new());
            read.list(child, "Unknown", |read, entry| {
                lines.push(entry.line);
                unknowns.push(read.leaf(entry)?);
                Ok(())
            })?;
            let (structure, all) = (&mut read.description.structure, &mut read.lines);
            match rank {
                0 => (structure.outputs, all.outputs) = (unknowns, lines),
                1 => (structure.derivatives, all.derivatives) = (unknowns, lines),
                _ => (structure.initial_unknowns, all.initial_unknowns) = (unknowns, lines),
            }
            Ok(())
        })?;
        Ok(())
    }
}
