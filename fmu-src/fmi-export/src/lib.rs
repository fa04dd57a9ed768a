//! Export of models as FMUs: model traits, declarations and values of variables, and [`fmi2`], the adapter for FMI 2.0
//! co-simulation.
//!
//! A model implements [`Model`] and declares its variables with `#[derive(Variables)]`, free of any version of FMI.
//! Everything an importer sees (XML, value references, states, status codes, logging) is made in [`fmi2`]; an adapter for
//! another version would stand next to it. Nothing here knows what a model is about.
//!
//! A shared library is one line, `fmi_export::export!(ModelA, ModelB);` in a crate of type cdylib.

// The derives write `::fmi_export`, in this crate's own unit tests too.
#[cfg(test)]
extern crate self as fmi_export;

mod bounded;
mod dependencies;
pub mod fmi2;
mod library;
mod location;
pub mod logger;
pub mod model;
mod panics;
mod prepared;
mod runtime;
mod start_values;
mod state_bytes;
pub mod time;
pub mod variables;

pub use bounded::check_finite;
pub use dependencies::{Dependencies, Knowns, Section};
pub use fmi_export_derive::{Enumeration, Variables};
pub use library::{Entry, Library};
pub use model::{
    About, Context, DeferredOutputs, Differentiable, Extensions, Failure, InputDerivative, InputsOverTime,
    Manual, Model, OutputGroups, OutputRates, SetupError, SetupValue, StartValue, Step, StepEnd,
};
pub use model_description::{self, BaseType, Status};
pub use state_bytes::checksum;
pub use variables::{
    Boolean, Choice, Declare, DeclareError, Element, Elements, Enumeration, Given, Integer, Interface, Real,
    RealMatrix, RealVector, Text, Values, Variables,
};
