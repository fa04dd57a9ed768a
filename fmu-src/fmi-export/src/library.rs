//! The models of one shared library, and how an importer's GUID finds its model.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use crate::location;
use crate::model::{Manual, Model};
use crate::panics::contain;
use crate::prepared::{DescribeError, Prepared};
use crate::start_values::{OtherReader, Reader};

/// One model of a library, its type erased.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// The model's name.
    pub name: &'static str,
    /// The file under `resources/` that holds the setup.
    pub setup_file: Option<&'static str>,
    /// The files under `resources/` that may hold schedules.
    pub schedule_files: &'static [&'static str],
    /// The compiled-in setup text.
    pub default_setup: &'static str,
    /// The inputs of its reference flight.
    pub reference_inputs: &'static str,
    /// The beginning of its manual.
    pub manual: Manual,
    prepare: Prepare,
    start_names: StartNames,
}

/// Describes a model: name and text of its setup, and the other models that the setup may serve.
type Prepare = fn(&str, &str, &[OtherReader<'_>]) -> Result<Prepared, DescribeError>;
/// The names that start values may have, if a model takes the setup of this name and text.
type StartNames = fn(&str, &str) -> Option<BTreeSet<String>>;

impl Entry {
    /// The entry of a model that `prepare` describes for a version of FMI.
    pub(crate) const fn new<M: Model>(prepare: Prepare, start_names: StartNames) -> Self {
        Self {
            name: M::NAME,
            setup_file: M::SETUP_FILE,
            schedule_files: M::SCHEDULE_FILES,
            default_setup: M::DEFAULT_SETUP,
            reference_inputs: M::REFERENCE_INPUTS,
            manual: M::MANUAL,
            prepare,
            start_names,
        }
    }

    /// Describes the model for a setup text, the compiled-in one if `None`; `file` names it in errors. Start values for
    /// other models are errors: see [`Library::describe`].
    pub fn describe(
        &self,
        file: Option<&str>,
        setup_text: Option<&str>,
    ) -> Result<model_description::Description, DescribeError> {
        self.prepare(file, setup_text, &[]).map(|prepared| prepared.description)
    }

    pub(crate) fn prepare(
        &self,
        file: Option<&str>,
        setup_text: Option<&str>,
        library: &[Self],
    ) -> Result<Prepared, DescribeError> {
        let file = file.or(self.setup_file).unwrap_or("the built-in setup");
        let text = setup_text.unwrap_or(self.default_setup);
        let reader = |other: &Self| {
            other.setup_file?;
            let names = contain(|| (other.start_names)(file, text)).ok().flatten()?;
            Some(Reader { model: other.name, names })
        };
        let others = library.iter().filter(|other| other.name != self.name);
        let others: Vec<_> = others.map(|other| move || reader(other)).collect();
        let others: Vec<OtherReader<'_>> = others.iter().map(|read| read as OtherReader<'_>).collect();
        // One model that panics here must not hide the others of the library.
        contain(|| (self.prepare)(file, text, &others)).unwrap_or_else(|text| Err(DescribeError::Panic(text)))
    }

    /// The prepared model with the schedules in its resources, if there are any.
    fn with_schedules_at(
        &self,
        mut prepared: Prepared,
        resources: &Result<Option<PathBuf>, String>,
    ) -> Result<Prepared, String> {
        let Ok(Some(folder)) = resources else { return Ok(prepared) };
        for file in self.schedule_files {
            if let Some(text) = location::read_if_there(folder, file)? {
                prepared.set_schedule(file, file, &text).map_err(|error| error.to_string())?;
            }
        }
        Ok(prepared)
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

    /// Describes a model of this library, see [`Entry::describe`]; start values may be for any of its models that takes
    /// the same setup.
    pub fn describe(
        &self,
        entry: &Entry,
        file: Option<&str>,
        setup_text: Option<&str>,
    ) -> Result<model_description::Description, DescribeError> {
        Ok(entry.prepare(file, setup_text, self.entries)?.description)
    }

    /// The names, for messages.
    pub fn names(&self) -> String {
        self.entries.iter().map(|entry| entry.name).collect::<Vec<_>>().join(", ")
    }

    /// The model whose GUID is `guid` for the setup at `resource_location`; where that is empty, for the setup beside the
    /// library, or else for the compiled-in one. The error names what was compared.
    pub(crate) fn select(&self, guid: &str, resource_location: &[u8]) -> Result<Prepared, String> {
        let resources = location::resolve(resource_location);
        if !matches!(resources, Ok(None)) {
            let (entry, prepared) = self.matching(guid, &resources).map_err(|tried| refusal(guid, tried))?;
            return entry.with_schedules_at(prepared, &resources);
        }
        let missing = "the resource location (fmuResourceLocation) is NULL or empty";
        let beside = location::beside_library();
        if let Some(folder) = beside.as_ref().filter(|folder| folder.is_dir()) {
            let tried = match self.matching(guid, &Ok(Some(folder.clone()))) {
                Ok((entry, prepared)) => return entry.with_schedules_at(prepared, &Ok(beside)),
                Err(tried) => tried,
            };
            let compiled_in = self.matching(guid, &Ok(None));
            return compiled_in.map(|(_, prepared)| prepared).map_err(|_| {
                format!("{missing}; in `{}` beside the library: {}", folder.display(), refusal(guid, tried))
            });
        }
        self.matching(guid, &Ok(None)).map(|(_, prepared)| prepared).map_err(|tried| {
            let looked =
                beside.as_ref().map(|folder| format!(", and there is no folder `{}`", folder.display()));
            format!("{missing}{}; {}", looked.unwrap_or_default(), refusal(guid, tried))
        })
    }

    /// The model whose GUID is `guid` for the setup in a folder, or for the compiled-in one; else what was compared.
    fn matching(
        &self,
        guid: &str,
        resources: &Result<Option<PathBuf>, String>,
    ) -> Result<(&'static Entry, Prepared), Vec<Tried>> {
        let mut texts: BTreeMap<&str, Result<String, String>> = BTreeMap::new();
        let mut tried = Vec::new();
        for entry in self.entries {
            let text = match (entry.setup_file, resources) {
                (None, _) | (_, Ok(None)) => Ok(None),
                (Some(_), Err(problem)) => Err(problem.clone()),
                (Some(file), Ok(Some(folder))) => texts
                    .entry(file)
                    .or_insert_with(|| location::read(folder, file))
                    .as_ref()
                    .map(|text| Some(text.as_str()))
                    .map_err(Clone::clone),
            };
            let file = entry.setup_file.filter(|_| !matches!(resources, Ok(None)));
            let was_read = text.is_ok();
            let outcome = match text.map(|text| entry.prepare(None, text, self.entries)) {
                Ok(Ok(prepared)) if prepared.description.guid == guid => {
                    return Ok((entry, prepared));
                }
                Ok(Ok(prepared)) => Ok(prepared.description.guid),
                Ok(Err(error)) => Err(error.to_string()),
                Err(problem) => Err(problem),
            };
            tried.push(Tried { entry, file, was_read, outcome });
        }
        Err(tried)
    }
}

/// A model that does not have the requested GUID.
struct Tried {
    entry: &'static Entry,
    /// Its setup file, unless the compiled-in setup was taken.
    file: Option<&'static str>,
    /// Whether there was such a file.
    was_read: bool,
    /// The GUID it has, or why it has none.
    outcome: Result<String, String>,
}

impl Tried {
    /// Whether the requested GUID is the one it has with the setup that it was compiled with.
    fn is_changed(&self, guid: &str) -> bool {
        let original = || self.entry.prepare(None, None, &[]).is_ok_and(|it| it.description.guid == guid);
        self.file.is_some() && self.was_read && original()
    }

    /// Its outcome in words, the same for models that fail for the same reason.
    fn verdict(&self) -> String {
        match (&self.outcome, self.file) {
            (Ok(guid), Some(file)) => format!("has GUID {guid} with {file} as it is now"),
            (Ok(guid), None) => format!("has GUID {guid}"),
            (Err(reason), _) => format!("cannot be set up: {reason}"),
        }
    }
}

/// Why there is no instance: the likeliest cause first, then what was compared.
fn refusal(guid: &str, mut tried: Vec<Tried>) -> String {
    let with_file = || tried.iter().filter(|it| it.file.is_some());
    let lead = if let Some(index) = tried.iter().position(|it| it.is_changed(guid)) {
        tried = vec![tried.swap_remove(index)];
        let (file, name) = (tried[0].file.unwrap_or_default(), tried[0].entry.name);
        format!(
            "{file}: the file was changed after packing: pack the FMU again (the requested GUID {guid} is that of {name} \
             with its original {file})"
        )
    } else if with_file().next().is_some() && with_file().all(|it| !it.was_read) {
        let reasons: BTreeSet<String> = with_file().filter_map(|it| it.outcome.clone().err()).collect();
        tried.retain(|it| it.file.is_none());
        format!("{}; without its setup no model of this library has the GUID {guid}", joined(reasons, "; "))
    } else {
        let files: BTreeSet<String> =
            with_file().filter(|it| it.was_read).filter_map(|it| it.file).map(str::to_owned).collect();
        let changed = match joined(files, " or ") {
            files if files.is_empty() => files,
            files => format!("{files} was changed after packing (then pack the FMU again), or "),
        };
        format!(
            "no model of this library has the GUID {guid}: {changed}the modelDescription.xml and this binary do not \
             belong together"
        )
    };
    // Models share a file's name, not its kind: the one that finds least wrong in a file is the one it is for.
    let wrongs = |it: &Tried| it.outcome.as_ref().err().map_or(0, |reason| 1 + reason.lines().count());
    let least = |file| tried.iter().filter(|it| it.file == file).map(wrongs).min();
    let mut verdicts: Vec<(String, String)> = Vec::new();
    for it in tried.iter().filter(|it| it.file.is_none() || Some(wrongs(it)) == least(it.file)) {
        let verdict = it.verdict();
        match verdicts.iter_mut().find(|(_, other)| *other == verdict) {
            Some((names, _)) => *names = format!("{names}, {}", it.entry.name),
            None => verdicts.push((it.entry.name.to_owned(), verdict)),
        }
    }
    verdicts.iter().fold(lead, |text, (names, verdict)| format!("{text}; {names} {verdict}"))
}

fn joined(texts: BTreeSet<String>, separator: &str) -> String {
    texts.into_iter().collect::<Vec<_>>().join(separator)
}
