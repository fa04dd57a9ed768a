//! The four base types of the C interface.

use crate::VariableKind;

/// A base type of the C interface; an Enumeration is an Integer there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum BaseType {
    /// `fmi2Real`.
    Real,
    /// `fmi2Integer`, Enumerations included.
    Integer,
    /// `fmi2Boolean`.
    Boolean,
    /// `fmi2String`.
    String,
}

impl BaseType {
    /// Every base type.
    pub const ALL: [Self; 4] = [Self::Real, Self::Integer, Self::Boolean, Self::String];

    /// The standard's word.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Real => "Real",
            Self::Integer => "Integer",
            Self::Boolean => "Boolean",
            Self::String => "String",
        }
    }
}

impl VariableKind {
    /// The standard's word.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Enumeration { .. } => "Enumeration",
            other => other.base_type().name(),
        }
    }

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
