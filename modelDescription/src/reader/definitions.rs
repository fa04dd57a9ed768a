//! Source files, units, types, lists of annotations.

use std::collections::BTreeSet;

use super::xml::Start;
use super::{Read, lacks, twice};
use crate::annotation::TOOL;
use crate::element::ReadError;
use crate::finding::Code;
use crate::{SimpleType, SimpleTypeKind, Unit};

impl Read<'_> {
    pub(super) fn source_files(&mut self, start: &Start) -> Result<Vec<String>, ReadError> {
        let mut files = Vec::new();
        self.ordered(start, ["SourceFiles"], 0, |read, _, list| {
            read.list(list, "File", |read, file| {
                let mut fields = file.fields();
                files.push(fields.required("name")?);
                read.xml.warn_of_unknown(&fields);
                read.end(file)
            })
        })?;
        Ok(files)
    }

    pub(super) fn unit(&mut self, start: &mut Start) -> Result<(), ReadError> {
        let mut unit: Unit = self.attributes(start)?;
        while let Some(mut child) = self.xml.child(start)? {
            match child.name.as_str() {
                "BaseUnit" if unit.base.is_some() => return Err(twice(&child)),
                "BaseUnit" => unit.base = Some(self.leaf(&mut child)?),
                "DisplayUnit" => unit.display_units.push(self.leaf(&mut child)?),
                _ => self.unknown(&child)?,
            }
        }
        self.lines.units.push(start.line);
        self.description.units.push(unit);
        Ok(())
    }

    pub(super) fn simple_type(&mut self, start: &mut Start) -> Result<(), ReadError> {
        let read: SimpleType = self.attributes(start)?;
        let mut kind = None;
        while let Some(mut child) = self.xml.child(start)? {
            let Some(read) = self.type_kind(&mut child)? else { continue };
            if kind.replace(read).is_some() {
                return Err(twice(&child));
            }
        }
        let kind = kind.ok_or_else(|| lacks(start, "Real, Integer, Boolean, String or Enumeration"))?;
        self.lines.types.push(start.line);
        self.description.types.push(SimpleType { kind, ..read });
        Ok(())
    }

    fn type_kind(&mut self, start: &mut Start) -> Result<Option<SimpleTypeKind>, ReadError> {
        let mut kind = self.kind(start, SimpleTypeKind::read)?;
        match &mut kind {
            Some(SimpleTypeKind::Enumeration { items, .. }) => self.list(start, "Item", |read, item| {
                items.push(read.leaf(item)?);
                Ok(())
            })?,
            Some(_) => self.end(start)?,
            None => {}
        }
        Ok(kind)
    }

    /// `VendorAnnotations` and `Annotations`: the tools' names, and with `own` the content of the tool that is read.
    pub(super) fn annotations(
        &mut self,
        start: &mut Start,
        mut own: impl FnMut(&mut Self, &Start) -> Result<(), ReadError>,
    ) -> Result<(), ReadError> {
        let mut names = BTreeSet::new();
        self.list(start, "Tool", |read, tool| {
            let name: String = tool.fields().required("name")?;
            if !names.insert(name.clone()) {
                let message = format!("tool `{name}` stands twice in one list; allowed is once");
                read.xml.warn(Code::DuplicateTool, tool.line, &tool.name, message);
            }
            if name == TOOL { own(read, tool) } else { read.xml.skip(tool) }
        })
    }
}
