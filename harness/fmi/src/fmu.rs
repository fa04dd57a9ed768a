//! An opened FMU: its folder, its description, its library.

use std::{
    collections::HashMap,
    path::{Path, PathBuf},
    sync::{Arc, Mutex, PoisonError},
};

use files::Scratch;
use model_description::{BaseType, CoSimulation, Description, MAX_BYTES, Parsed, ScalarVariable};

use crate::{
    Binary, Error,
    access::AccessTable,
    archive,
    select::{self, unknown},
};

/// An opened FMU. Cheap to clone; instances may be made and simulated on many threads.
#[derive(Clone)]
pub struct Fmu(Arc<Inner>);

struct Inner {
    source: PathBuf,
    folder: PathBuf,
    entries: Vec<String>,
    // Removed with the last clone and instance.
    _temporary: Option<Scratch>,
    parsed: Parsed,
    xml: Vec<u8>,
    positions: HashMap<String, usize>,
    binary: Mutex<Option<Arc<Binary>>>,
    access: AccessTable,
}

impl std::fmt::Debug for Fmu {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Fmu").field("source", &self.0.source).finish_non_exhaustive()
    }
}

impl Fmu {
    /// Opens an `.fmu` file, or a folder that one was unpacked into.
    ///
    /// The shared library is loaded by [`Fmu::binary`] or the first instance, so FMUs for other
    /// platforms can be read.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, Error> {
        let source = path.as_ref().to_owned();
        let metadata = std::fs::metadata(&source).map_err(Error::file(&source))?;
        let (folder, entries, temporary) = if metadata.is_dir() {
            (std::path::absolute(&source).map_err(Error::file(&source))?, Vec::new(), None)
        } else {
            let temporary = Scratch::new().map_err(Error::file(&std::env::temp_dir()))?;
            let entries = archive::unpack(&source, temporary.path(), archive::ArchiveLimits::default())?;
            (temporary.path().to_owned(), entries, Some(temporary))
        };
        let xml_path = folder.join("modelDescription.xml");
        let xml = files::read_at_most(&xml_path, MAX_BYTES as u64).map_err(|error| match error.kind() {
            std::io::ErrorKind::NotFound => Error::Unusable {
                path: source.clone(),
                what: if metadata.is_dir() {
                    "it is a folder that holds no modelDescription.xml, so no FMU was unpacked into it"
                        .to_owned()
                } else {
                    "it is a ZIP archive that holds no modelDescription.xml, so it is no FMU".to_owned()
                },
            },
            _ => Error::file(&xml_path)(error),
        })?;
        let parsed = model_description::parse(&xml).map_err(|error| Error::Unusable {
            path: source.clone(),
            what: format!("modelDescription.xml: {}", Error::chain(&error)),
        })?;
        let names = parsed.description.variables.iter().map(|variable| variable.name.clone());
        let positions = names.zip(0..).collect();
        let access = AccessTable::new(&parsed.description);
        Ok(Self(Arc::new(Inner {
            source,
            folder,
            entries,
            _temporary: temporary,
            parsed,
            xml,
            positions,
            binary: Mutex::new(None),
            access,
        })))
    }

    /// The path it was opened from.
    pub fn source(&self) -> &Path {
        &self.0.source
    }

    /// The folder it is unpacked in.
    pub fn folder(&self) -> &Path {
        &self.0.folder
    }

    /// The paths of the archive's entries as it writes them; none for an unpacked folder.
    pub fn entries(&self) -> &[String] {
        &self.0.entries
    }

    /// The model description.
    pub fn description(&self) -> &Description {
        &self.0.parsed.description
    }

    /// The description with what the reader found odd and where everything stands.
    pub fn parsed(&self) -> &Parsed {
        &self.0.parsed
    }

    /// The bytes of `modelDescription.xml`.
    pub fn xml(&self) -> &[u8] {
        &self.0.xml
    }

    /// `modelName`.
    pub fn name(&self) -> &str {
        &self.0.parsed.description.model_name
    }

    /// The `CoSimulation` element, or an error for a model-exchange FMU.
    pub fn co_simulation(&self) -> Result<&CoSimulation, Error> {
        let found = self.description().co_simulation.as_ref();
        found.ok_or_else(|| {
            let what = "no CoSimulation element in modelDescription.xml: only co-simulation FMUs can be stepped here";
            Error::Unusable { path: self.0.source.clone(), what: what.to_owned() }
        })
    }

    /// The variable called `name`.
    pub fn find(&self, name: &str) -> Option<&ScalarVariable> {
        self.position(name).map(|position| &self.0.parsed.description.variables[position])
    }

    /// The variable called `name`; an error proposes similar names.
    pub fn variable(&self, name: &str) -> Result<&ScalarVariable, Error> {
        self.find(name).ok_or_else(|| unknown(self.description(), name))
    }

    /// Position of `name` in `ModelVariables`, from 0.
    pub fn position(&self, name: &str) -> Option<usize> {
        self.0.positions.get(name).copied()
    }

    /// Path of the shared library for this computer.
    pub fn binary_path(&self) -> Result<PathBuf, Error> {
        let identifier = &self.co_simulation()?.model_identifier;
        let candidates: Vec<String> = platform_folders()
            .iter()
            .map(|platform| format!("binaries/{platform}/{identifier}{}", std::env::consts::DLL_SUFFIX))
            .collect();
        for candidate in &candidates {
            let path = self.0.folder.join(candidate);
            if path.is_file() {
                return Ok(path);
            }
        }
        let found = files::names_in(&self.0.folder.join("binaries"));
        let searched = candidates.join(", ");
        let found = if found.is_empty() { "no binaries".to_owned() } else { found.join(", ") };
        let what =
            format!("no shared library for this computer: searched for {searched}; the FMU holds {found}");
        Err(Error::Unusable { path: self.0.source.clone(), what })
    }

    /// The shared library, loaded at the first call and kept for the life of the process.
    pub fn binary(&self) -> Result<Arc<Binary>, Error> {
        let mut slot = self.0.binary.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(binary) = slot.as_ref() {
            return Ok(Arc::clone(binary));
        }
        let binary = Arc::new(Binary::load(&self.binary_path()?)?);
        *slot = Some(Arc::clone(&binary));
        Ok(binary)
    }

    /// The name behind a value reference, for errors.
    pub(crate) fn name_of(&self, base: BaseType, reference: u32) -> String {
        let mut variables = self.description().variables.iter();
        variables
            .find(|variable| variable.value_reference == reference && variable.kind.base_type() == base)
            .map_or_else(|| format!("reference {reference}"), |variable| variable.name.clone())
    }

    pub(crate) fn access(&self) -> &AccessTable {
        &self.0.access
    }

    /// Positions in `ModelVariables` of everything `pattern` means, in declaration order.
    ///
    /// An exact name means itself; `torque.solar` all elements `torque.solar[1]`, `torque.solar[2]`, …; a `*` stands
    /// for any text, so `torque.*`, `plate*.force` and `momentum.body[*]` work. Brackets and dots are plain text. A name
    /// that nothing has may be one in another case.
    pub fn select(&self, pattern: &str) -> Result<Vec<usize>, Error> {
        match self.position(pattern.trim()) {
            Some(index) => Ok(vec![index]),
            None => select::select(self.description(), pattern),
        }
    }
}

/// A platform: operating system and architecture as Rust names them, kind of shared library and machine, folders under `binaries/`
/// that may hold its library, best first.
///
/// FMI 2.0.4 lets platforms beyond its own list use the tuples of FMI 3.0.
type Platform = (&'static str, &'static str, &'static str, &'static [&'static str]);

const PLATFORMS: [Platform; 8] = [
    ("linux", "x86_64", "ELF x86-64", &["linux64", "x86_64-linux"]),
    ("linux", "x86", "ELF x86", &["linux32", "x86-linux"]),
    ("linux", "aarch64", "ELF AArch64", &["aarch64-linux", "linux64"]),
    ("macos", "aarch64", "Mach-O AArch64", &["aarch64-darwin", "darwin64"]),
    ("macos", "x86_64", "Mach-O x86-64", &["darwin64", "x86_64-darwin"]),
    ("windows", "x86_64", "PE x86-64", &["win64", "x86_64-windows"]),
    ("windows", "x86", "PE x86", &["win32", "x86-windows"]),
    ("windows", "aarch64", "PE AArch64", &["aarch64-windows"]),
];

fn folders(is_meant: impl Fn(&Platform) -> bool) -> &'static [&'static str] {
    PLATFORMS.iter().find(|it| is_meant(it)).map_or(&[], |(.., folders)| folders)
}

/// Folders under `binaries/` that may hold the library for this computer, best first.
pub fn platform_folders() -> &'static [&'static str] {
    folders(|(os, arch, ..)| (*os, *arch) == (std::env::consts::OS, std::env::consts::ARCH))
}

/// Folders under `binaries/` that may hold a library of this kind and machine, as in [`crate::Requirements::format`], best first.
pub(crate) fn folders_of_format(format: &str) -> &'static [&'static str] {
    folders(|(_, _, known, _)| *known == format)
}

/// Whether importers of some platform look there for its library.
pub(crate) fn is_platform_folder(folder: &str) -> bool {
    PLATFORMS.iter().any(|(.., folders)| folders.contains(&folder))
}
