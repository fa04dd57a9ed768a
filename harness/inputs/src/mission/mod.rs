//! Mission files: what is simulated, when, with which values, what is recorded and what it is judged by.

pub mod description;
pub mod file;
pub mod resolved;
pub mod schema;

pub use file::{Inputs, Mission, Plot, SpacecraftSource};
pub use resolved::{Limit, Resolved, in_file};
