//! Annotations of variables: what they name is there.

use std::collections::BTreeMap;

use super::{Check, ElementLocation};
use crate::finding::Code;
use crate::{Annotation, Causality, ScalarVariable, SimpleTypeKind, VariableKind, rules};

type ByName<'a> = BTreeMap<&'a str, &'a ScalarVariable>;

impl Check<'_> {
    pub(super) fn annotations(&mut self) {
        let variables = &self.description.variables;
        if variables.iter().all(|it| it.annotation.is_none()) {
            return;
        }
        let by_name: ByName<'_> = variables.iter().map(|it| (it.name.as_str(), it)).collect();
        for (index, variable) in variables.iter().enumerate() {
            let Some(annotation) = variable.annotation.as_deref() else { continue };
            for (attribute, found, allowed) in self.misfits(variable, annotation, &by_name) {
                let message = format!("its annotation has {attribute} `{found}`; allowed is {allowed}");
                self.add(Code::Annotation, ElementLocation::Variable(index), message);
            }
        }
    }

    /// Attributes with what was found and what is allowed.
    fn misfits(
        &self,
        variable: &ScalarVariable,
        annotation: &Annotation,
        by_name: &ByName<'_>,
    ) -> Vec<(&'static str, String, String)> {
        let is_real = |it: &ScalarVariable| matches!(it.kind, VariableKind::Real { .. });
        let is_real_named = |name: &str| by_name.get(name).is_some_and(|it| is_real(it));
        let is_input = variable.causality == Causality::Input;
        let mut found = Vec::new();
        let mut require = |holds: bool, attribute, value: &str, allowed: &str| {
            if !holds {
                found.push((attribute, value.to_owned(), allowed.to_owned()));
            }
        };
        if let Some(name) = &annotation.also_called {
            require(is_input, "alsoCalled", name, "on an input alone");
        }
        if let Some(name) = &annotation.limited_by {
            require(is_real_named(name), "limitedBy", name, "a Real of this FMU");
        }
        if let Some(role) = annotation.role {
            require(is_real(variable), "role", role.as_str(), "on a Real alone");
        }
        if let Some(interpolation) = annotation.interpolation {
            require(is_real(variable), "interpolation", interpolation.as_str(), "on a Real alone");
        }
        if let Some(name) = &annotation.rate {
            let is_there = is_real_named(name) || is_real_named(&format!("{name}[1]"));
            require(is_there, "rate", name, "a Real of this FMU, or a vector of them");
        }
        for option in &annotation.read_where {
            require(is_input, "ReadWhere", &option.option, "on an input alone");
            let known = by_name.get(option.option.as_str()).and_then(|it| self.declared(it));
            let Some(SimpleTypeKind::Enumeration { items, .. }) = known else {
                require(false, "ReadWhere option", &option.option, "an Enumeration of this FMU");
                continue;
            };
            let names = || rules::listed(items.iter().map(|item| item.name.as_str()));
            let is_item = |word: &&String| items.iter().any(|item| item.is_called(word));
            let unknown = option.items.iter().chain(&option.set).find(|word| !is_item(word));
            require(unknown.is_none(), "ReadWhere items", unknown.map_or("", String::as_str), &names());
            require(!option.items.is_empty(), "ReadWhere items", "", &names());
        }
        found
    }
}
