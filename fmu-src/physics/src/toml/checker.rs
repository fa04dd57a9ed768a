//! Checks of single values: each reports a problem and hands the value on, so that one run finds every problem.

use core::fmt::Display;
use std::collections::BTreeSet;

use nalgebra::{Matrix3, Vector3};
use serde::de::DeserializeOwned;

use super::directions::UNIT_TOLERANCE;
use super::document::Document;
use super::error::{FileError, Problem};
use super::numbers::short;
use super::place::KeyPath;
use super::ranges::GREATEST;
use super::reader::MOST_KEPT;
use super::rules::{Demand, Rule};

use crate::math;

/// Gathers the problems of one document.
pub struct Checker<'d> {
    document: &'d Document<'d>,
    problems: Vec<Problem>,
    /// How many more were found than are kept.
    unlisted: usize,
    reported: BTreeSet<KeyPath>,
    stand_ins: BTreeSet<KeyPath>,
}

impl<'d> Checker<'d> {
    /// Reads a document into a type, and continues with what that found.
    ///
    /// # Errors
    /// See [`Document::read`].
    pub fn read<T: DeserializeOwned>(document: &'d Document<'d>) -> Result<(T, Self), FileError> {
        let (value, findings) = document.read()?;
        let stand_ins = findings.stand_ins.into_iter().collect();
        let mut checker = Self {
            document,
            problems: Vec::new(),
            unlisted: findings.unlisted,
            reported: BTreeSet::new(),
            stand_ins,
        };
        for (at, found, allowed) in findings.problems {
            checker.push(&at, found, allowed);
        }
        Ok((value, checker))
    }

    /// The value if nothing was reported, all problems in the order of their lines otherwise.
    pub fn finish<T>(mut self, value: T) -> Result<T, FileError> {
        self.problems.sort_by_key(|problem| problem.line);
        if self.problems.is_empty() {
            return Ok(value);
        }
        let mut error = self.document.error(self.problems);
        error.unlisted += self.unlisted;
        Err(error)
    }

    /// Reports one problem, unless what is judged was not written.
    pub fn report(&mut self, at: &KeyPath, found: impl Display, allowed: impl Display) {
        self.report_across(at, at, found, allowed);
    }

    /// Reports at one place what several values of a table come to together, unless one of them was not written.
    pub fn report_across(
        &mut self,
        table: &KeyPath,
        at: &KeyPath,
        found: impl Display,
        allowed: impl Display,
    ) {
        if !has_inside(&self.stand_ins, table) && !self.is_stand_in(at) {
            self.push(at, found, allowed);
        }
    }

    /// Reports that a table lacks a key, unless it was misspelt or written wrongly.
    pub fn report_lack(&mut self, table: &KeyPath, key: &str, allowed: impl Display) {
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
    pub fn push(&mut self, at: &KeyPath, found: impl Display, allowed: impl Display) {
        self.reported.insert(at.clone());
        if self.problems.len() >= MOST_KEPT {
            self.unlisted += 1;
            return;
        }
        self.problems.push(Problem {
            line: Some(self.document.line(at)),
            key: at.to_string(),
            found: found.to_string(),
            allowed: allowed.to_string(),
        });
    }

    /// Whether something was reported at this place or inside of it.
    pub fn has_reported(&self, at: &KeyPath) -> bool {
        has_inside(&self.reported, at)
    }

    /// Whether nobody wrote this value or one inside of it.
    pub fn has_stand_in(&self, at: &KeyPath) -> bool {
        self.is_stand_in(at) || has_inside(&self.stand_ins, at)
    }

    /// A number, not NaN, infinite or beyond all measure.
    pub fn finite(&mut self, at: &KeyPath, value: f64) -> f64 {
        self.within(at, value, -GREATEST, GREATEST, "a finite number up to 1e12 in magnitude")
    }

    /// A number between two bounds, both included; NaN is outside.
    pub fn within(&mut self, at: &KeyPath, value: f64, low: f64, high: f64, allowed: &str) -> f64 {
        if !(low..=high).contains(&value) {
            self.report(at, short(value), allowed);
        }
        value
    }

    /// A direction perpendicular to another: refused when off by more than 1e-3 rad, squared up otherwise.
    pub fn perpendicular(
        &mut self,
        at: &KeyPath,
        unit: Vector3<f64>,
        to: &Vector3<f64>,
        to_key: &str,
    ) -> Vector3<f64> {
        let along = unit.dot(to);
        let square = unit - to * along;
        if along.abs() <= UNIT_TOLERANCE {
            return square / square.norm();
        }
        if !self.has_reported(at) {
            let written = self.document.vector(at).unwrap_or(unit.into());
            self.report_across(
                &at.split().0,
                at,
                format_args!("{written:?}, whose component along `{to_key}` is {along}"),
                format_args!("a direction perpendicular to `{to_key}` within 1e-3"),
            );
        }
        unit
    }

    /// A rotation given by angles or by a matrix, or neither (identity).
    ///
    /// Angles are turns of the part about the body's X, then Y, then Z axis: Rz Ry Rx takes components in the part's
    /// frame to components in the body frame.
    pub fn rotation(
        &mut self,
        matrix_at: &KeyPath,
        angles_rad: Option<[f64; 3]>,
        matrix: Option<[[f64; 3]; 3]>,
    ) -> Matrix3<f64> {
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
            (None, Some(rows)) => self.rotation_matrix(matrix_at, rows),
        }
    }

    fn rotation_matrix(&mut self, at: &KeyPath, rows: [[f64; 3]; 3]) -> Matrix3<f64> {
        let [x, y, z] = rows.map(Vector3::from);
        let square = [x.dot(&y), y.dot(&z), z.dot(&x)].iter().all(|dot| dot.abs() <= UNIT_TOLERANCE);
        let unit = [x, y, z].iter().all(|row| (row.norm() - 1.0).abs() <= UNIT_TOLERANCE);
        if !(square && unit && x.cross(&y).dot(&z) > 0.0) {
            self.report(
                at,
                format_args!("{rows:?}"),
                "a rotation matrix (orthonormal rows within 1e-3, determinant 1; it is then squared up)",
            );
            return Matrix3::identity();
        }
        let x = x.normalize();
        let y = (y - x * x.dot(&y)).normalize();
        Matrix3::from_rows(&[x.transpose(), y.transpose(), x.cross(&y).transpose()])
    }
}

impl Checker<'_> {
    /// Reports the rules that a table at `at` breaks.
    pub fn rules(&mut self, at: &KeyPath, rules: &[Rule]) {
        for rule in rules {
            let has = |key: &&str| self.is_written(&at.key(key));
            let is_meant = |key: &&str| has(key) || self.is_stand_in(&at.key(key));
            let place = rule.keys.first().filter(|key| has(key)).map(|key| at.key(key));
            match (rule.demand, place) {
                (Demand::RequiresIfPositive, Some(place)) if !self.document.is_positive(&place) => {}
                (Demand::Requires | Demand::RequiresIfPositive, Some(place))
                    if !rule.others.iter().any(is_meant) =>
                {
                    self.report(&place, rule.found, rule.allowed);
                }
                (Demand::Excludes, Some(place)) if rule.others.iter().any(has) => {
                    self.report(&place, rule.found, rule.allowed);
                }
                (Demand::Either, _)
                    if rule.keys.iter().filter(|key| has(key)).count()
                        + usize::from(rule.others.iter().any(has))
                        > 1 =>
                {
                    self.push(at, rule.found, rule.allowed);
                }
                (Demand::AnyOf, _) if !rule.keys.iter().any(is_meant) => {
                    self.push(at, rule.found, rule.allowed);
                }
                _ => {}
            }
        }
    }
}

/// Whether one of the places is this one or inside of it.
fn has_inside(places: &BTreeSet<KeyPath>, at: &KeyPath) -> bool {
    places.range(at..).next().is_some_and(|place| place.is_in(at))
}
