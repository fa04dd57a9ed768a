//! Exit status of every command, and how text and files are handed over.

use std::{error::Error, fmt};

use crate::Destination;

/// Answer of a command that came to its end, by its exit status; one that did not ends with [`TROUBLE`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[repr(u8)]
pub enum Answer {
    /// Done.
    Yes = 0,
    /// Tables differ, a check failed, a plan is infeasible, a limit is broken, runs failed.
    No = 1,
    /// Ctrl-C or another signal ended it.
    Interrupted = 130,
}

/// Exit status where arguments, a file or an FMU do not let the command do its work; clap's own for usage.
pub const TROUBLE: u8 = 2;

/// Exit statuses as every help and every page of the manual lists them.
pub const STATUSES: [(&str, &str); 4] = [
    ("0", "done"),
    (
        "1",
        "the answer is no: tables differ, a check failed, a plan is infeasible, a limit is broken, runs failed",
    ),
    ("2", "trouble with arguments, a file or an FMU"),
    ("130", "interrupted"),
];

/// The answer of a command, or why it could not be found.
pub type Outcome = Result<Answer, Box<dyn Error>>;

impl From<bool> for Answer {
    fn from(is_so: bool) -> Self {
        if is_so { Self::Yes } else { Self::No }
    }
}

/// Answers no for a reason.
pub fn no(reason: &str) -> Outcome {
    terminal::note(&format!("heliotorque: {reason}"));
    Ok(Answer::No)
}

/// Prints what a command came to.
pub fn printed(text: &str) -> Outcome {
    terminal::print(text)?;
    Ok(Answer::Yes)
}

/// Writes a file and tells of it: on the standard output, unless that takes the file.
pub fn written(destination: Destination, content: &[u8], report: &str) -> Outcome {
    let is_stdout = destination.is_stdout();
    destination.fill(|file| file.write_all(content))?;
    if !is_stdout {
        return printed(report);
    }
    terminal::note(report);
    Ok(Answer::Yes)
}

/// Writes files, and notes their names.
pub fn write_all(
    files: impl IntoIterator<Item = (Destination, String)>,
    is_quiet: bool,
) -> Result<(), String> {
    for (destination, content) in files {
        let path = destination.path().to_owned();
        destination.fill(|file| file.write_all(content.as_bytes()))?;
        if !is_quiet {
            terminal::note(&format!("wrote {}", path.display()));
        }
    }
    Ok(())
}

/// Everything wrong in files, and how many problems that are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// Problems, which begin a line each.
    pub text: String,
    /// Number of problems, the unlisted ones among them.
    pub count: usize,
}

impl Refusal {
    /// Returns the refusal of these problems; `None` where there are none.
    pub fn of_all(problems: &[String]) -> Option<Self> {
        (!problems.is_empty()).then(|| Self { text: problems.join("\n"), count: problems.len() })
    }

    /// Returns the refusal that an error is, or one of a single problem; `text` is the error's with its sources.
    pub fn new(error: &(dyn Error + 'static), text: String) -> Self {
        error.downcast_ref().cloned().unwrap_or(Self { text, count: 1 })
    }

    /// Prints the problems and their count; `kind` is what the file was read as.
    pub fn print(&self, file: &str, kind: &str) -> Outcome {
        terminal::print(&self.text)?;
        let plural = if self.count == 1 { "" } else { "s" };
        terminal::note(&format!("{file}: {} problem{plural}, judged as {kind}", self.count));
        Ok(Answer::No)
    }
}

impl From<String> for Refusal {
    fn from(text: String) -> Self {
        Self { text, count: 1 }
    }
}

impl From<Refusal> for String {
    fn from(refusal: Refusal) -> Self {
        refusal.text
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl Error for Refusal {}
