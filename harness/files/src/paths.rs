//! Paths beside a file, and its folder.

use std::path::{Path, PathBuf};

/// Path of the file in progress of a target, `<name>.part`.
pub fn part_of(target: &Path) -> PathBuf {
    with_ending(target, ".part")
}

/// The file beside a table that tells of it.
pub fn sidecar_of(table: &Path) -> PathBuf {
    with_ending(table, ".toml")
}

fn with_ending(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(ending);
    PathBuf::from(name)
}

pub(crate) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}
