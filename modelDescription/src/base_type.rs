//! The four base types of the C interface.

use crate::VariableKind;
use crate::words::words;

words! {
    /// A base type of the C interface; an Enumeration is an Integer there.
    pub enum BaseType, name {
        /// `fmi2Real`.
        Real => "Real",
        /// `fmi2Integer`, Enumerations included.
        Integer => "Integer",
        /// `fmi2Boolean`.
        Boolean => "Boolean",
        /// `fmi2String`.
        String => "String",
    }
}

impl VariableKind {
    /// The base type at the C interface.
    pub const fn base_type(&self) -> BaseType {
        match self {
            Self::Real { .. } => BaseType::Real,
            Self::Integer { .. } | Self::Enumeration { .. } => BaseType::Integer,
            Self::Boolean { .. } => BaseType::Boolean,
            Self::String { .. } => BaseType::String,
        }
    }
}
