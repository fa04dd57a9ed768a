//! Why a file cannot be read.

use core::fmt;

use crate::finding::{Code, Finding};

/// Why a file cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReadError {
    /// The broken rule.
    pub code: Code,
    /// Line, 1-based.
    pub line: u32,
    /// The element, empty where there is none.
    pub element: String,
    /// The text, with what was found and what is allowed.
    pub message: String,
}

impl ReadError {
    /// The error of an element in a line.
    pub fn new(code: Code, line: u32, element: &str, message: String) -> Self {
        Self { code, line, element: element.to_owned(), message }
    }
}

impl fmt::Display for ReadError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "line {}: ", self.line)?;
        if !self.element.is_empty() {
            write!(formatter, "<{}>: ", self.element)?;
        }
        formatter.write_str(&self.message)
    }
}

impl core::error::Error for ReadError {}

impl From<ReadError> for Finding {
    fn from(error: ReadError) -> Self {
        let subject =
            if error.element.is_empty() { "file".to_owned() } else { format!("<{}>", error.element) };
        Self { code: error.code, subject, line: Some(error.line), message: error.message }
    }
}
