//! Mission files: what is simulated, when, with which values, what is recorded and what it is judged by.

mod description;
mod file;
mod resolved;
mod schema;

pub(crate) use file::{Inputs, Mission, Plot, SpacecraftSource};
pub(crate) use resolved::{Resolved, in_file};
