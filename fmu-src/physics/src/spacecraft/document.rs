//! A TOML text that remembers where every key stands, so that an error found after parsing still names its line.

use core::fmt;
use core::ops::Range;

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::{Problem, SpacecraftError};

/// A key with the tables and lists around it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Place(Vec<Segment>);

#[derive(Clone, Debug, PartialEq, Eq)]
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
                Segment::Key(key) if i > 0 => write!(f, ".{key}")?,
                Segment::Key(key) => write!(f, "{key}")?,
                Segment::Item(index) => write!(f, "[{}]", index + 1)?,
            }
        }
        Ok(())
    }
}

/// A parsed text with its file name.
pub(crate) struct Document<'t> {
    file: &'t str,
    text: &'t str,
    root: Spanned<DeTable<'t>>,
}

impl<'t> Document<'t> {
    /// Parses the text; an error is one of TOML's grammar.
    pub fn parse(file: &'t str, text: &'t str) -> Result<Self, SpacecraftError> {
        match DeTable::parse(text) {
            Ok(root) => Ok(Self { file, text, root }),
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

    /// Reads the document into a type; an error is an unknown, missing or ill-typed key.
    pub fn read<T: DeserializeOwned>(&self) -> Result<T, SpacecraftError> {
        toml::from_str(self.text).map_err(|error| {
            let place = error.span().map(|span| self.place_at(&span)).unwrap_or_default();
            let (found, allowed) = explain(error.message());
            self.error(vec![Problem {
                line: error.span().map(|span| line_of(self.text, span.start)),
                key: place.to_string(),
                found,
                allowed,
            }])
        })
    }

    /// An error in this file.
    pub fn error(&self, problems: Vec<Problem>) -> SpacecraftError {
        SpacecraftError { file: self.file.to_owned(), problems }
    }

    /// The line, from 1, of a place, or of the innermost table around it that exists.
    pub fn line(&self, place: &Place) -> usize {
        let mut start = self.root.span().start;
        let mut table = Some(self.root.get_ref());
        let mut value: Option<&DeValue<'_>> = None;
        for segment in &place.0 {
            let next = match segment {
                Segment::Key(key) => table
                    .and_then(|table| table.iter().find(|(found, _)| found.get_ref() == key))
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
        line_of(self.text, start)
    }

    /// The innermost key whose text holds the span.
    fn place_at(&self, span: &Range<usize>) -> Place {
        let mut place = Place::root();
        descend_table(self.root.get_ref(), span, &mut place);
        place
    }
}

fn descend_table(table: &DeTable<'_>, span: &Range<usize>, place: &mut Place) -> bool {
    for (key, value) in table.iter() {
        let mut inner = place.key(key.get_ref());
        if holds(&key.span(), span) || descend_value(value, span, &mut inner) {
            *place = inner;
            return true;
        }
    }
    false
}

fn descend_value(value: &Spanned<DeValue<'_>>, span: &Range<usize>, place: &mut Place) -> bool {
    let inside = match value.get_ref() {
        DeValue::Table(table) => descend_table(table, span, place),
        DeValue::Array(list) => list.iter().enumerate().any(|(i, item)| {
            let mut inner = place.item(i);
            let found = descend_value(item, span, &mut inner);
            if found {
                *place = inner;
            }
            found
        }),
        _ => false,
    };
    inside || holds(&value.span(), span)
}

fn holds(outer: &Range<usize>, inner: &Range<usize>) -> bool {
    outer.start <= inner.start && inner.end <= outer.end
}

fn line_of(text: &str, offset: usize) -> usize {
    text.bytes().take(offset).filter(|byte| *byte == b'\n').count() + 1
}

fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Turns serde's message into what was found and what is allowed, with a hint for a misspelt key.
fn explain(message: &str) -> (String, String) {
    let message = one_line(message);
    let mut quoted = message.split('`').skip(1).step_by(2);
    if message.starts_with("unknown field") || message.starts_with("unknown variant") {
        let what = if message.starts_with("unknown field") { "the unknown key" } else { "the unknown word" };
        let found = quoted.next().unwrap_or_default();
        let known: Vec<&str> = quoted.collect();
        let hint = nearest(found, &known).map(|key| format!(" (did you mean `{key}`?)")).unwrap_or_default();
        return (format!("{what} `{found}`{hint}"), known.join(", "));
    }
    if message.starts_with("missing field") {
        let key = quoted.next().unwrap_or_default();
        return (format!("no key `{key}`"), format!("a value for `{key}`, which has no default"));
    }
    match message.split_once(", expected ") {
        Some((found, expected)) => {
            let found = match found.strip_prefix("invalid length ") {
                Some(length) => format!("a list of length {length}"),
                None => found
                    .trim_start_matches("invalid type: ")
                    .trim_start_matches("invalid value: ")
                    .to_owned(),
            };
            let expected = match expected {
                "f64" => "a number".to_owned(),
                "i64" => "a whole number".to_owned(),
                other => other.replace("an array of length", "a list of length"),
            };
            (found, expected)
        }
        None => (message, String::new()),
    }
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
    //! Places found by name and places found by position are the same places.

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
    fn a_position_leads_back_to_its_key() {
        let document = Document::parse("a.toml", TEXT).unwrap();
        let offset = TEXT.find("-1").unwrap();
        assert_eq!(document.place_at(&(offset..offset + 2)).to_string(), "plates[2].area");
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
