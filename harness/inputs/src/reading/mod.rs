//! Reading of the TOML files that people write: one table of keys a format, each key with a type that reads, judges and describes it.

mod at;
mod paths;
pub(crate) mod quantities;
pub(crate) mod tables;
mod written;

use std::{
    ops::{Deref, DerefMut},
    path::{Path, PathBuf},
};

use files::outcome::Refusal;
use physics::toml::{Checker, Document, FileError, Place};
use serde::de::DeserializeOwned;

use crate::kind::FileKind;
pub use at::At;
pub(crate) use at::Named;
pub(crate) use paths::{InputFile, OutputPath, ShippedFile};
pub(crate) use tables::{Checked, tables, words};
pub(crate) use written::Written;

/// Values of a file with its path and its text.
#[derive(Clone, Debug)]
pub struct InFile<T> {
    /// The file as messages name it.
    pub file: PathBuf,
    /// The file that was read.
    pub path: PathBuf,
    /// Its text.
    pub text: String,
    values: T,
}

impl<T> Deref for InFile<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.values
    }
}

impl<T> DerefMut for InFile<T> {
    fn deref_mut(&mut self) -> &mut T {
        &mut self.values
    }
}

impl<T> InFile<T> {
    /// A problem at a place of the file.
    pub fn problem<U>(&self, at: &At<U>, what: &str) -> String {
        at.problem(&self.file, what)
    }
}

/// Reads a file of a kind. `judge` reports what keys of several tables come to together.
///
/// # Errors
/// A file that cannot be read; everything wrong in it with line, key, what was found and what is allowed.
pub(crate) fn read<D: DeserializeOwned + Checked + physics::toml::Written>(
    kind: FileKind,
    file: &Path,
    judge: impl FnOnce(&D, &D::Value, &Place<'_>),
) -> Result<InFile<D::Value>, Refusal> {
    parse([file; 2], kind.read(file)?, judge)
}

/// The same of its text; messages name the file by its first path, its own paths are relative to the second.
pub(crate) fn parse<D: DeserializeOwned + Checked + physics::toml::Written>(
    [file, path]: [&Path; 2],
    text: String,
    judge: impl FnOnce(&D, &D::Value, &Place<'_>),
) -> Result<InFile<D::Value>, Refusal> {
    let shown = file.display().to_string();
    let document = Document::parse(&shown, &text).map_err(refusal)?;
    let (mut description, checker) = Checker::read::<D>(&document).map_err(refusal)?;
    let root = Place::root(&checker);
    description.check(&root, path.parent().unwrap_or(Path::new("")));
    let values = description.value();
    judge(&description, &values, &root);
    let values = checker.finish(values).map_err(refusal)?;
    Ok(InFile { file: file.to_owned(), path: path.to_owned(), text, values })
}

/// Problems of a file that a reader of the physics crate found.
pub fn refusal(error: FileError) -> Refusal {
    Refusal { text: error.to_string(), count: error.problems.len() + error.unlisted }
}
