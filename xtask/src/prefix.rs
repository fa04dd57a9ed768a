//! Files below the prefix of an installation: program, library, FMUs, systems and manual.

use std::{
    ffi::OsStr,
    fs,
    path::{Path, PathBuf},
};

use crate::build::{self, Built};
use crate::paths::entries;
use crate::shell::{self, root, run};

/// Folder of the program below the prefix.
pub(crate) const PROGRAM_FOLDER: &str = "bin";

/// Folder of the library and the FMUs below the prefix; the program looks there from its own folder.
const LIBRARY_FOLDER: [&str; 2] = ["lib", "heliotorque"];

/// Folder in which `man` looks for pages of commands, next to the folder of the program.
const MANUAL_FOLDER: [&str; 3] = ["share", "man", "man1"];

/// Copies program, library and FMUs of a platform below a prefix, for the host also systems and the manual.
pub(crate) fn below(
    prefix: &Path,
    built: &Built,
    writes_manual: Option<&Path>,
) -> Result<Vec<PathBuf>, String> {
    let under = |parts: &[&str]| parts.iter().fold(prefix.to_owned(), |path, part| path.join(part));
    let [binaries, folder, manual] = [&[PROGRAM_FOLDER], &LIBRARY_FOLDER[..], &MANUAL_FOLDER[..]].map(under);
    let mut files = vec![(built.heliotorque.clone(), &binaries), (built.library.clone(), &folder)];
    files.extend(packed("fmu")?.into_iter().map(|path| (path, &folder)));
    if let Some(program) = writes_manual {
        files.extend(packed("ssp")?.into_iter().map(|path| (path, &folder)));
        files.extend(pages(program)?.into_iter().map(|path| (path, &manual)));
    }
    files.iter().map(|(from, to)| copy(from, to)).collect()
}

/// The FMUs or systems of `dist/`, by name.
fn packed(extension: &str) -> Result<Vec<PathBuf>, String> {
    files_in(&root().join("dist"), extension)
}

/// The manual's pages, as the program writes them.
fn pages(program: &Path) -> Result<Vec<PathBuf>, String> {
    let folder = build::scratch("man")?;
    run(shell::command(program).args(["man", "--output"]).arg(&folder))?;
    files_in(&folder, "1")
}

/// The files of a folder with this extension, by name.
fn files_in(folder: &Path, extension: &str) -> Result<Vec<PathBuf>, String> {
    let is_meant = |path: &PathBuf| path.is_file() && path.extension() == Some(OsStr::new(extension));
    Ok(entries(folder)?.into_iter().filter(is_meant).collect())
}

/// Copies a file into a folder under its own name: whole or not at all, also over a program that runs.
pub(crate) fn copy(from: &Path, folder: &Path) -> Result<PathBuf, String> {
    let name = from.file_name().ok_or_else(|| format!("{} is no file", from.display()))?;
    let to = folder.join(name);
    let mut part = name.to_owned();
    part.push(".part");
    let part = folder.join(part);
    let copied =
        fs::create_dir_all(folder).and_then(|()| fs::copy(from, &part)).and_then(|_| fs::rename(&part, &to));
    copied.map_err(|error| format!("{}: {error}: see --prefix", to.display()))?;
    Ok(to)
}
