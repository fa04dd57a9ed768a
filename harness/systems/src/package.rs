//! An SSP on disk: unpacked without trusting it, its FMUs unpacked in place of their files.

use std::{
    io,
    path::{Path, PathBuf},
};

use files::Scratch;
use fmi::ArchiveLimits;
use percent_encoding::percent_decode_str;

use crate::{error::Error, structure::SSD_FILE};

/// Largest description of a system, or set of parameters, in bytes.
pub const MAX_BYTES: u64 = 64 << 20;

/// Whether a path is that of a system and not of an FMU: an `.ssp` file, or a folder with a description of one.
pub fn is_system(path: &Path) -> bool {
    path.extension().is_some_and(|it| it.eq_ignore_ascii_case("ssp")) || path.join(SSD_FILE).is_file()
}

/// An unpacked SSP.
#[derive(Debug)]
pub(crate) struct Package {
    /// File or folder that it was opened from.
    pub source: PathBuf,
    /// Folder that it is unpacked into.
    pub folder: PathBuf,
    // Removed with the package.
    _temporary: Option<Scratch>,
}

impl Package {
    /// Unpacks an `.ssp` file, or takes the folder that one was unpacked into.
    pub(crate) fn open(path: &Path) -> Result<Self, Error> {
        let at_path = fmi::Error::file(path);
        if std::fs::metadata(path).map_err(&at_path)?.is_dir() {
            let folder = std::path::absolute(path).map_err(at_path)?;
            return Ok(Self { source: path.to_owned(), folder, _temporary: None });
        }
        let temporary = Scratch::new().map_err(fmi::Error::file(&std::env::temp_dir()))?;
        fmi::unpack(path, temporary.path(), ArchiveLimits::default()).map_err(|error| match error {
            fmi::Error::Archive { path, what } => Error::Archive { path, what },
            other => other.into(),
        })?;
        let folder = temporary.path().to_owned();
        Ok(Self { source: path.to_owned(), folder, _temporary: Some(temporary) })
    }

    /// A file of the SSP.
    pub(crate) fn read(&self, relative: &str) -> Result<Vec<u8>, Error> {
        let refuse = |what: String| self.structure(relative, what);
        let path = self.path(relative).map_err(refuse)?;
        files::read_at_most(&path, MAX_BYTES).map_err(|error| match error.kind() {
            io::ErrorKind::NotFound if relative == SSD_FILE => Error::Archive {
                path: self.source.clone(),
                what: format!("it holds no {SSD_FILE}, so it is no system"),
            },
            io::ErrorKind::NotFound => refuse(format!("there is no such file in the SSP{}", self.listed())),
            _ => fmi::Error::file(&path)(error).into(),
        })
    }

    /// Returns the path of a file of the SSP; `source` is a relative URI.
    pub(crate) fn path(&self, source: &str) -> Result<PathBuf, String> {
        let decoded = percent_decode_str(source).decode_utf8_lossy();
        let inside = fmi::path_inside(&decoded).ok_or_else(|| {
            format!("found {source:?}, allowed: a path in the SSP such as resources/plant.fmu")
        })?;
        Ok(self.folder.join(inside))
    }

    /// The folder that an FMU of the SSP is unpacked into: where its file was.
    #[allow(clippy::disallowed_methods, reason = "the SSP is unpacked into a temporary folder")]
    pub(crate) fn fmu_folder(&self, source: &str) -> Result<PathBuf, Error> {
        let refuse = |what: String| self.structure(SSD_FILE, what);
        let path = self.path(source).map_err(refuse)?;
        if path.is_dir() {
            return Ok(path);
        }
        if !path.is_file() {
            return Err(refuse(format!("{source:?} is not in the SSP{}", self.listed())));
        }
        let into = path.with_extension("unpacked");
        std::fs::create_dir(&into).map_err(fmi::Error::file(&into))?;
        fmi::unpack(&path, &into, ArchiveLimits::default())
            .map_err(|error| refuse(format!("{source:?}: {}", reason(&error))))?;
        std::fs::remove_file(&path).map_err(fmi::Error::file(&path))?;
        std::fs::rename(&into, &path).map_err(fmi::Error::file(&into))?;
        Ok(path)
    }

    /// A refusal of what stands in a file of the SSP.
    pub(crate) fn structure(&self, file: &str, what: String) -> Error {
        Error::Structure { path: self.source.clone(), file: file.to_owned(), what }
    }

    /// Returns the names of the resources, for refusals.
    fn listed(&self) -> String {
        let names = files::names_in(&self.folder.join("resources"));
        let names: Vec<String> = names.iter().map(|name| format!("resources/{name}")).collect();
        if names.is_empty() { String::new() } else { format!(", allowed: {}", names.join(", ")) }
    }
}

/// Returns the fault of an archive, without the path of the copy that was read.
fn reason(error: &fmi::Error) -> String {
    match error {
        fmi::Error::Archive { what, .. } => format!("not a usable FMU archive: {what}"),
        other => fmi::Error::chain(other),
    }
}
