//! Checker of one file: gathers problems, so that one run finds every one.

use core::cell::{Cell, RefCell};
use core::fmt::Display;
use std::collections::BTreeSet;

use serde::de::DeserializeOwned;

use super::document::Document;
use super::error::{FileError, Problem};
use super::key_path::KeyPath;
use super::reader::MOST_KEPT;

/// Gathers the problems of one document.
pub struct Checker<'d> {
    pub(super) document: &'d Document<'d>,
    problems: RefCell<Vec<Problem>>,
    /// How many more were found than are kept.
    unlisted: Cell<usize>,
    reported: RefCell<BTreeSet<KeyPath>>,
    stand_ins: BTreeSet<KeyPath>,
}

impl<'d> Checker<'d> {
    /// Reads a document into a type, and continues with what that found.
    ///
    /// # Errors
    /// See [`Document::read`].
    pub fn read<T: DeserializeOwned>(document: &'d Document<'d>) -> Result<(T, Self), FileError> {
        let (value, findings) = document.read()?;
        let checker = Self {
            document,
            problems: RefCell::default(),
            unlisted: Cell::new(findings.unlisted),
            reported: RefCell::default(),
            stand_ins: findings.stand_ins.into_iter().collect(),
        };
        for (at, found, allowed) in findings.problems {
            checker.push(&at, found, allowed);
        }
        Ok((value, checker))
    }

    /// The value if nothing was reported, all problems in the order of their lines otherwise.
    pub fn finish<T>(self, value: T) -> Result<T, FileError> {
        let mut problems = self.problems.into_inner();
        if problems.is_empty() {
            return Ok(value);
        }
        problems.sort_by_key(|problem| problem.line);
        let mut error = self.document.error(problems);
        error.unlisted += self.unlisted.get();
        Err(error)
    }

    /// Reports one problem, unless what is judged was not written.
    pub fn report(&self, at: &KeyPath, found: impl Display, allowed: impl Display) {
        self.report_across(at, at, found, allowed);
    }

    /// Reports at one place what several values of a table come to together, unless one of them was not written.
    pub fn report_across(&self, table: &KeyPath, at: &KeyPath, found: impl Display, allowed: impl Display) {
        if !self.has_stand_in_inside(table) && !self.is_stand_in(at) {
            self.push(at, found, allowed);
        }
    }

    /// Reports that a table lacks a key, unless it was misspelt or written wrongly.
    pub fn report_lack(&self, table: &KeyPath, key: &str, allowed: impl Display) {
        if !self.is_stand_in(&table.key(key)) {
            self.push(table, format_args!("no key `{key}`"), allowed);
        }
    }

    /// The line, from 1, of a place.
    pub fn line(&self, at: &KeyPath) -> usize {
        self.document.line(at)
    }

    /// Whether somebody wrote what is at this place.
    pub fn is_written(&self, at: &KeyPath) -> bool {
        self.document.is_written(at)
    }

    /// Whether nobody wrote what is at this place.
    pub fn is_stand_in(&self, at: &KeyPath) -> bool {
        !self.stand_ins.is_empty() && at.around().any(|place| self.stand_ins.contains(&place))
    }

    /// Reports one problem whatever else was found.
    pub fn push(&self, at: &KeyPath, found: impl Display, allowed: impl Display) {
        self.reported.borrow_mut().insert(at.clone());
        let mut problems = self.problems.borrow_mut();
        if problems.len() >= MOST_KEPT {
            self.unlisted.set(self.unlisted.get() + 1);
            return;
        }
        let (line, key) = (Some(self.document.line(at)), at.to_string());
        problems.push(Problem { line, key, found: found.to_string(), allowed: allowed.to_string() });
    }

    /// Whether something was reported at this place or inside of it.
    pub fn has_reported(&self, at: &KeyPath) -> bool {
        has_inside(&self.reported.borrow(), at)
    }

    /// Whether nobody wrote this value or one inside of it, the tables around it apart.
    pub(super) fn has_stand_in_inside(&self, at: &KeyPath) -> bool {
        has_inside(&self.stand_ins, at)
    }
}

/// Whether one of the places is this one or inside of it.
fn has_inside(places: &BTreeSet<KeyPath>, at: &KeyPath) -> bool {
    places.range(at..).next().is_some_and(|place| place.is_in(at))
}
