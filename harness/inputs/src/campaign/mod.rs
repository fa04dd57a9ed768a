//! Campaign files: variables that vary over many runs, and the results that are kept of each.

pub mod description;
pub mod file;
pub mod schema;
