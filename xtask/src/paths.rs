//! Files and folders of the workspace; a failure names the path.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::shell::root;

/// A file of `dist/`.
pub(crate) fn dist(name: impl AsRef<Path>) -> PathBuf {
    root().join("dist").join(name)
}

/// A file of the resources.
pub(crate) fn resource(name: impl AsRef<Path>) -> PathBuf {
    root().join("fmu-src").join("resources").join(name)
}

/// Outcome of something done with a path; a failure names it.
pub(crate) fn at<T>(path: &Path, outcome: io::Result<T>) -> Result<T, String> {
    outcome.map_err(|error| format!("{}: {error}", path.display()))
}

/// The text of a file.
pub(crate) fn read(path: &Path) -> Result<String, String> {
    at(path, fs::read_to_string(path))
}

/// Writes a file.
pub(crate) fn write(path: &Path, text: impl AsRef<[u8]>) -> Result<(), String> {
    at(path, fs::write(path, text))
}

/// A folder, created where it is missing.
pub(crate) fn created(folder: PathBuf) -> Result<PathBuf, String> {
    match fs::create_dir_all(&folder) {
        Ok(()) => Ok(folder),
        Err(error) => Err(format!("cannot create {}: {error}", folder.display())),
    }
}

/// Contents of a folder, by name.
pub(crate) fn entries(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let paths = fs::read_dir(folder).and_then(|all| all.map(|entry| Ok(entry?.path())).collect());
    let mut paths: Vec<PathBuf> = at(folder, paths)?;
    paths.sort();
    Ok(paths)
}

/// The last part of a path.
pub(crate) fn name_of(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
