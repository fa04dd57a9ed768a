//! Reader of one part of a spacecraft file: its key path, the materials and the file's checker.

use core::cell::RefCell;
use core::fmt::Display;
use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::materials::{ChosenMaterial, Materials};
use crate::toml::{Checker, KeyPath, Named, Table};

/// Key paths of the parts by kind and name, and whether the file gives the name.
pub(super) type Names = RefCell<BTreeMap<(&'static str, String), (KeyPath, bool)>>;

/// Kinds of parts that are plates, which are named as one kind.
const PLATES: [&str; 5] = ["plate", "box", "cylinder", "disc", "dish"];

/// A table of the file, or an item of one of its lists.
pub(super) struct PartReader<'p, 'd> {
    /// Reports an invalid value of the part.
    pub check: &'p mut Checker<'d>,
    /// Materials of the file.
    pub materials: &'p Materials,
    /// Names of all parts so far.
    pub names: &'p Names,
    /// Key path of the part.
    pub at: KeyPath,
    /// Its number in its list, from 0.
    pub index: usize,
}

impl<'d> PartReader<'_, 'd> {
    /// A table in it.
    pub(super) fn table(&mut self, key: &str) -> PartReader<'_, 'd> {
        let Self { check, materials, names, at, .. } = self;
        PartReader { check, materials, names, at: at.key(key), index: 0 }
    }

    /// Reads a table in it, which may be left out.
    pub(super) fn optional<D: Table, S>(
        &mut self,
        key: &str,
        description: Option<&D>,
        read: impl FnOnce(&mut PartReader<'_, 'd>, &D) -> S,
    ) -> Option<S> {
        let part = &mut self.table(key);
        description.map(|description| {
            part.check.rules(&part.at, D::RULES);
            read(part, description)
        })
    }

    /// Reads a list in it, which may be left out but not be empty.
    pub(super) fn list<D: Table + Named, S>(
        &mut self,
        key: &str,
        items: Option<&[D]>,
        mut read: impl FnMut(&mut PartReader<'_, 'd>, &D) -> S,
    ) -> Vec<S> {
        if items.is_some_and(<[D]>::is_empty) {
            self.report(key, "an empty list", "at least one item, or no such key");
        }
        let list = self.at.key(key);
        let mut part = self.table(key);
        let items = items.unwrap_or_default().iter().enumerate();
        let made = items.map(|(index, item)| {
            (part.at, part.index) = (list.item(index), index);
            part.check_name(item);
            part.check.rules(&part.at, D::RULES);
            read(&mut part, item)
        });
        made.collect()
    }

    /// Two parts of one kind with one name could not be distinguished.
    fn check_name<D: Named>(&mut self, item: &D) {
        let kind = if PLATES.contains(&D::KIND) { PLATES[0] } else { D::KIND };
        let (name, is_given) = (item.called(self.index), item.name().is_some());
        let mut names = self.names.borrow_mut();
        let known = names.entry((kind, name.clone()));
        let (other, other_is_given) = known.or_insert_with(|| (self.at.clone(), is_given));
        // A plate and one of the shade that nobody named are both called by their number.
        if *other != self.at && (is_given || *other_is_given) {
            let unnamed = if is_given { "" } else { " as what has no name is called" };
            let found = format!("`{name}`{unnamed}, the name of {other} too");
            self.check.report(&self.at.key("name"), found, "a name of its own");
        }
    }

    /// Reports a key of it.
    pub(super) fn report(&mut self, key: &str, found: impl Display, allowed: impl Display) {
        self.check.report(&self.at.key(key), found, allowed);
    }

    /// Reports a key of it by what another one says.
    pub(super) fn report_across(&mut self, key: &str, found: impl Display, allowed: impl Display) {
        self.check.report_across(&self.at, &self.at.key(key), found, allowed);
    }

    /// Whether something was reported at a key of it.
    pub(super) fn has_reported(&self, key: &str) -> bool {
        self.check.has_reported(&self.at.key(key))
    }

    /// Whether nobody wrote the value of a key of it.
    pub(super) fn is_stand_in(&self, key: &str) -> bool {
        self.check.is_stand_in(&self.at.key(key))
    }

    /// A direction perpendicular to that of another key.
    pub(super) fn perpendicular(
        &mut self,
        key: &str,
        unit: Vector3<f64>,
        (to_key, to): (&str, &Vector3<f64>),
    ) -> Vector3<f64> {
        self.check.perpendicular(&self.at.key(key), unit, to, to_key)
    }

    /// The material that a key names.
    pub(super) fn material(&mut self, key: &str, name: &str) -> ChosenMaterial {
        self.materials.find(self.check, &self.at.key(key), name)
    }

    /// Returns the material of the rear face; `None` for a one-sided surface.
    pub(super) fn rear(&mut self, name: Option<&str>) -> Option<ChosenMaterial> {
        name.map(|name| self.material("rear_optics", name))
    }
}
