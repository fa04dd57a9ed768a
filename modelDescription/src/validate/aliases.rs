//! Variables of one value reference: they are one value, so only one of them may be set.

use std::collections::BTreeMap;

use super::{Check, ElementLocation, some_of};
use crate::finding::Code;
use crate::{BaseType, Causality, ScalarVariable, SimpleTypeKind, Variability, VariableKind, rules, value};

impl<'a> Check<'a> {
    pub(super) fn aliases(&mut self) {
        let mut sets: BTreeMap<(BaseType, u32), Vec<usize>> = BTreeMap::new();
        for (index, variable) in self.description.variables.iter().enumerate() {
            sets.entry((variable.kind.base_type(), variable.value_reference)).or_default().push(index);
        }
        for members in sets.values().filter(|members| members.len() > 1) {
            self.alias_set(members);
        }
    }

    fn alias_set(&mut self, members: &[usize]) {
        let all = &self.description.variables;
        let set: Vec<&ScalarVariable> = members.iter().filter_map(|&index| all.get(index)).collect();
        let Some(&last) = members.last() else { return };
        let place = ElementLocation::Variable(last);
        let reference = set.first().map_or(0, |variable| variable.value_reference);
        let names = some_of(set.iter().map(|variable| variable.name.as_str()));
        let count = |is: &dyn Fn(&ScalarVariable) -> bool| set.iter().filter(|v| is(v)).count();

        let constants = count(&|v| v.variability == Variability::Constant);
        if constants > 0 && constants < set.len() {
            let message = format!(
                "value reference {reference} is shared by constants and others ({names}); \
                                   allowed are all constant or none"
            );
            self.add(Code::AliasConstant, place, message);
        } else if constants > 0 && set.windows(2).any(|pair| value::start(pair[0]) != value::start(pair[1])) {
            let message = format!(
                "constants with value reference {reference} ({names}) differ in start; \
                                   allowed is one value"
            );
            self.add(Code::AliasConstant, place, message);
        }

        let settable = count(&|v| matches!(v.causality, Causality::Input | Causality::Parameter));
        let independent = count(&|v| v.causality == Causality::Independent);
        let with_start = count(&|v| v.variability != Variability::Constant && rules::has_start(v));
        if settable > 1 || (independent > 0 && settable > 0) {
            let message = format!(
                "value reference {reference} is shared by several variables that are set from \
                                   outside ({names}); allowed is one input or parameter, not beside the \
                                   independent variable"
            );
            self.add(Code::AliasSettable, place, message);
        } else if with_start > 1 {
            let message = format!(
                "{with_start} variables with value reference {reference} ({names}) have a \
                                   start; allowed is one"
            );
            self.add(Code::AliasStart, place, message);
        }

        let unit_of_first = set.first().and_then(|first| self.unit_of(first));
        if set.iter().any(|variable| self.unit_of(variable) != unit_of_first) {
            let message = format!(
                "variables with value reference {reference} ({names}) differ in unit; the \
                                   value is one number, so its unit should be one"
            );
            self.add(Code::AliasUnit, place, message);
        }
    }

    fn unit_of(&self, variable: &'a ScalarVariable) -> Option<&'a str> {
        let VariableKind::Real { attributes, .. } = &variable.kind else { return None };
        let inherited = match self.declared(variable) {
            Some(SimpleTypeKind::Real { attributes: inherited }) => inherited.unit.as_deref(),
            _ => None,
        };
        attributes.unit.as_deref().or(inherited)
    }
}
