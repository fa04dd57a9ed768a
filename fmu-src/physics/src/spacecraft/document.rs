//! A TOML text that remembers where every key stands, so that an error found after parsing still names its line.

use core::cell::RefCell;
use core::fmt;

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::{Problem, SpacecraftError};
use super::reader::{Findings, Reader};

/// A key with the tables and lists around it.
///
/// Places inside of another one follow it in their order, before all others.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Place(Vec<Segment>);

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Segment {
    Key(String),
    Item(usize),
}

impl Place {
    /// The whole file.
    pub fn root() -> Self {
        Self::default()
    }

    /// A key in the table at this place.
    pub fn key(&self, key: &str) -> Self {
        self.with(Segment::Key(key.to_owned()))
    }

    /// An item, from 0, in the list at this place.
    pub fn item(&self, index: usize) -> Self {
        self.with(Segment::Item(index))
    }

    /// The table around this place, and its key there.
    pub fn split(&self) -> (Self, String) {
        match self.0.split_last() {
            Some((last, rest)) => (Self(rest.to_vec()), Self(vec![last.clone()]).to_string()),
            None => (Self::root(), String::new()),
        }
    }

    /// Whether this place is the other one or inside of it.
    pub fn is_in(&self, other: &Self) -> bool {
        self.0.starts_with(&other.0)
    }

    /// The places around this one, the whole file first, and this one.
    pub fn around(&self) -> impl Iterator<Item = Self> {
        (0..=self.0.len()).map(|depth| Self(self.0[..depth].to_vec()))
    }

    fn with(&self, segment: Segment) -> Self {
        let mut segments = self.0.clone();
        segments.push(segment);
        Self(segments)
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, segment) in self.0.iter().enumerate() {
            match segment {
                Segment::Key(key) => {
                    f.write_str(if i > 0 { "." } else { "" })?;
                    let is_bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
                    if key.chars().all(is_bare) { write!(f, "{key}")? } else { write!(f, "{key:?}")? }
                }
                Segment::Item(index) => write!(f, "[{}]", index + 1)?,
            }
        }
        Ok(())
    }
}

/// A parsed text with its file name.
pub(crate) struct Document<'t> {
    file: &'t str,
    // Offsets of line ends, counted once: a file may have a fault on every line.
    line_ends: Vec<usize>,
    root: Spanned<DeValue<'t>>,
}

impl<'t> Document<'t> {
    /// Parses the text; an error is one of TOML's grammar.
    pub fn parse(file: &'t str, text: &'t str) -> Result<Self, SpacecraftError> {
        match DeTable::parse(text) {
            Ok(root) => {
                let root = Spanned::new(root.span(), DeValue::Table(root.into_inner()));
                let line_ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at);
                Ok(Self { file, line_ends: line_ends.collect(), root })
            }
            Err(error) => Err(SpacecraftError {
                file: file.to_owned(),
                problems: vec![Problem {
                    line: error.span().map(|span| line_of(text, span.start)),
                    key: String::new(),
                    found: format!("text that is not TOML ({})", one_line(error.message())),
                    allowed: "TOML 1.0".to_owned(),
                }],
            }),
        }
    }

    /// Reads the document into a type. Keys that are unknown, missing or of a wrong type are found all at once; the
    /// type then holds values that nobody wrote.
    pub fn read<T: DeserializeOwned>(&self) -> Result<(T, Findings), SpacecraftError> {
        let findings = RefCell::default();
        match T::deserialize(Reader::new(self.root.get_ref(), &findings)) {
            Ok(value) => Ok((value, findings.into_inner())),
            Err(error) => {
                let (found, allowed) = (error.to_string(), String::new());
                Err(self.error(vec![Problem { line: None, key: String::new(), found, allowed }]))
            }
        }
    }

    /// An error in this file.
    pub fn error(&self, problems: Vec<Problem>) -> SpacecraftError {
        SpacecraftError { file: self.file.to_owned(), problems }
    }

    /// The line, from 1, of a place, or of the innermost table around it that exists.
    pub fn line(&self, place: &Place) -> usize {
        let mut start = self.root.span().start;
        let mut table = self.root.get_ref().as_table();
        let mut value: Option<&DeValue<'_>> = None;
        for segment in &place.0 {
            let next = match segment {
                Segment::Key(key) => table
                    .and_then(|table| table.get_key_value(key.as_str()))
                    .map(|(found, value)| (found.span().start, value)),
                Segment::Item(index) => value
                    .and_then(DeValue::as_array)
                    .and_then(|list| list.get(*index))
                    .map(|value| (value.span().start, value)),
            };
            let Some((next_start, next_value)) = next else { break };
            start = next_start;
            value = Some(next_value.get_ref());
            table = next_value.get_ref().as_table();
        }
        self.line_ends.partition_point(|end| *end < start) + 1
    }
}

fn line_of(text: &str, offset: usize) -> usize {
    text.bytes().take(offset).filter(|byte| *byte == b'\n').count() + 1
}

fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The candidate that takes the fewest edits, if it takes few.
pub(crate) fn nearest<'a>(word: &str, candidates: &[&'a str]) -> Option<&'a str> {
    candidates
        .iter()
        .map(|candidate| (edits(word, candidate), *candidate))
        .filter(|(distance, candidate)| *distance <= 2.max(candidate.len().min(word.len()) / 2))
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// Levenshtein's distance: insertions, deletions and substitutions between two words.
fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut diagonal = i;
        let mut left = i + 1;
        for (j, to) in b.iter().enumerate() {
            let up = row.get(j + 1).copied().unwrap_or(usize::MAX);
            let cost = (diagonal + usize::from(from != *to)).min(left + 1).min(up.saturating_add(1));
            diagonal = up;
            if let Some(cell) = row.get_mut(j) {
                *cell = left;
            }
            left = cost;
        }
        if let Some(cell) = row.last_mut() {
            *cell = left;
        }
    }
    row.last().copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    //! Keys have lines, places contain each other, words have neighbours.

    use super::*;

    const TEXT: &str =
        "name = \"A\"\n[mass]\nm_kg = 1.0\n[[plates]]\narea = 2\n\n[[plates]]\narea = -1\nat = [1,\n 2]\n";

    #[test]
    fn a_key_has_the_line_it_stands_in() {
        let document = Document::parse("a.toml", TEXT).unwrap();
        let plates = Place::root().key("plates");
        assert_eq!(document.line(&Place::root().key("mass").key("m_kg")), 3);
        assert_eq!(document.line(&plates.item(1).key("area")), 8);
        assert_eq!(document.line(&plates.item(1).key("at").item(1)), 10);
        assert_eq!(document.line(&plates.item(1).key("missing")), 7);
    }

    #[test]
    fn places_contain_each_other_by_whole_keys() {
        let plates = Place::root().key("plates");
        let area = plates.item(1).key("area");
        assert!(area.is_in(&plates) && area.is_in(&area) && area.is_in(&Place::root()));
        assert!(!plates.is_in(&area) && !Place::root().key("plates2").is_in(&plates));
        assert_eq!(area.split(), (plates.item(1), "area".to_owned()));
    }

    #[test]
    fn edit_distance_of_known_words() {
        assert_eq!(edits("kitten", "sitting"), 3);
        assert_eq!(edits("", "abc"), 3);
        assert_eq!(edits("abc", ""), 3);
        assert_eq!(edits("same", "same"), 0);
        assert_eq!(nearest("arae_m2", &["name", "area_m2", "normal"]), Some("area_m2"));
        assert_eq!(nearest("zzzzzzzz", &["name", "area_m2"]), None);
    }
}
