//! The validator: every rule of FMI 2.0.5, section 2.2, that a description can break on its own.
//!
//! It takes plain values, so that the exporter checks its own declarations with it and the harness any FMU it
//! has read. Integer and Enumeration variables share one table of value references, as they share
//! `fmi2GetInteger`.

mod aliases;
mod annotations;
mod definitions;
mod names;
mod root;
mod structure;
mod variables;

use std::collections::BTreeMap;

use crate::finding::{Code, Finding, Lines};
use crate::{Description, ScalarVariable, SimpleType, SimpleTypeKind, Unit, Unknown, VariableKind};

/// Everything that is wrong with the description, section by section.
pub fn validate(description: &Description) -> Vec<Finding> {
    with_lines(description, &Lines::default())
}

/// [`validate`] with the line of each element in its XML.
pub fn with_lines(description: &Description, lines: &Lines) -> Vec<Finding> {
    let mut check = Check::new(description, lines);
    check.root();
    check.interfaces();
    check.units();
    check.types();
    check.categories();
    check.experiment();
    check.variables();
    check.names();
    check.aliases();
    check.annotations();
    check.structure();
    check.findings
}

/// The element that a finding is about; list elements by 0-based position.
#[derive(Clone, Copy)]
enum ElementLocation {
    Root,
    ModelExchange,
    CoSimulation,
    Unit(usize),
    Type(usize),
    Category(usize),
    Experiment,
    Variables,
    Variable(usize),
    Output(usize),
    Derivative(usize),
    InitialUnknown(usize),
}

/// Least and greatest value.
type Limits = (Option<f64>, Option<f64>);

struct Check<'a> {
    description: &'a Description,
    lines: &'a Lines,
    units: BTreeMap<&'a str, &'a Unit>,
    types: BTreeMap<&'a str, &'a SimpleType>,
    findings: Vec<Finding>,
}

impl<'a> Check<'a> {
    fn new(description: &'a Description, lines: &'a Lines) -> Self {
        Self {
            description,
            lines,
            units: description.units.iter().map(|unit| (unit.name.as_str(), unit)).collect(),
            types: description.types.iter().map(|known| (known.name.as_str(), known)).collect(),
            findings: Vec::new(),
        }
    }

    fn add(&mut self, code: Code, place: ElementLocation, message: String) {
        let (subject, line) = self.locate(place);
        let line = line.copied().filter(|line| *line > 0);
        self.findings.push(Finding { code, subject, line, message });
    }

    /// Reports what a rule does not allow.
    fn require(&mut self, holds: bool, code: Code, place: ElementLocation, fault: impl FnOnce() -> String) {
        if !holds {
            self.add(code, place, fault());
        }
    }

    /// The element in words, and its line.
    fn locate(&self, place: ElementLocation) -> (String, Option<&'a u32>) {
        let (all, lines) = (self.description, self.lines);
        let item = |what: &str, name: Option<&String>, lines: &'a [u32], at: usize| {
            (format!("{what} `{}`", name.map_or("", |it| it)), lines.get(at))
        };
        let entry = |list: &str, unknowns: &[Unknown], lines: &'a [u32], at: usize| {
            let variable = unknowns.get(at).and_then(|unknown| self.variable(unknown.index));
            let name = variable.map(|variable| format!(" (`{}`)", variable.name)).unwrap_or_default();
            (format!("ModelStructure/{list} entry {}{name}", at + 1), lines.get(at))
        };
        let structure = &all.structure;
        match place {
            ElementLocation::Root => ("fmiModelDescription".to_owned(), Some(&lines.root)),
            ElementLocation::ModelExchange => ("ModelExchange".to_owned(), Some(&lines.model_exchange)),
            ElementLocation::CoSimulation => ("CoSimulation".to_owned(), Some(&lines.co_simulation)),
            ElementLocation::Experiment => ("DefaultExperiment".to_owned(), Some(&lines.default_experiment)),
            ElementLocation::Variables => ("ModelVariables".to_owned(), Some(&lines.model_variables)),
            ElementLocation::Unit(at) => item("unit", all.units.get(at).map(|it| &it.name), &lines.units, at),
            ElementLocation::Type(at) => item("type", all.types.get(at).map(|it| &it.name), &lines.types, at),
            ElementLocation::Category(at) => {
                let name = all.log_categories.get(at).map(|it| &it.name);
                item("log category", name, &lines.log_categories, at)
            }
            ElementLocation::Variable(at) => {
                item("variable", all.variables.get(at).map(|it| &it.name), &lines.variables, at)
            }
            ElementLocation::Output(at) => entry("Outputs", &structure.outputs, &lines.outputs, at),
            ElementLocation::Derivative(at) => {
                entry("Derivatives", &structure.derivatives, &lines.derivatives, at)
            }
            ElementLocation::InitialUnknown(at) => {
                entry("InitialUnknowns", &structure.initial_unknowns, &lines.initial_unknowns, at)
            }
        }
    }

    /// The variable of a 1-based index.
    fn variable(&self, index: u32) -> Option<&'a ScalarVariable> {
        self.description.variables.get(index.checked_sub(1)? as usize)
    }

    /// The declared type of a variable, where it is defined.
    fn declared(&self, variable: &ScalarVariable) -> Option<&'a SimpleTypeKind> {
        declared_type(&variable.kind).and_then(|name| self.types.get(name)).map(|known| &known.kind)
    }

    /// One finding for each name that an earlier element of the list already has.
    fn unique<'n>(
        &mut self,
        code: Code,
        names: impl Iterator<Item = &'n str>,
        place: impl Fn(usize) -> ElementLocation,
    ) {
        let mut seen = BTreeMap::new();
        for (index, name) in names.enumerate() {
            if let Some(first) = seen.get(name) {
                let message = format!("the name `{name}` is already that of entry {first}; allowed is once");
                self.add(code, place(index), message);
            } else {
                seen.insert(name, index + 1);
            }
        }
    }
}

fn declared_type(kind: &VariableKind) -> Option<&str> {
    match kind {
        VariableKind::Real { declared_type, .. }
        | VariableKind::Integer { declared_type, .. }
        | VariableKind::Boolean { declared_type, .. }
        | VariableKind::String { declared_type, .. } => declared_type.as_deref(),
        VariableKind::Enumeration { declared_type, .. } => Some(declared_type),
    }
}

/// The index of the variable that this one differentiates.
fn derivative_of(variable: &ScalarVariable) -> Option<u32> {
    match variable.kind {
        VariableKind::Real { derivative, .. } => derivative,
        _ => None,
    }
}

/// Some of many names, for a message.
fn some_of<'n>(names: impl Iterator<Item = &'n str>) -> String {
    const SHOWN: usize = 8;
    let names: Vec<_> = names.collect();
    let mut text = names.iter().take(SHOWN).map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    if names.is_empty() {
        text.push_str("none");
    } else if names.len() > SHOWN {
        text.push_str(&format!(" and {} more", names.len() - SHOWN));
    }
    text
}
