//! Exit status of every command, and how text and files are handed over.

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
pub type Outcome = Result<Answer, Box<dyn std::error::Error>>;

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

/// Prints the problems of a file and counts them; `kind` is what the file was read as.
pub fn refused(file: &str, problems: &str, kind: &str) -> Outcome {
    terminal::print(problems)?;
    terminal::note(&format!("{file}: {}, judged as {kind}", problem_count(problems, file)));
    Ok(Answer::No)
}

/// How many problems of a file a message tells, the unlisted ones among them: `1 problem`, `3 problems`.
fn problem_count(message: &str, file: &str) -> String {
    let of_line = |line: &str| -> usize {
        let unlisted = line.strip_prefix(file).and_then(|rest| {
            let rest = rest.strip_prefix(": ")?;
            rest.strip_suffix(" more problems").or_else(|| rest.strip_suffix(" more problem"))
        });
        unlisted.and_then(|count| count.parse().ok()).unwrap_or(1)
    };
    let count = message.lines().filter(|line| line.starts_with(file)).map(of_line).sum::<usize>().max(1);
    format!("{count} problem{}", if count == 1 { "" } else { "s" })
}
