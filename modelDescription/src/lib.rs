//! FMI 2.0 model descriptions: types, rule tables, validator, writer, digest; feature `reader` adds the parser.
//!
//! Section numbers refer to the FMI 2.0.5 standard. Nothing here knows of a particular model.

mod description;
pub mod digest;
mod document;
mod finding;
pub mod names;
#[cfg(feature = "reader")]
mod reader;
pub mod rules;
pub mod units;
pub mod validate;
pub mod value;
mod words;
mod write;

pub use description::*;
pub use finding::{Code, Finding, Lines, Severity};
#[cfg(feature = "reader")]
pub use reader::{Parsed, ReadError, parse};
pub use validate::validate;
pub use write::{escape, to_xml};
