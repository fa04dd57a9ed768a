//! The model structure: which variables its lists name, and what the dependencies say.

use std::collections::BTreeSet;

use super::{Check, ElementLocation, derivative_of, some_of};
use crate::finding::Code;
use crate::{Causality, DependencyKind, Initial, ScalarVariable, Unknown, VariableKind, rules};

/// Whether a variable, with its index, may be depended on.
type Known<'k> = &'k dyn Fn(u32, &ScalarVariable) -> bool;

/// A list of unknowns: where each stands, what it may depend on, and that in words.
type List<'l> = (&'l [Unknown], fn(usize) -> ElementLocation, Known<'l>, &'l str);

impl Check<'_> {
    pub(super) fn structure(&mut self) {
        let structure = &self.description.structure;
        self.entries(&structure.outputs, ElementLocation::Output);
        self.entries(&structure.derivatives, ElementLocation::Derivative);
        self.entries(&structure.initial_unknowns, ElementLocation::InitialUnknown);
        self.outputs();
        self.derivatives();
        self.initial_unknowns();
        self.dependencies();
    }

    /// Index range and duplicates of one list.
    fn entries(&mut self, unknowns: &[Unknown], place: impl Fn(usize) -> ElementLocation) {
        let mut seen = BTreeSet::new();
        let count = self.description.variables.len();
        for (at, unknown) in unknowns.iter().enumerate() {
            if self.variable(unknown.index).is_none() {
                let message = format!("index is {}; allowed is 1 to {count}", unknown.index);
                self.add(Code::StructureIndex, place(at), message);
            } else if !seen.insert(unknown.index) {
                let message =
                    format!("index {} stands in an earlier entry too; allowed is once", unknown.index);
                self.add(Code::StructureDuplicate, place(at), message);
            }
        }
    }

    fn outputs(&mut self) {
        let all = self.description;
        let listed: BTreeSet<u32> = all.structure.outputs.iter().map(|unknown| unknown.index).collect();
        for index in rules::outputs(&all.variables) {
            let place = ElementLocation::Variable(index as usize - 1);
            self.require(listed.contains(&index), Code::OutputMissing, place, || {
                format!("is an output (index {index}) but not in ModelStructure/Outputs")
            });
        }
        for (at, unknown) in all.structure.outputs.iter().enumerate() {
            if let Some(variable) = self.variable(unknown.index)
                && variable.causality != Causality::Output
            {
                let message = format!("has causality {}; allowed are outputs", variable.causality);
                self.add(Code::OutputExtra, ElementLocation::Output(at), message);
            }
        }
    }

    fn derivatives(&mut self) {
        let all = self.description;
        for (at, unknown) in all.structure.derivatives.iter().enumerate() {
            let is_derivative = self.variable(unknown.index).is_none_or(|it| derivative_of(it).is_some());
            self.require(is_derivative, Code::DerivativeEntry, ElementLocation::Derivative(at), || {
                "has no attribute `derivative`; allowed are derivatives of states".to_owned()
            });
        }
        if all.model_exchange.is_none() {
            return;
        }
        let listed: BTreeSet<u32> = all.structure.derivatives.iter().map(|unknown| unknown.index).collect();
        for (index, at) in (1..).zip(0..all.variables.len()) {
            let is_listed = derivative_of(&all.variables[at]).is_none() || listed.contains(&index);
            self.require(is_listed, Code::DerivativeUnlisted, ElementLocation::Variable(at), || {
                format!("is a derivative (index {index}) but not in ModelStructure/Derivatives")
            });
        }
    }

    fn initial_unknowns(&mut self) {
        let all = self.description;
        let expected = rules::initial_unknowns(&all.variables, &all.structure.derivatives);
        let list = &all.structure.initial_unknowns;
        let listed: BTreeSet<u32> = list.iter().map(|unknown| unknown.index).collect();
        for index in expected.iter().filter(|index| !listed.contains(index)) {
            let message = format!(
                "is an unknown of initialization (index {index}) but not in ModelStructure/InitialUnknowns"
            );
            self.add(Code::InitialUnknownMissing, ElementLocation::Variable(*index as usize - 1), message);
        }
        for (at, unknown) in list.iter().enumerate() {
            let Some(variable) = self.variable(unknown.index) else { continue };
            if expected.binary_search(&unknown.index).is_err() {
                let initial = rules::effective_initial(variable).map_or("none", Initial::as_str);
                let message = format!(
                    "has causality {} and initial {initial}; allowed are outputs with approx or calculated, \
                     calculated parameters, and listed derivatives and their states with approx or calculated",
                    variable.causality
                );
                self.add(Code::InitialUnknownExtra, ElementLocation::InitialUnknown(at), message);
            }
        }
        for (at, pair) in (1..).zip(list.windows(2)) {
            let (before, index) = (pair[0].index, pair[1].index);
            self.require(
                before <= index,
                Code::InitialUnknownOrder,
                ElementLocation::InitialUnknown(at),
                || format!("index {index} follows {before}; the list must be ordered by index"),
            );
        }
    }

    fn dependencies(&mut self) {
        let structure = &self.description.structure;
        let variables = &self.description.variables;
        let states: BTreeSet<u32> = variables.iter().filter_map(derivative_of).collect();
        let from_outside =
            |v: &ScalarVariable| matches!(v.causality, Causality::Input | Causality::Independent);
        let at_steps = |index: u32, v: &ScalarVariable| from_outside(v) || states.contains(&index);
        let at_start = |_: u32, v: &ScalarVariable| {
            from_outside(v) || rules::effective_initial(v) == Some(Initial::Exact)
        };
        let step_rule = "inputs, continuous states and the independent variable";
        let start_rule = "inputs, variables with initial exact and the independent variable";
        let lists: [List<'_>; 3] = [
            (&structure.outputs, ElementLocation::Output, &at_steps, step_rule),
            (&structure.derivatives, ElementLocation::Derivative, &at_steps, step_rule),
            (&structure.initial_unknowns, ElementLocation::InitialUnknown, &at_start, start_rule),
        ];
        for (unknowns, place, known, rule) in lists {
            for (at, unknown) in unknowns.iter().enumerate() {
                self.unknown(unknown, place(at), known, rule);
            }
        }
        for (at, unknown) in structure.initial_unknowns.iter().enumerate() {
            let mut kinds = unknown.dependencies_kind.iter().flatten();
            if let Some(bad) =
                kinds.find(|kind| !matches!(kind, DependencyKind::Dependent | DependencyKind::Constant))
            {
                let message = format!("dependenciesKind has {bad}; allowed are dependent and constant");
                self.add(Code::DependencyKindInitial, ElementLocation::InitialUnknown(at), message);
            }
        }
    }

    fn unknown(&mut self, unknown: &Unknown, place: ElementLocation, known: Known<'_>, rule: &str) {
        let Some(dependencies) = &unknown.dependencies else {
            return self.require(
                unknown.dependencies_kind.is_none(),
                Code::DependencyKindAlone,
                place,
                || "has dependenciesKind but no dependencies; allowed is both or neither".to_owned(),
            );
        };
        let count = self.description.variables.len();
        if let Some(bad) = dependencies.iter().find(|index| self.variable(**index).is_none()) {
            let message = format!("dependencies has {bad}; allowed is 1 to {count}");
            self.add(Code::DependencyIndex, place, message);
        }
        if let Some(pair) = dependencies.windows(2).find(|pair| pair[0] >= pair[1]) {
            let message =
                format!("dependencies has {} after {}; allowed is ascending order", pair[1], pair[0]);
            self.add(Code::DependencyOrder, place, message);
        }
        let strangers: Vec<&str> = dependencies
            .iter()
            .filter_map(|&index| self.variable(index).filter(|v| !known(index, v)))
            .map(|variable| variable.name.as_str())
            .collect();
        self.require(strangers.is_empty(), Code::DependencyKnown, place, || {
            format!("dependencies has {}; allowed are {rule}", some_of(strangers.into_iter()))
        });
        self.dependency_kinds(unknown, dependencies, place);
    }

    fn dependency_kinds(&mut self, unknown: &Unknown, dependencies: &[u32], place: ElementLocation) {
        let Some(kinds) = &unknown.dependencies_kind else { return };
        let (found, expected) = (kinds.len(), dependencies.len());
        if found != expected {
            let message = format!(
                "dependenciesKind has {found} entries, dependencies {expected}; allowed is the same number"
            );
            return self.add(Code::DependencyKindCount, place, message);
        }
        // The standard requires this of the unknown alone: a Real may have a factor for a known of any type.
        let variable = self.variable(unknown.index);
        if variable.is_none_or(|variable| matches!(variable.kind, VariableKind::Real { .. })) {
            return;
        }
        let factor = dependencies.iter().zip(kinds).find(|(_, kind)| **kind != DependencyKind::Dependent);
        if let Some((index, kind)) = factor {
            let message = format!(
                "dependenciesKind is {kind} for index {index}; it has a meaning for Real unknowns only"
            );
            self.add(Code::DependencyKindReal, place, message);
        }
    }
}
