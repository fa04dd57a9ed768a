//! Errors of an FMU, each with file, call and remedy.

use std::path::{Path, PathBuf};

use crate::{LogMessage, Status};

/// Failure to load or call an FMU.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file or folder cannot be read or written.
    #[error("{}: {source}", path.display())]
    File {
        /// Path of the file.
        path: PathBuf,
        /// Error of the system.
        source: std::io::Error,
    },
    /// The archive is no usable FMU.
    #[error("{}: not a usable FMU archive: {what}", path.display())]
    Archive {
        /// The archive.
        path: PathBuf,
        /// Fault of the file.
        what: String,
    },
    /// The FMU, or its shared library, is none that can be used here.
    #[error("{}: {what}", path.display())]
    Unusable {
        /// The FMU or the library.
        path: PathBuf,
        /// Fault, with line and element where known.
        what: String,
    },
    /// An FMI call failed.
    #[error(transparent)]
    Call(#[from] Box<CallError>),
    /// A name that the FMU does not have.
    #[error("{fmu}: no variable {name:?}{hint}")]
    UnknownVariable {
        /// Model name.
        fmu: String,
        /// The requested name.
        name: String,
        /// Similar names, or where to see all.
        hint: String,
    },
    /// A pattern that fits variables but no output.
    #[error("{fmu}: no output fits {pattern:?}: a * takes outputs only, anything else is named: {example}")]
    NoOutput {
        /// Model name.
        fmu: String,
        /// The pattern.
        pattern: String,
        /// A variable that it fits.
        example: String,
    },
    /// A value that does not fit its variable.
    #[error("{variable}: {what}")]
    Value {
        /// The variable.
        variable: String,
        /// Value that was found and what is allowed.
        what: String,
    },
    /// An input table that cannot be used.
    #[error("input table: {0}")]
    Inputs(String),
    /// Start, stop or step that make no run.
    #[error("{0}")]
    Times(String),
    /// The recipient of the rows takes no more, or failed.
    #[error("{0}")]
    Rows(String),
}

/// An FMI call that was not answered with fmi2OK or fmi2Warning, or was not allowed to be made.
#[derive(Debug, thiserror::Error)]
#[error("{fmu}, instance {instance:?}: {call}: {outcome}{}", messages_text(messages))]
pub struct CallError {
    /// Model name.
    pub fmu: String,
    /// Instance name.
    pub instance: String,
    /// The function with what matters of its arguments.
    pub call: String,
    /// Outcome of the call.
    pub outcome: Outcome,
    /// The last messages the instance logged.
    pub messages: Vec<LogMessage>,
}

/// How a call failed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Outcome {
    /// The FMU's answer.
    #[error("answered {0}")]
    Status(Status),
    /// The FMU answered a number that is no status of FMI 2.0.
    #[error("answered status {0}, which FMI 2.0 does not have")]
    UnknownStatus(i32),
    /// The library does not export the function.
    #[error("the library does not export this function")]
    Missing,
    /// `fmi2Instantiate` gave NULL.
    #[error("gave no instance")]
    NoInstance,
    /// The call checker refused the call: the FMI state, or why.
    #[error("not made: {0}")]
    NotAllowed(String),
    /// The arguments make no sense before any call is made.
    #[error("not made: {0}")]
    BadArguments(String),
    /// The answer was good but its number is NaN, at this time in s.
    #[error("answered NaN at {0} s")]
    NotANumber(f64),
}

impl CallError {
    /// The FMU's status, if the call was made and answered.
    pub fn status(&self) -> Option<Status> {
        match self.outcome {
            Outcome::Status(status) => Some(status),
            _ => None,
        }
    }
}

/// How many of the last messages an error shows.
pub(crate) const MESSAGES_SHOWN: usize = 5;

fn messages_text(messages: &[LogMessage]) -> String {
    messages.iter().map(|message| format!("\n    {message}")).collect()
}

impl Error {
    /// The error of the system at this file, for `map_err`.
    pub fn file(path: &Path) -> impl Fn(std::io::Error) -> Self {
        |source| Self::File { path: path.to_owned(), source }
    }

    /// The status, if this is an FMI call that was answered.
    pub fn status(&self) -> Option<Status> {
        match self {
            Self::Call(call) => call.status(),
            _ => None,
        }
    }

    /// Whether an FMI call was answered with a number that is no status.
    pub fn has_unknown_status(&self) -> bool {
        matches!(self, Self::Call(call) if matches!(call.outcome, Outcome::UnknownStatus(_)))
    }

    /// Joins an error with all its sources.
    pub fn chain(error: &dyn std::error::Error) -> String {
        let mut text = error.to_string();
        let mut source = error.source();
        while let Some(inner) = source {
            let inner_text = inner.to_string();
            if !text.contains(&inner_text) {
                text.push_str(": ");
                text.push_str(&inner_text);
            }
            source = inner.source();
        }
        text
    }
}
