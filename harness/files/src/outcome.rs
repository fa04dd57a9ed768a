//! Outcomes of commands.

use std::process::ExitCode;

use crate::Destination;

/// The exit status, or why the command failed.
pub type Outcome = Result<ExitCode, Box<dyn std::error::Error>>;

/// Prints what a command came to.
pub fn printed(text: &str) -> Outcome {
    terminal::print(text)?;
    Ok(ExitCode::SUCCESS)
}

/// Writes a file and tells of it: on the standard output, unless that takes the file.
pub fn written(destination: Destination, content: &[u8], report: &str) -> Outcome {
    let is_stdout = destination.is_stdout();
    destination.fill(|file| file.write_all(content))?;
    if !is_stdout {
        return printed(report);
    }
    terminal::note(report);
    Ok(ExitCode::SUCCESS)
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
    Ok(ExitCode::FAILURE)
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
