//! Reader of one part of a spacecraft file: its key path, the materials and the file's checker.

use core::fmt::Display;

use nalgebra::Vector3;

use super::materials::{ChosenMaterial, Materials};
use crate::toml::{Checker, KeyPath, Table};

/// A table of the file, or an item of one of its lists.
pub(super) struct PartReader<'p, 'd> {
    /// Reports an invalid value of the part.
    pub check: &'p mut Checker<'d>,
    /// Materials of the file.
    pub materials: &'p Materials,
    /// Key path of the part.
    pub at: KeyPath,
    /// Its number in its list, from 0.
    pub index: usize,
}

impl<'d> PartReader<'_, 'd> {
    /// A table in it.
    pub(super) fn table(&mut self, key: &str) -> PartReader<'_, 'd> {
        PartReader { check: self.check, materials: self.materials, at: self.at.key(key), index: 0 }
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
    pub(super) fn list<D: Table, S>(
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
            part.check.rules(&part.at, D::RULES);
            read(&mut part, item)
        });
        made.collect()
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
