//! Checker of one file, which gathers problems so that one run finds every one, and the places at which they are reported.

use core::cell::{Cell, RefCell};
use core::fmt::{self, Display};
use std::collections::BTreeSet;

use nalgebra::{Matrix3, Vector3};
use serde::de::DeserializeOwned;

use super::directions::UNIT_TOLERANCE;
use super::document::Document;
use super::error::{FileError, Problem};
use super::key_path::KeyPath;
use super::numbers::short;
use super::ranges::GREATEST;
use super::reader::MOST_KEPT;
use super::rules::{Demand, Rule};
use crate::math;

/// Gathers the problems of one document.
pub struct Checker<'d> {
    document: &'d Document<'d>,
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

    /// Reports one problem whatever else was found.
    fn push(&self, at: &KeyPath, found: impl Display, allowed: impl Display) {
        self.reported.borrow_mut().insert(at.clone());
        let mut problems = self.problems.borrow_mut();
        if problems.len() >= MOST_KEPT {
            self.unlisted.set(self.unlisted.get() + 1);
            return;
        }
        let (line, key) = (Some(self.document.line(at)), at.to_string());
        problems.push(Problem { line, key, found: found.to_string(), allowed: allowed.to_string() });
    }
}

/// Key path with the checker that gathers the problems of its file.
#[derive(Clone)]
pub struct Place<'c> {
    check: &'c Checker<'c>,
    path: KeyPath,
}

impl<'c> Place<'c> {
    /// The whole file that a checker reads.
    pub fn root(check: &'c Checker<'c>) -> Self {
        Self { check, path: KeyPath::root() }
    }

    /// A key of the file, whatever table this place is in.
    pub fn of_file(&self, key: &str) -> Self {
        Self { path: KeyPath::root().key(key), ..*self }
    }

    /// A key in the table at this place.
    pub fn key(&self, key: &str) -> Self {
        Self { path: self.path.key(key), ..*self }
    }

    /// An item, from 0, in the list at this place.
    pub fn item(&self, index: usize) -> Self {
        Self { path: self.path.item(index), ..*self }
    }

    /// The items of the list at this place, each with its own.
    pub fn items<'i, T>(&self, list: &'i [T]) -> impl Iterator<Item = (Self, &'i T)> {
        list.iter().enumerate().map(|(index, item)| (self.item(index), item))
    }

    /// Keys and items that lead here.
    pub fn path(&self) -> &KeyPath {
        &self.path
    }

    /// Its line, from 1.
    pub fn line(&self) -> usize {
        self.check.document.line(&self.path)
    }

    /// Whether somebody wrote what is here.
    pub fn is_written(&self) -> bool {
        self.check.document.is_written(&self.path)
    }

    /// Whether nobody wrote what is here.
    pub fn is_stand_in(&self) -> bool {
        let stand_ins = &self.check.stand_ins;
        !stand_ins.is_empty() && self.path.around().any(|place| stand_ins.contains(&place))
    }

    /// Whether nobody wrote this value or one inside of it.
    pub fn has_stand_in(&self) -> bool {
        self.is_stand_in() || has_inside(&self.check.stand_ins, &self.path)
    }

    /// Whether something was reported here or inside.
    pub fn has_reported(&self) -> bool {
        has_inside(&self.check.reported.borrow(), &self.path)
    }

    /// Reports one problem, unless what is judged was not written.
    pub fn report(&self, found: impl Display, allowed: impl Display) {
        if !self.has_stand_in() {
            self.push(found, allowed);
        }
    }

    /// Reports what several values of the table around come to together, unless one of them was not written.
    pub fn report_across(&self, found: impl Display, allowed: impl Display) {
        if !has_inside(&self.check.stand_ins, &self.path.table()) && !self.is_stand_in() {
            self.push(found, allowed);
        }
    }

    /// Reports that the table here lacks a key, unless it was misspelt or written wrongly.
    pub fn report_lack(&self, key: &str, allowed: impl Display) {
        if !self.key(key).is_stand_in() {
            self.push(format_args!("no key `{key}`"), allowed);
        }
    }

    /// Reports one problem whatever else was found.
    pub fn push(&self, found: impl Display, allowed: impl Display) {
        self.check.push(&self.path, found, allowed);
    }

    /// Hands a value on; reports where there is none.
    pub fn known<T>(&self, value: Option<T>, found: impl Display, allowed: impl Display) -> Option<T> {
        if value.is_none() {
            self.report(found, allowed);
        }
        value
    }

    /// A number, not NaN, infinite or beyond all measure.
    pub fn finite(&self, value: f64) -> f64 {
        self.within(value, [-GREATEST, GREATEST], "a finite number up to 1e12 in magnitude")
    }

    /// A number between two bounds, both included; NaN is outside.
    pub fn within(&self, value: f64, [low, high]: [f64; 2], allowed: &str) -> f64 {
        if !(low..=high).contains(&value) {
            self.report(short(value), allowed);
        }
        value
    }

    /// A direction perpendicular to another: refused when off by more than 1e-3 rad, squared up otherwise.
    pub fn perpendicular(&self, unit: Vector3<f64>, to: &Vector3<f64>, to_key: &str) -> Vector3<f64> {
        let along = unit.dot(to);
        let square = unit - to * along;
        if along.abs() <= UNIT_TOLERANCE {
            return square / square.norm();
        }
        if !self.has_reported() {
            let written = self.check.document.vector(&self.path).unwrap_or(unit.into());
            let found = format_args!("{written:?}, whose component along `{to_key}` is {along}");
            self.report_across(found, format_args!("a direction perpendicular to `{to_key}` within 1e-3"));
        }
        unit
    }

    /// A rotation given by angles or by a matrix, which is here, or neither (identity).
    ///
    /// Angles are turns of the part about the body's X, then Y, then Z axis: Rz Ry Rx takes components in the part's
    /// frame to components in the body frame.
    pub fn rotation(&self, angles_rad: Option<[f64; 3]>, matrix: Option<[[f64; 3]; 3]>) -> Matrix3<f64> {
        match (angles_rad, matrix) {
            (None, None) => Matrix3::identity(),
            (Some(angles_rad), _) => {
                // The matrix enters an FMU's GUID: no digit may hang on the machine's own library of functions.
                let [(sx, cx), (sy, cy), (sz, cz)] = angles_rad.map(math::sin_cos);
                let about_x = Matrix3::new(1.0, 0.0, 0.0, 0.0, cx, -sx, 0.0, sx, cx);
                let about_y = Matrix3::new(cy, 0.0, sy, 0.0, 1.0, 0.0, -sy, 0.0, cy);
                let about_z = Matrix3::new(cz, -sz, 0.0, sz, cz, 0.0, 0.0, 0.0, 1.0);
                about_z * about_y * about_x
            }
            (None, Some(rows)) => self.rotation_matrix(rows),
        }
    }

    fn rotation_matrix(&self, rows: [[f64; 3]; 3]) -> Matrix3<f64> {
        let [x, y, z] = rows.map(Vector3::from);
        let square = [x.dot(&y), y.dot(&z), z.dot(&x)].iter().all(|dot| dot.abs() <= UNIT_TOLERANCE);
        let unit = [x, y, z].iter().all(|row| (row.norm() - 1.0).abs() <= UNIT_TOLERANCE);
        if !(square && unit && x.cross(&y).dot(&z) > 0.0) {
            let allowed =
                "a rotation matrix (orthonormal rows within 1e-3, determinant 1; it is then squared up)";
            self.report(format_args!("{rows:?}"), allowed);
            return Matrix3::identity();
        }
        let x = x.normalize();
        let y = (y - x * x.dot(&y)).normalize();
        Matrix3::from_rows(&[x.transpose(), y.transpose(), x.cross(&y).transpose()])
    }

    /// Reports the rules that the table here breaks.
    pub fn rules(&self, rules: &[Rule]) {
        let has = |key: &&str| self.key(key).is_written();
        let is_meant = |key: &&str| has(key) || self.key(key).is_stand_in();
        for &Rule { demand, keys, others, found, allowed } in rules {
            let needs = |key: &&&str| has(key) && !others.iter().any(is_meant);
            let first = keys.first();
            let at_fault = match demand {
                Demand::Requires => first.filter(needs),
                Demand::RequiresIfPositive => {
                    let is_positive = |key: &&&str| self.check.document.is_positive(&self.key(key).path);
                    first.filter(is_positive).filter(needs)
                }
                Demand::Excludes => first.filter(|key| has(key) && others.iter().any(has)),
                Demand::Either | Demand::AnyOf => None,
            };
            at_fault.into_iter().for_each(|key| self.key(key).report(found, allowed));
            let written = keys.iter().filter(|key| has(key)).count() + usize::from(others.iter().any(has));
            let is_broken = match demand {
                Demand::Either => written > 1,
                Demand::AnyOf => !keys.iter().any(is_meant),
                _ => false,
            };
            if is_broken {
                self.push(found, allowed);
            }
        }
    }
}

impl Display for Place<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.path.fmt(f)
    }
}

/// Whether one of the places is this one or inside of it.
fn has_inside(places: &BTreeSet<KeyPath>, at: &KeyPath) -> bool {
    places.range(at..).next().is_some_and(|place| place.is_in(at))
}
