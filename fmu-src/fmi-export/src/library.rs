//! The models of one shared library, and how an importer's GUID finds its model.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::Path;

use crate::describe::{DescribeError, Prepared, prepare};
use crate::location::{self, Resources};
use crate::model::{Model, Source};
use crate::panics::contain;

/// One model of a library, its type erased.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    name: &'static str,
    setup_file: Option<&'static str>,
    default_setup: &'static str,
    sources: &'static [Source],
    prepare: fn(&str, &str) -> Result<Prepared, DescribeError>,
}

impl Entry {
    /// The entry of a model.
    pub const fn of<M: Model>() -> Self {
        Self {
            name: M::NAME,
            setup_file: M::SETUP_FILE,
            default_setup: M::DEFAULT_SETUP,
            sources: M::SOURCES,
            prepare: prepare::<M>,
        }
    }

    /// The model's name.
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// The file under `resources/` that holds the setup.
    pub const fn setup_file(&self) -> Option<&'static str> {
        self.setup_file
    }

    /// The compiled-in setup text.
    pub const fn default_setup(&self) -> &'static str {
        self.default_setup
    }

    /// By what the model computes.
    pub const fn sources(&self) -> &'static [Source] {
        self.sources
    }

    /// Describes the model for a setup text, the compiled-in one if `None`; `file` names it in errors.
    pub fn describe(
        &self,
        file: Option<&str>,
        setup_text: Option<&str>,
    ) -> Result<model_description::Description, DescribeError> {
        self.prepare(file, setup_text).map(|prepared| prepared.description)
    }

    pub(crate) fn prepare(
        &self,
        file: Option<&str>,
        setup_text: Option<&str>,
    ) -> Result<Prepared, DescribeError> {
        let file = file.or(self.setup_file).unwrap_or("the built-in setup");
        // One model that panics here must not hide the others of the library.
        contain(|| (self.prepare)(file, setup_text.unwrap_or(self.default_setup)))
            .unwrap_or_else(|text| Err(DescribeError::Panic(text)))
    }
}

/// Every model of one shared library.
#[derive(Clone, Copy, Debug)]
pub struct Library {
    /// The models, in the order in which they are tried.
    pub entries: &'static [Entry],
}

impl Library {
    /// The entry of this name.
    pub fn find(&self, name: &str) -> Option<&'static Entry> {
        self.entries.iter().find(|entry| entry.name == name)
    }

    /// The names, for messages.
    pub fn names(&self) -> String {
        self.entries.iter().map(|entry| entry.name).collect::<Vec<_>>().join(", ")
    }

    /// The model whose GUID is `guid` for the setup at `resource_location`; the error tells what was
    /// looked at.
    pub(crate) fn select(&self, guid: &str, resource_location: &[u8]) -> Result<Prepared, String> {
        let resources = location::resolve(resource_location);
        let mut texts: BTreeMap<&str, Result<String, String>> = BTreeMap::new();
        let mut seen = String::new();
        for entry in self.entries {
            let text = match (entry.setup_file, &resources) {
                (None, _) | (_, Ok(Resources::None)) => Ok(None),
                (Some(_), Err(problem)) => Err(problem.clone()),
                (Some(file), Ok(Resources::Folder(folder))) => texts
                    .entry(file)
                    .or_insert_with(|| location::read_setup(folder, file))
                    .as_ref()
                    .map(|text| Some(text.as_str()))
                    .map_err(Clone::clone),
            };
            let was_read = text.is_ok();
            let verdict = match text {
                Ok(text) => match entry.prepare(None, text) {
                    Ok(prepared) if prepared.description.guid == guid => return Ok(prepared),
                    Ok(prepared) => match (entry.setup_file, text) {
                        // Wrong library or changed file: the GUID cannot tell, so both are named.
                        (Some(file), Some(_)) => {
                            format!("has GUID {} with {file} as it is now", prepared.description.guid)
                        }
                        _ => format!("has GUID {}", prepared.description.guid),
                    },
                    Err(error) => format!("cannot be set up: {error}"),
                },
                Err(problem) => format!("cannot be set up: {problem}"),
            };
            let _ = write!(seen, "; {} {verdict}", entry.name);
            if was_read && self.default_matches(entry, guid, &resources) {
                let file = entry.setup_file.unwrap_or_default();
                let _ = write!(
                    seen,
                    " (the GUID asked for is that of {} with its original {file}: the file was changed after packing; pack the FMU again)",
                    entry.name
                );
            }
        }
        let files: BTreeSet<&str> = match resources {
            Ok(Resources::Folder(_)) => self.entries.iter().filter_map(|entry| entry.setup_file).collect(),
            _ => BTreeSet::new(),
        };
        let changed = if files.is_empty() {
            String::new()
        } else {
            let files = files.into_iter().collect::<Vec<_>>().join(" or ");
            format!(", or {files} in its resources was changed after packing (then pack the FMU again)")
        };
        Err(format!(
            "no model of this library has the GUID {guid}: the modelDescription.xml and this binary do not belong together{changed}{seen}"
        ))
    }

    fn default_matches(&self, entry: &Entry, guid: &str, resources: &Result<Resources, String>) -> bool {
        let has_file = entry.setup_file.is_some() && !matches!(resources, Ok(Resources::None));
        has_file && entry.prepare(None, None).is_ok_and(|prepared| prepared.description.guid == guid)
    }
}

/// Joins for messages.
pub(crate) fn shown(path: &Path) -> String {
    path.display().to_string()
}
