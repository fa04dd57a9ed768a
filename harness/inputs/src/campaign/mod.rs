//! Campaign files: variables that vary over many runs, and the results that are kept of each.

pub mod file;
pub mod keys;
