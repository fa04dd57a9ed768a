//! Files that people write: mission, campaign, and what their values mean in an FMU. A text is read as the kind that its keys say,
//! and everything wrong in it is reported by line, key, what was found and what is allowed.
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "tests make their own files"))]
#![warn(clippy::print_stdout, clippy::print_stderr)]

pub mod campaign;
pub mod ending;
pub mod epoch;
pub mod home;
pub mod kind;
pub mod leg;
pub mod library;
pub mod mission;
pub mod plan;
pub mod reading;
#[cfg(test)]
mod schema;
pub mod values;
pub mod variables;
