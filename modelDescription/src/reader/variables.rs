//! Model variables and model structure.

use super::definitions::real_attributes;
use super::fields::{Fields, trim, words};
use super::xml::Start;
use super::{Read, ReadError, lacks, twice};
use crate::finding::Code;
use crate::{Causality, DependencyKind, Initial, ScalarVariable, Unknown, Variability, VariableKind};

/// The children of `ModelStructure` in schema order.
const LISTS: [&str; 3] = ["Outputs", "Derivatives", "InitialUnknowns"];

impl Read<'_> {
    pub(super) fn variable(&mut self, start: &mut Start) -> Result<(), ReadError> {
        let mut fields = Fields::of(start);
        let name = fields.required("name")?;
        let value_reference = fields.required_unsigned("valueReference")?;
        let description = fields.text("description");
        let allowed = words(Causality::ALL, Causality::as_str);
        let causality = fields.value("causality", &allowed, Causality::from_word)?.unwrap_or_default();
        let allowed = words(Variability::ALL, Variability::as_str);
        let variability = fields.value("variability", &allowed, Variability::from_word)?.unwrap_or_default();
        let initial = fields.value("initial", &words(Initial::ALL, Initial::as_str), Initial::from_word)?;
        let multiple_set = fields.boolean("canHandleMultipleSetPerTimeInstant")?;
        fields.finish(&mut self.xml);

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
        self.description.variables.push(ScalarVariable {
            name,
            value_reference,
            description,
            causality,
            variability,
            initial,
            can_handle_multiple_set_per_time_instant: multiple_set,
            kind,
        });
        Ok(())
    }

    fn variable_kind(&mut self, start: &mut Start) -> Result<Option<VariableKind>, ReadError> {
        let mut fields = Fields::of(start);
        let kind = match start.name.as_str() {
            "Real" => VariableKind::Real {
                start: fields.double("start")?,
                declared_type: fields.text("declaredType"),
                attributes: real_attributes(&mut fields)?,
                derivative: fields.unsigned("derivative")?,
                reinit: fields.boolean("reinit")?,
            },
            "Integer" => VariableKind::Integer {
                start: fields.int("start")?,
                declared_type: fields.text("declaredType"),
                quantity: fields.text("quantity"),
                min: fields.int("min")?,
                max: fields.int("max")?,
            },
            "Boolean" => VariableKind::Boolean {
                start: fields.boolean("start")?,
                declared_type: fields.text("declaredType"),
            },
            "String" => VariableKind::String {
                start: fields.text("start"),
                declared_type: fields.text("declaredType"),
            },
            "Enumeration" => VariableKind::Enumeration {
                start: fields.int("start")?,
                declared_type: fields.required("declaredType")?,
                quantity: fields.text("quantity"),
                min: fields.int("min")?,
                max: fields.int("max")?,
            },
            _ => {
                self.unknown(start)?;
                return Ok(None);
            }
        };
        fields.finish(&mut self.xml);
        self.leaf(start)?;
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
                unknowns.push(read.unknown_entry(entry)?);
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

    fn unknown_entry(&mut self, start: &mut Start) -> Result<Unknown, ReadError> {
        let mut fields = Fields::of(start);
        let unknown = Unknown {
            index: fields.required_unsigned("index")?,
            dependencies: fields.value(
                "dependencies",
                "a list of integers from 0 to 4294967295 with spaces between",
                |text| items(text, |item| item.parse().ok()),
            )?,
            dependencies_kind: fields.value(
                "dependenciesKind",
                "a list of dependent, constant, fixed, tunable, discrete with spaces between",
                |text| items(text, DependencyKind::from_word),
            )?,
        };
        fields.finish(&mut self.xml);
        self.leaf(start)?;
        Ok(unknown)
    }
}

/// A list of the schema: items between white space.
fn items<T>(text: &str, item: impl Fn(&str) -> Option<T>) -> Option<Vec<T>> {
    trim(text).split([' ', '\t', '\n', '\r']).filter(|word| !word.is_empty()).map(item).collect()
}
