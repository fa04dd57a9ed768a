//! Key path of a value in a TOML file: the keys and list items that lead to it.

use core::fmt;

/// A key with the tables and lists around it.
///
/// Key paths inside of another one follow it in their order, before all others.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct KeyPath(pub(super) Vec<Part>);

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Part {
    Key(String),
    Item(usize),
}

impl KeyPath {
    /// The whole file.
    pub fn root() -> Self {
        Self::default()
    }

    /// A key in the table at this place.
    pub fn key(&self, key: &str) -> Self {
        self.with(Part::Key(key.to_owned()))
    }

    /// An item, from 0, in the list at this place.
    pub fn item(&self, index: usize) -> Self {
        self.with(Part::Item(index))
    }

    /// The table around this place, and its key there.
    pub fn split(&self) -> (Self, String) {
        match self.0.split_last() {
            Some((last, rest)) => (Self(rest.to_vec()), Self(vec![last.clone()]).to_string()),
            None => (Self::root(), String::new()),
        }
    }

    /// The innermost table around this place.
    pub(super) fn table(&self) -> Self {
        let depth = self.0.iter().rposition(|part| matches!(part, Part::Key(_)));
        Self(self.0[..depth.unwrap_or(0)].to_vec())
    }

    /// The innermost key, unless this place is the whole file or an item of a list.
    pub(super) fn last_key(&self) -> Option<&str> {
        match self.0.last() {
            Some(Part::Key(key)) => Some(key),
            _ => None,
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

    fn with(&self, part: Part) -> Self {
        let mut parts = self.0.clone();
        parts.push(part);
        Self(parts)
    }
}

impl fmt::Display for KeyPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, part) in self.0.iter().enumerate() {
            match part {
                Part::Key(key) => {
                    f.write_str(if i > 0 { "." } else { "" })?;
                    let is_bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
                    if key.chars().all(is_bare) { write!(f, "{key}")? } else { write!(f, "{key:?}")? }
                }
                Part::Item(index) => write!(f, "[{}]", index + 1)?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    //! Places contain each other.
    use super::*;

    #[test]
    fn places_contain_each_other_by_whole_keys() {
        let plates = KeyPath::root().key("plates");
        let area = plates.item(1).key("area");
        assert!(area.is_in(&plates) && area.is_in(&area) && area.is_in(&KeyPath::root()));
        assert!(!plates.is_in(&area) && !KeyPath::root().key("plates2").is_in(&plates));
        assert_eq!(area.split(), (plates.item(1), "area".to_owned()));
        assert_eq!([area.table(), area.item(2).table()], [plates.item(1), plates.item(1)]);
    }
}
