//! Everything that a model declares, free of any version of FMI.

use serde::Serialize;

use super::Values;
use super::variable::{DeclaredEnumeration, Variable};

/// The declarations of a model; serialised they enter the GUID, every fact of them.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Interface {
    /// The variables in the order of declaration.
    pub variables: Vec<Variable>,
    /// The enumerations of these variables, in the order of first use.
    pub enumerations: Vec<DeclaredEnumeration>,
    /// Start values (0, false, "" or the first item where none is declared).
    pub start: Values,
}

#[cfg(test)]
mod tests;
