//! Running programs: what is run is shown, a failure names it.

use std::ffi::OsStr;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Instant;

use crate::timing;

/// Result of a task; the text of an error says what failed.
pub(crate) type Outcome = Result<(), String>;

/// The folder of the workspace that the task was started in, also after the checkout was copied or moved: nothing of where
/// it was compiled is kept.
pub(crate) fn root() -> PathBuf {
    // Set by `cargo xtask`.
    let manifest = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    let of_manifest = manifest.as_deref().and_then(workspace_above);
    let above = || workspace_above(&std::env::current_dir().ok()?);
    of_manifest.or_else(above).unwrap_or_else(|| PathBuf::from("."))
}

/// The nearest folder from `folder` upward that is this workspace.
fn workspace_above(folder: &Path) -> Option<PathBuf> {
    let is_workspace =
        |folder: &&Path| folder.join("Cargo.toml").is_file() && folder.join("xtask/Cargo.toml").is_file();
    folder.ancestors().find(is_workspace).map(Path::to_path_buf)
}

/// The folder cargo builds into.
pub(crate) fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from)
}

/// A command that runs in the workspace folder.
pub(crate) fn command(program: impl AsRef<OsStr>) -> Command {
    let mut command = Command::new(program);
    command.current_dir(root());
    command
}

/// `cargo` with the words of a text as arguments.
pub(crate) fn cargo(arguments: &str) -> Command {
    let mut command = command(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.args(arguments.split_whitespace());
    command
}

/// Runs to the end and expects success.
pub(crate) fn run(command: &mut Command) -> Outcome {
    let shown = show(command);
    eprintln!("+ {shown}");
    let start = Instant::now();
    let mut child = command.spawn().map_err(|error| format!("cannot start `{shown}`: {error}"))?;
    ended(&shown, start, &mut child)
}

/// Time at which the output of tests is shown.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Echo {
    /// Line by line.
    AsItComes,
    /// All at once, as others run at the same time.
    AtTheEnd,
}

/// Runs tests to the end and expects success; shows their output and counts the times in it.
pub(crate) fn run_tests(command: &mut Command, echo: Echo) -> Outcome {
    let named = show(command);
    eprintln!("+ {named}");
    let start = Instant::now();
    let spawned = command.stdout(Stdio::piped()).spawn();
    let mut child = spawned.map_err(|error| format!("cannot start `{named}`: {error}"))?;
    let mut printed = Vec::new();
    let print = |bytes: &[u8]| std::io::stdout().write_all(bytes).map_err(|error| error.to_string());
    if let Some(output) = child.stdout.take() {
        let mut lines = BufReader::new(output);
        let mut line = Vec::new();
        while lines.read_until(b'\n', &mut line).is_ok_and(|count| count > 0) {
            if echo == Echo::AsItComes {
                print(&line)?;
            }
            printed.append(&mut line);
        }
    }
    if echo == Echo::AtTheEnd {
        print(&printed)?;
    }
    timing::add_tests(&String::from_utf8_lossy(&printed));
    ended(&named, start, &mut child)
}

/// Waits for the end of a command; counts its times, prints a duration from 5 s on, reports its failure.
fn ended(shown: &str, start: Instant, child: &mut Child) -> Outcome {
    let processor = timing::processor_time(child);
    let status = child.wait().map_err(|error| format!("`{shown}`: {error}"))?;
    timing::add_command(shown, processor, start.elapsed());
    let seconds = start.elapsed().as_secs();
    if seconds >= 5 {
        eprintln!("  {} min {:02} s: {shown}", seconds / 60, seconds % 60);
    }
    if status.success() { Ok(()) } else { Err(format!("`{shown}` ended with {status}")) }
}

/// A program that runs at the same time and ends with this one.
pub(crate) struct Beside {
    child: Child,
    shown: String,
    start: Instant,
}

impl Beside {
    /// Starts it.
    pub(crate) fn start(command: &mut Command) -> Result<Self, String> {
        let shown = show(command);
        eprintln!("+ {shown} &");
        let child = command.spawn().map_err(|error| format!("cannot start `{shown}`: {error}"))?;
        Ok(Self { child, shown, start: Instant::now() })
    }

    /// Waits for its end and expects success.
    pub(crate) fn finish(mut self) -> Outcome {
        ended(&self.shown, self.start, &mut self.child)
    }
}

impl Drop for Beside {
    fn drop(&mut self) {
        // Nothing is left to end of one that was waited for.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Runs to the end, expects success, gives what it printed.
pub(crate) fn output(command: &mut Command) -> Result<String, String> {
    let shown = show(command);
    let output = command.output().map_err(|error| format!("cannot start `{shown}`: {error}"))?;
    if !output.status.success() {
        let message = String::from_utf8_lossy(&output.stderr);
        return Err(format!("`{shown}` ended with {}: {message}", output.status));
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// Whether a program answers to `--version`.
pub(crate) fn available(program: &str) -> bool {
    Command::new(program).arg("--version").output().is_ok_and(|output| output.status.success())
}

/// In CI everything must be there; elsewhere a missing tool is named and its tests are left out.
pub(crate) fn need(program: &str, what_for: &str) -> Result<bool, String> {
    if available(program) { Ok(true) } else { lacks(program, what_for).map(|()| false) }
}

/// Skips a part because of a missing program, or fails in CI.
pub(crate) fn lacks(what: &str, what_for: &str) -> Outcome {
    if std::env::var_os("CI").is_some() {
        return Err(format!("`{what}` is missing, needed for {what_for}"));
    }
    eprintln!("skipped: {what_for} (no `{what}` on this machine)");
    Ok(())
}

fn show(command: &Command) -> String {
    let mut text =
        Path::new(command.get_program()).file_name().unwrap_or_default().to_string_lossy().into_owned();
    for argument in command.get_args() {
        text.push(' ');
        text.push_str(&argument.to_string_lossy());
    }
    text
}

#[cfg(test)]
mod tests {
    //! A workspace is found from anywhere within, and only there.

    use super::*;

    #[test]
    fn the_workspace_is_the_one_around() {
        let own = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
        let scratch = std::env::temp_dir().join(format!("xtask-root-{}", std::process::id()));
        let copy = scratch.join("copy");
        std::fs::create_dir_all(copy.join("xtask/src")).unwrap();
        std::fs::create_dir_all(copy.join("deep/er")).unwrap();
        for name in ["Cargo.toml", "xtask/Cargo.toml"] {
            std::fs::copy(own.join(name), copy.join(name)).unwrap();
        }
        for folder in ["", "xtask", "xtask/src", "deep/er"] {
            assert_eq!(workspace_above(&copy.join(folder)), Some(copy.clone()), "{folder}");
        }
        assert_eq!(workspace_above(&own.join("xtask")), Some(own.to_path_buf()));
        assert_eq!(workspace_above(&scratch), None);
        std::fs::remove_dir_all(&scratch).unwrap();
    }
}
