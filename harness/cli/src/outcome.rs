//! What every command ends with.

use std::process::ExitCode;

/// The exit status, or why the command failed.
pub type Outcome = Result<ExitCode, Box<dyn std::error::Error>>;
