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

mod dependencies;
pub mod fmi2;
pub mod model;
mod panics;
mod runtime;
pub mod time;
pub mod variables;

pub use dependencies::{Dependencies, Knowns};
pub use fmi_export_derive::{Enumeration, Variables};
pub use fmi2::{Entry, Given, Library, StartValue};
pub use model::{About, Context, Failure, Model, SetupError, Source, Step};
pub use model_description::{self, BaseType, Status};
pub use variables::{
    Boolean, Choice, Declare, DeclareError, Enumeration, Integer, Real, RealMatrix, RealVector, Text, Values,
    Variables,
};
