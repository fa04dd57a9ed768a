//! FMI 2.0 co-simulation export: model trait, variable tables, call-state machine, C interface.
//!
//! A model implements [`Model`] and declares its variables with `#[derive(Variables)]`. Everything a master
//! sees (XML, value references, states, status codes, logging) is made here; nothing here knows what a model
//! is about. The trait is free of FMI-version-specific types.
//!
//! A shared library is one line, `fmi_export::export!(ModelA, ModelB);` in a crate of type cdylib.

// The derives write `::fmi_export`, in this crate's own unit tests too.
#[cfg(test)]
extern crate self as fmi_export;

pub mod abi;
mod access;
mod blob;
pub mod call_table;
mod dependencies;
mod describe;
mod instance;
mod library;
mod location;
pub mod logger;
mod memory;
pub mod model;
mod panics;
mod problem;
mod runtime;
mod start;
mod status;
pub mod time;
pub mod variables;

pub use access::BaseType;
pub use dependencies::{Dependencies, Knowns};
pub use describe::{DescribeError, describe};
pub use fmi_export_derive::{Enumeration, Variables};
pub use library::{Entry, Library};
pub use memory::MAX_INPUT_DERIVATIVE_ORDER;
pub use model::{About, Context, Failure, Model, SetupError, Source, Step};
pub use model_description;
pub use problem::StateMismatch;
pub use start::{Given, StartValue};
pub use status::Status;
pub use variables::{
    Boolean, Choice, Declare, DeclareError, Enumeration, Integer, Real, RealMatrix, RealVector, Text, Values,
    Variables,
};
