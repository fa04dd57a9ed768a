//! Messages to the master: categories, text that survives `printf`, formatted only where its category is on.

use core::cell::{Cell, RefCell};
use core::fmt::{self, Write};
use std::ffi::{CStr, CString};

use model_description::{LogCategory, Status};

use crate::model::Log;

/// A log category (2.2.4). Messages carry one of the first five; `logAll` stands for all of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Category {
    /// An event in the model: a dump, an edge of an eclipse, a pulse.
    Events,
    /// Something unusual that does not stop the instance; always logged.
    Warning,
    /// A value or a step was not accepted; always logged.
    Discard,
    /// A call failed; always logged.
    Error,
    /// The library cannot go on; always logged.
    Fatal,
    /// All of these.
    All,
}

impl Category {
    /// Every category, in the order of the XML.
    pub const ALL: [Self; 6] =
        [Self::Events, Self::Warning, Self::Discard, Self::Error, Self::Fatal, Self::All];

    /// Name in the XML and at the C interface, and description.
    const fn row(self) -> (&'static CStr, &'static str) {
        match self {
            Self::Events => (
                c"logEvents",
                "events inside the model, with their times, and what an importer does beyond the standard",
            ),
            Self::Warning => {
                (c"logStatusWarning", "something odd that the simulation goes on with; logged always")
            }
            Self::Discard => (c"logStatusDiscard", "values or steps that were not accepted; logged always"),
            Self::Error => (c"logStatusError", "calls that failed; logged always"),
            Self::Fatal => (c"logStatusFatal", "failures that no instance survives; logged always"),
            Self::All => (c"logAll", "all messages"),
        }
    }

    /// The category of a name.
    pub fn from_name(name: &CStr) -> Option<Self> {
        Self::ALL.into_iter().find(|category| category.row().0 == name)
    }

    /// The `LogCategories` of the XML.
    pub fn declared() -> Vec<LogCategory> {
        Self::ALL
            .into_iter()
            .map(Self::row)
            .map(|(name, description)| LogCategory {
                name: name.to_string_lossy().into_owned(),
                description: Some(description.to_owned()),
            })
            .collect()
    }

    /// The names, for messages.
    pub(crate) fn names() -> String {
        Self::ALL.map(|category| category.row().0.to_string_lossy().into_owned()).join(", ")
    }

    const fn bit(self) -> u8 {
        match self {
            Self::All => u8::MAX,
            single => 1 << single as u8,
        }
    }

    const fn of_status(status: Status) -> Self {
        match status {
            Status::Ok | Status::Pending => Self::Events,
            Status::Warning => Self::Warning,
            Status::Discard => Self::Discard,
            Status::Error => Self::Error,
            Status::Fatal => Self::Fatal,
        }
    }
}

/// Receiver of messages: the master's logger, or a test's list.
pub trait LogSink: Send {
    /// Takes one message; every text is ready for a `printf`-like receiver without arguments.
    fn write(&self, instance_name: &CStr, status: Status, category: &CStr, message: &CStr);
}

/// The log of one instance.
pub struct Logger {
    sink: Box<dyn LogSink>,
    instance_name: CString,
    enabled: Cell<u8>,
    initially: u8,
    buffer: RefCell<String>,
}

impl Logger {
    /// A logger for `instance_name`; with `logging_on` false events are not reported.
    pub fn new(sink: Box<dyn LogSink>, instance_name: &CStr, logging_on: bool) -> Self {
        let initially = if logging_on { Category::All.bit() } else { 0 };
        Self {
            sink,
            instance_name: instance_name.to_owned(),
            enabled: Cell::new(initially),
            initially,
            buffer: RefCell::default(),
        }
    }

    /// Enables exactly these categories; none named means all of them, `on` false switches all off.
    pub fn enable(&self, on: bool, categories: impl IntoIterator<Item = Category>) {
        let mut named = categories.into_iter().peekable();
        self.enabled.set(match (on, named.peek()) {
            (false, _) => 0,
            (true, None) => Category::All.bit(),
            (true, Some(_)) => named.fold(0, |bits, category| bits | category.bit()),
        });
    }

    /// Back to the setting with which the instance was made.
    pub(crate) fn reset(&self) {
        self.enabled.set(self.initially);
    }

    /// Whether a message with this status is sent. Only events wait to be requested: importers show the reason of a value that
    /// was not accepted nowhere else, and turn debug logging off by default.
    #[inline]
    pub fn is_enabled(&self, status: Status) -> bool {
        let category = Category::of_status(status);
        category != Category::Events || self.enabled.get() & category.bit() != 0
    }

    /// Sends a message in the category of `status`; formats nothing if that is off.
    pub fn log(&self, status: Status, message: fmt::Arguments<'_>) {
        if !self.is_enabled(status) {
            return;
        }
        // A sink that logs again finds the buffer taken and gets its own.
        match self.buffer.try_borrow_mut() {
            Ok(mut buffer) => self.send(status, message, &mut buffer),
            Err(_) => self.send(status, message, &mut String::new()),
        }
    }

    fn send(&self, status: Status, message: fmt::Arguments<'_>, buffer: &mut String) {
        buffer.clear();
        // Only a `Display` that fails by itself could fail here; what came before it is worth sending.
        let _ = Escaped(buffer).write_fmt(message);
        buffer.push('\0');
        if let Ok(text) = CStr::from_bytes_with_nul(buffer.as_bytes()) {
            self.sink.write(&self.instance_name, status, Category::of_status(status).row().0, text);
        }
    }
}

/// Makes text safe for a receiver that expands `printf` formats and FMI's `#r123#` references.
struct Escaped<'a>(&'a mut String);

impl Write for Escaped<'_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for c in text.chars() {
            match c {
                '%' => self.0.push_str("%%"),
                '#' => self.0.push_str("##"),
                '\0' => self.0.push('\u{FFFD}'),
                other => self.0.push(other),
            }
        }
        Ok(())
    }
}

impl Log for Logger {
    fn events_enabled(&self) -> bool {
        self.is_enabled(Status::Ok)
    }

    fn event(&self, time_s: f64, message: &str) {
        self.log(Status::Ok, format_args!("t = {time_s} s: {message}"));
    }

    fn warning(&self, message: &str) {
        self.log(Status::Warning, format_args!("{message}"));
    }
}

#[cfg(test)]
mod tests;
