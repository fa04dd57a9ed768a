//! Mission files: what flies, when, with which values, what is kept of it and what it is judged by.

mod description;
mod file;
mod resolved;
mod schema;

pub(crate) use file::{Inputs, Mission, Plot, SpacecraftSource};
pub(crate) use resolved::{Resolved, in_file};
