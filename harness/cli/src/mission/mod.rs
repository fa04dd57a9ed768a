//! Mission files: what flies, when, with which values, what is kept of it and what it is judged by.

mod description;
mod file;
mod resolved;
#[cfg(feature = "schema")]
mod schema;
mod written;

pub(crate) use file::{At, Inputs, Mission, Plot, SpacecraftSource};
pub(crate) use resolved::{Resolved, in_file};
pub(crate) use written::Written;
