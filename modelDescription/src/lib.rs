//! The facts of FMI 2.0: C functions, call table, status codes, base types, and model descriptions with their rules,
//! validator and writer; feature `reader` adds the parser.
//!
//! Section numbers refer to the FMI 2.0.5 standard. Nothing here knows of a particular model.

pub mod annotation;
mod base_type;
pub mod call_table;
pub mod describe;
mod description;
mod element;
mod finding;
pub mod functions;
pub mod labels;
mod lexical;
pub mod names;
pub mod quantity;
#[cfg(feature = "reader")]
mod reader;
pub mod rules;
pub mod start_values;
mod status;
pub mod units;
pub mod validate;
pub mod value;
mod words;
mod write;
mod writer;

pub use annotation::{Annotation, ReadWhere};
pub use base_type::BaseType;
pub use description::{
    BaseUnit, CoSimulation, DefaultExperiment, Description, DisplayUnit, EnumerationItem, LogCategory,
    ModelExchange, ModelStructure, RealAttributes, ScalarVariable, SimpleType, SimpleTypeKind, Unit, Unknown,
    VariableKind,
};
#[cfg(feature = "reader")]
pub use element::ReadError;
pub use finding::{Code, Finding, Lines, Severity};
#[cfg(feature = "reader")]
pub use reader::{MAX_BYTES, Parsed, Start, Xml, parse};
pub use status::Status;
pub use validate::validate;
pub use words::{
    Causality, DependencyKind, Initial, InterpolationKind, NamingConvention, Variability, VariableRole,
};
pub use write::to_xml;
pub use writer::{Writer, escape};
