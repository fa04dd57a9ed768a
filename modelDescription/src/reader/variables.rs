//! Model variables and model structure.

use super::fields::Fields;
use super::xml::Start;
use super::{Read, ReadError, lacks, twice};
use crate::finding::Code;
use crate::{ScalarVariable, VariableKind};

/// The children of `ModelStructure` in schema order.
const LISTS: [&str; 3] = ["Outputs", "Derivatives", "InitialUnknowns"];

impl Read<'_> {
    pub(super) fn variable(&mut self, start: &mut Start) -> Result<(), ReadError> {
        let read: ScalarVariable = self.attributes(start)?;
        let mut kind = None;
        let mut annotated = false;
        while let Some(mut child) = self.xml.child(start)? {
            if child.name == "Annotations" {
                if core::mem::replace(&mut annotated, true) {
                    return Err(twice(&child));
                }
                if kind.is_none() {
                    let message = "stands before the base type; the schema requires it after".to_owned();
                    self.xml.warn(Code::ElementOrder, child.line, &child.name, message);
                }
                self.annotations(&mut child)?;
            } else if let Some(read) = self.variable_kind(&mut child)?
                && kind.replace(read).is_some()
            {
                return Err(twice(&child));
            }
        }
        let kind = kind.ok_or_else(|| lacks(start, "Real, Integer, Boolean, String or Enumeration"))?;
        self.lines.variables.push(start.line);
        self.description.variables.push(ScalarVariable { kind, ..read });
        Ok(())
    }

    fn variable_kind(&mut self, start: &mut Start) -> Result<Option<VariableKind>, ReadError> {
        let mut fields = Fields::of(start);
        let Some(kind) = VariableKind::read(&start.name, &mut fields)? else {
            self.unknown(start)?;
            return Ok(None);
        };
        fields.finish(&mut self.xml);
        self.end(start)?;
        Ok(Some(kind))
    }

    pub(super) fn structure(&mut self, start: &mut Start) -> Result<(), ReadError> {
        Fields::of(start).finish(&mut self.xml);
        let mut seen = [false; LISTS.len()];
        let mut last = 0;
        while let Some(mut child) = self.xml.child(start)? {
            let Some(rank) = LISTS.iter().position(|name| *name == child.name) else {
                self.unknown(&child)?;
                continue;
            };
            if seen[rank] {
                return Err(twice(&child));
            }
            seen[rank] = true;
            if rank < last {
                let message = format!("stands after <{}>; the schema requires it before", LISTS[last]);
                self.xml.warn(Code::ElementOrder, child.line, &child.name, message);
            }
            last = last.max(rank);
            let mut unknowns = Vec::new();
            let mut lines = Vec::new();
            self.list(&mut child, "Unknown", |read, entry| {
                lines.push(entry.line);
                unknowns.push(read.leaf(entry)?);
                Ok(())
            })?;
            let structure = &mut self.description.structure;
            let (to, to_lines) = match rank {
                0 => (&mut structure.outputs, &mut self.lines.outputs),
                1 => (&mut structure.derivatives, &mut self.lines.derivatives),
                _ => (&mut structure.initial_unknowns, &mut self.lines.initial_unknowns),
            };
            *to = unknowns;
            *to_lines = lines;
        }
        Ok(())
    }
}
