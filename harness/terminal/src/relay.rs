//! Output of a child process, which its parent shows.

use std::{
    fmt,
    io::{self, IsTerminal, Write},
    sync::OnceLock,
};

use comfy_table::Table;
use indicatif::{ProgressDrawTarget, TermLike};

/// Takes what this process shows, for a parent that shows it.
pub trait Relay: Send + Sync {
    /// Bytes of the standard output.
    ///
    /// # Errors
    /// What cannot be handed on.
    fn output(&self, bytes: &[u8]) -> io::Result<()>;

    /// A line beside the output.
    fn note(&self, text: &str);

    /// Text and control sequences of a progress bar.
    ///
    /// # Errors
    /// What cannot be handed on.
    fn bar(&self, text: &str) -> io::Result<()>;
}

/// Columns of the terminals that show output and notes; `None` where there is no terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub struct Screen {
    /// Width of the standard output.
    pub output_columns: Option<u16>,
    /// Width of stderr.
    pub note_columns: Option<u16>,
}

static PARENT: OnceLock<(Box<dyn Relay>, Screen)> = OnceLock::new();

/// From now on everything goes to this relay, which shows it on such a screen; the first one stays.
pub fn relay_to(relay: Box<dyn Relay>, screen: Screen) {
    let _ = PARENT.set((relay, screen));
}

/// Returns the screen on which this process's output and notes are shown.
pub fn screen() -> Screen {
    if let Some((_, screen)) = PARENT.get() {
        return *screen;
    }
    let mut stderr = Table::new();
    stderr.use_stderr();
    let note_columns = io::stderr().is_terminal().then(|| stderr.width()).flatten();
    Screen { output_columns: Table::new().width(), note_columns }
}

/// Whether a parent shows what this process shows.
pub fn is_relayed() -> bool {
    PARENT.get().is_some()
}

/// The relay, in a child.
pub(crate) fn relay() -> Option<&'static dyn Relay> {
    PARENT.get().map(|(relay, _)| relay.as_ref())
}

/// The standard output: in a child that of its parent.
#[derive(Clone, Copy, Debug, Default)]
pub struct Output;

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match relay() {
            Some(relay) => relay.output(bytes).map(|()| bytes.len()),
            None => io::stdout().lock().write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match relay() {
            Some(_) => Ok(()),
            None => io::stdout().lock().flush(),
        }
    }
}

/// Shows bytes that a child relayed as its progress bar, where stderr is a terminal.
pub fn show_bar(text: &str) {
    let mut stderr = io::stderr().lock();
    if stderr.is_terminal() {
        let _ = stderr.write_all(text.as_bytes()).and_then(|()| stderr.flush());
    }
}

/// Returns the target on which a child's progress bar is drawn.
pub(crate) fn bar_target(relay: &'static dyn Relay, columns: u16) -> ProgressDrawTarget {
    ProgressDrawTarget::term_like_with_hz(Box::new(RelayedTerminal { relay, columns }), 5)
}

/// A terminal at the other end of a relay.
struct RelayedTerminal {
    relay: &'static dyn Relay,
    columns: u16,
}

impl fmt::Debug for RelayedTerminal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("RelayedTerminal").field("columns", &self.columns).finish_non_exhaustive()
    }
}

impl RelayedTerminal {
    /// Moves the cursor by `places`; 0 would be taken for 1.
    fn move_cursor(&self, places: usize, letter: char) -> io::Result<()> {
        if places == 0 { Ok(()) } else { self.relay.bar(&format!("\u{1b}[{places}{letter}")) }
    }
}

impl TermLike for RelayedTerminal {
    fn width(&self) -> u16 {
        self.columns
    }

    fn move_cursor_up(&self, lines: usize) -> io::Result<()> {
        self.move_cursor(lines, 'A')
    }

    fn move_cursor_down(&self, lines: usize) -> io::Result<()> {
        self.move_cursor(lines, 'B')
    }

    fn move_cursor_right(&self, letters: usize) -> io::Result<()> {
        self.move_cursor(letters, 'C')
    }

    fn move_cursor_left(&self, letters: usize) -> io::Result<()> {
        self.move_cursor(letters, 'D')
    }

    fn write_line(&self, text: &str) -> io::Result<()> {
        self.relay.bar(&format!("{text}\n"))
    }

    fn write_str(&self, text: &str) -> io::Result<()> {
        self.relay.bar(text)
    }

    fn clear_line(&self) -> io::Result<()> {
        self.relay.bar("\r\u{1b}[2K")
    }

    fn flush(&self) -> io::Result<()> {
        Ok(())
    }
}
