//! Variables of one value reference: they are one value, so only one of them may be set.

use std::collections::BTreeMap;

use super::{Check, ElementLocation, some_of};
use crate::finding::Code;
use crate::{BaseType, Causality, ScalarVariable, Variability, rules, value};

impl Check<'_> {
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
        self.require(constants == 0 || constants == set.len(), Code::AliasConstant, place, || {
            format!(
                "value reference {reference} is shared by constants and others ({names}); allowed are all constant or none"
            )
        });
        let differ = || set.windows(2).any(|pair| value::start(pair[0]) != value::start(pair[1]));
        self.require(constants < set.len() || !differ(), Code::AliasConstant, place, || {
            format!(
                "constants with value reference {reference} ({names}) differ in start; allowed is one value"
            )
        });

        let settable = count(&|v| matches!(v.causality, Causality::Input | Causality::Parameter));
        let independent = count(&|v| v.causality == Causality::Independent);
        let with_start = count(&|v| v.variability != Variability::Constant && rules::has_start(v));
        let is_set_once = settable <= 1 && (independent == 0 || settable == 0);
        self.require(is_set_once, Code::AliasSettable, place, || {
            format!(
                "value reference {reference} is shared by several variables that are set from outside ({names}); allowed is \
                 one input or parameter, not beside the independent variable"
            )
        });
        self.require(!is_set_once || with_start <= 1, Code::AliasStart, place, || {
            format!(
                "{with_start} variables with value reference {reference} ({names}) have a start; allowed is one"
            )
        });

        let mut units = set.iter().map(|variable| value::unit(self.description, variable));
        let unit_of_first = units.next();
        let agree = units.all(|unit| Some(unit) == unit_of_first);
        self.require(agree, Code::AliasUnit, place, || {
            format!(
                "variables with value reference {reference} ({names}) differ in unit; the value is one number, so its unit \
                 should be one"
            )
        });
    }
}
