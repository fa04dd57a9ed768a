//! Reader of one part of a spacecraft file: its place, the materials and the names of all parts.

use core::cell::RefCell;
use core::ops::Deref;
use std::collections::BTreeMap;

use super::materials::{ChosenMaterial, Materials};
use crate::toml::{KeyPath, Named, Place, Table};

/// Key paths of the parts by kind and name, and whether the file gives the name.
pub(super) type Names = RefCell<BTreeMap<(&'static str, String), (KeyPath, bool)>>;

/// Kinds of parts that are plates, which are named as one kind.
const PLATES: [&str; 5] = ["plate", "box", "cylinder", "disc", "dish"];

/// A table of the file, or an item of one of its lists.
pub(super) struct PartReader<'p> {
    /// Place of the part.
    pub at: Place<'p>,
    /// Materials of the file.
    pub materials: &'p Materials,
    /// Names of all parts so far.
    pub names: &'p Names,
    /// Its number in its list, from 0.
    pub index: usize,
}

impl<'p> Deref for PartReader<'p> {
    type Target = Place<'p>;

    fn deref(&self) -> &Place<'p> {
        &self.at
    }
}

impl<'p> PartReader<'p> {
    /// A table in it.
    pub(super) fn table(&self, key: &str) -> Self {
        Self { at: self.key(key), index: 0, ..*self }
    }

    /// Reads a table in it, which may be left out.
    pub(super) fn optional<D: Table, S>(
        &self,
        key: &str,
        description: Option<&D>,
        read: impl FnOnce(&Self, &D) -> S,
    ) -> Option<S> {
        description.map(|description| {
            let part = self.table(key);
            part.rules(D::RULES);
            read(&part, description)
        })
    }

    /// Reads a list in it, which may be left out but not be empty.
    pub(super) fn list<D: Table + Named, S>(
        &self,
        key: &str,
        items: Option<&[D]>,
        mut read: impl FnMut(&Self, &D) -> S,
    ) -> Vec<S> {
        let list = self.key(key);
        if items.is_some_and(<[D]>::is_empty) {
            list.report("an empty list", "at least one item, or no such key");
        }
        let items = items.unwrap_or_default().iter().enumerate();
        let made = items.map(|(index, item)| {
            let part = Self { at: list.item(index), index, ..*self };
            part.check_name(item);
            part.rules(D::RULES);
            read(&part, item)
        });
        made.collect()
    }

    /// Two parts of one kind with one name could not be distinguished.
    fn check_name<D: Named>(&self, item: &D) {
        let kind = if PLATES.contains(&D::KIND) { PLATES[0] } else { D::KIND };
        let (name, is_given) = (item.called(self.index), item.name().is_some());
        let mut names = self.names.borrow_mut();
        let known = names.entry((kind, name.clone()));
        let (other, other_is_given) = known.or_insert_with(|| (self.path().clone(), is_given));
        // A plate and one of the shade that nobody named are both called by their number.
        if other != self.path() && (is_given || *other_is_given) {
            let unnamed = if is_given { "" } else { " as what has no name is called" };
            let found = format!("`{name}`{unnamed}, the name of {other} too");
            self.key("name").report(found, "a name of its own");
        }
    }

    /// The material that a key names.
    pub(super) fn material(&self, key: &str, name: &str) -> ChosenMaterial {
        self.materials.find(&self.key(key), name)
    }

    /// Returns the material of the rear face; `None` for a one-sided surface.
    pub(super) fn rear(&self, name: Option<&str>) -> Option<ChosenMaterial> {
        name.map(|name| self.material("rear_optics", name))
    }
}
