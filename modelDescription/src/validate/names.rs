//! Names of variables and types.

use std::collections::BTreeSet;

use super::{Check, ElementLocation};
use crate::finding::Code;
use crate::names::{check_flat, check_structured};
use crate::{NamingConvention, VariableKind};

impl Check<'_> {
    pub(super) fn names(&mut self) {
        let all = self.description;
        let names = || all.variables.iter().map(|variable| variable.name.as_str());
        self.unique(Code::DuplicateName, names(), ElementLocation::Variable);
        for (index, variable) in all.variables.iter().enumerate() {
            let structured = all.variable_naming == NamingConvention::Structured;
            let name = variable.name.as_str();
            let legal = if structured { check_structured(name) } else { check_flat(name) };
            if let Err(problem) = legal {
                let message = format!("the name (convention {}) {problem}", all.variable_naming);
                self.add(Code::IllegalName, ElementLocation::Variable(index), message);
            } else if structured
                && name.starts_with("der(")
                && !matches!(variable.kind, VariableKind::Real { .. })
            {
                let message = "a name der(...) is given to a variable that is no Real; allowed are Reals";
                self.add(Code::IllegalName, ElementLocation::Variable(index), message.to_owned());
            }
        }
        let variables: BTreeSet<&str> = names().collect();
        for (index, known) in all.types.iter().enumerate() {
            if variables.contains(known.name.as_str()) {
                let message = "a variable has the same name; allowed is a name of its own".to_owned();
                self.add(Code::TypeNameIsVariable, ElementLocation::Type(index), message);
            }
        }
    }
}
