//! A TOML text that remembers where every key stands, so that an error found after parsing still names its line.

use core::cell::RefCell;

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::{FileError, Problem};
use super::key_path::{KeyPath, Part};
use super::limits::{MOST_PROBLEMS, MOST_TEXT_BYTES};
use super::reader::{Findings, Reader, real, vector};

/// A parsed text with its file name.
pub struct Document<'t> {
    file: &'t str,
    // Offsets of line ends, counted once: a file may have a fault on every line.
    line_ends: Vec<usize>,
    root: Spanned<DeValue<'t>>,
    own_limits: &'static [(&'static str, usize)],
}

impl<'t> Document<'t> {
    /// Parses the text; an error is one of TOML's grammar, or a text longer than [`MOST_TEXT_BYTES`].
    pub fn parse(file: &'t str, text: &'t str) -> Result<Self, FileError> {
        if text.len() > MOST_TEXT_BYTES {
            let found = format!("a text of {} bytes", text.len());
            let allowed = format!("at most {MOST_TEXT_BYTES}");
            return Err(FileError::one(file, None, found, allowed));
        }
        match DeTable::parse(text) {
            Ok(root) => {
                let root = Spanned::new(root.span(), DeValue::Table(root.into_inner()));
                let line_ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at);
                Ok(Self { file, line_ends: line_ends.collect(), root, own_limits: &[] })
            }
            Err(error) => {
                let line = error.span().map(|span| line_of(text, span.start));
                let written =
                    line.and_then(|line| text.lines().nth(line - 1)).map(excerpt).unwrap_or_default();
                let message = error.message().split_whitespace().collect::<Vec<_>>().join(" ");
                let found = format!("text that is not TOML ({message}){written}");
                Err(FileError::one(file, line, found, grammar(&message).to_owned()))
            }
        }
    }

    /// With limits of the length of lists that go before [`LIMITS`](super::LIMITS).
    #[must_use]
    pub fn limited(self, own_limits: &'static [(&'static str, usize)]) -> Self {
        Self { own_limits, ..self }
    }

    /// Reads the document into a type. Keys that are unknown, missing or of a wrong type are found all at once; the
    /// type then holds values that nobody wrote.
    pub(super) fn read<T: DeserializeOwned>(&self) -> Result<(T, Findings), FileError> {
        let findings = RefCell::default();
        match T::deserialize(Reader::new(self.root.get_ref(), &findings, self.own_limits)) {
            Ok(value) => Ok((value, findings.into_inner())),
            Err(error) => Err(FileError::one(self.file, None, error.to_string(), String::new())),
        }
    }

    /// An error in this file; it lists [`MOST_PROBLEMS`] and counts the rest.
    pub fn error(&self, mut problems: Vec<Problem>) -> FileError {
        let unlisted = problems.len().saturating_sub(MOST_PROBLEMS);
        problems.truncate(MOST_PROBLEMS);
        FileError { file: self.file.to_owned(), problems, unlisted }
    }

    /// The line, from 1, of a place, or of the innermost table around it that exists.
    pub fn line(&self, place: &KeyPath) -> usize {
        let (start, _) = self.find(place);
        self.line_ends.partition_point(|end| *end < start) + 1
    }

    /// Whether somebody wrote what is at a place.
    pub fn is_written(&self, place: &KeyPath) -> bool {
        self.find(place).1.is_some()
    }

    /// Whether a number above 0 is written at a place.
    pub(super) fn is_positive(&self, place: &KeyPath) -> bool {
        self.find(place).1.and_then(real).is_some_and(|number| number > 0.0)
    }

    /// Three numbers that are written at a place.
    pub(super) fn vector(&self, place: &KeyPath) -> Option<[f64; 3]> {
        self.find(place).1.and_then(vector)
    }

    /// Returns the offset at which the text of a place, or of the innermost existing table around it, begins, and the place's value.
    fn find(&self, place: &KeyPath) -> (usize, Option<&DeValue<'t>>) {
        let mut start = self.root.span().start;
        let mut table = self.root.get_ref().as_table();
        let mut value = Some(self.root.get_ref());
        for part in &place.0 {
            let next = match part {
                Part::Key(key) => table
                    .and_then(|table| table.get_key_value(key.as_str()))
                    .map(|(found, value)| (found.span().start, value)),
                Part::Item(index) => value
                    .and_then(DeValue::as_array)
                    .and_then(|list| list.get(*index))
                    .map(|value| (value.span().start, value)),
            };
            let Some((next_start, next_value)) = next else { return (start, None) };
            start = next_start;
            value = Some(next_value.get_ref());
            table = next_value.get_ref().as_table();
        }
        (start, value)
    }
}

/// A line, as far as it is short.
fn excerpt(line: &str) -> String {
    const LONGEST: usize = 60;
    let line = line.trim();
    let shown: String = line.chars().take(LONGEST).collect();
    match shown.as_str() {
        "" => String::new(),
        _ if shown.len() < line.len() => format!(": `{shown}...`"),
        _ => format!(": `{shown}`"),
    }
}

/// Returns the text that TOML allows where its parser gives this message.
fn grammar(message: &str) -> &'static str {
    const WORDS: [(&str, &str); 4] = [
        ("duplicate key", "each key once in its table"),
        ("string values must be quoted", "a number without a unit, true, false, or a string in \"quotes\""),
        ("invalid basic string", "a string that ends with its quote in the same line"),
        (
            "unexpected key or value",
            "one value behind `=`, and nothing else but a comment: numbers with a decimal point, lists in [brackets]",
        ),
    ];
    WORDS.iter().find(|(words, _)| message.contains(words)).map_or("TOML 1.0", |(_, allowed)| allowed)
}

fn line_of(text: &str, offset: usize) -> usize {
    text.bytes().take(offset).filter(|byte| *byte == b'\n').count() + 1
}

#[cfg(test)]
mod tests {
    //! Keys have lines.

    use super::*;

    const TEXT: &str =
        "name = \"A\"\n[mass]\nm_kg = 1.0\n[[plates]]\narea = 2\n\n[[plates]]\narea = -1\nat = [1,\n 2]\n";

    #[test]
    fn a_key_has_the_line_it_stands_in() {
        let document = Document::parse("a.toml", TEXT).unwrap();
        let plates = KeyPath::root().key("plates");
        assert_eq!(document.line(&KeyPath::root().key("mass").key("m_kg")), 3);
        assert_eq!(document.line(&plates.item(1).key("area")), 8);
        assert_eq!(document.line(&plates.item(1).key("at").item(1)), 10);
        assert_eq!(document.line(&plates.item(1).key("missing")), 7);
    }
}
