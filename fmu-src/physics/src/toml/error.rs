//! Errors of a TOML file: file, line, key, what was found and what is allowed.

use core::fmt;

/// One thing wrong in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Line from 1, where it could be reported.
    pub line: Option<usize>,
    /// The key with its tables, items counted from 1: `sunshade.plates[3].area_m2`.
    pub key: String,
    /// Text or value found there.
    pub found: String,
    /// Values allowed there.
    pub allowed: String,
}

/// A spacecraft file that cannot be used, with everything found wrong in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileError {
    /// The file as the caller named it.
    pub file: String,
    /// At least one.
    pub problems: Vec<Problem>,
    /// How many more were found.
    pub unlisted: usize,
}

impl FileError {
    /// One problem of the file as a whole.
    pub(super) fn one(file: &str, line: Option<usize>, found: String, allowed: String) -> Self {
        let problem = Problem { line, key: String::new(), found, allowed };
        Self { file: file.to_owned(), problems: vec![problem], unlisted: 0 }
    }
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, problem) in self.problems.iter().enumerate() {
            if i > 0 {
                writeln!(f)?;
            }
            write!(f, "{}", self.file)?;
            if let Some(line) = problem.line {
                write!(f, ":{line}")?;
            }
            if !problem.key.is_empty() {
                write!(f, ": {}", problem.key)?;
            }
            write!(f, ": found {}", problem.found)?;
            if !problem.allowed.is_empty() {
                write!(f, ", allowed: {}", problem.allowed)?;
            }
        }
        match self.unlisted {
            0 => Ok(()),
            1 => write!(f, "\n{}: 1 more problem", self.file),
            more => write!(f, "\n{}: {more} more problems", self.file),
        }
    }
}

impl std::error::Error for FileError {}
