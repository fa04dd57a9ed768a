//! The files of a plan.

use std::{
    error::Error,
    path::{Path, PathBuf},
};

use ::files::Destination;

/// Option that names the folder.
pub(super) const OPTION: &str = "--output";

/// Begins the TOML files of a plan.
const HEAD: &str = "# Written by `heliotorque plan`, which replaces it when it plans again.\n";

fn is_edited_by_people(name: &str) -> bool {
    name.ends_with(".toml")
}

/// Refuses a folder in which files that no plan wrote have the names of a plan's files.
///
/// # Errors
/// The first such file.
pub(super) fn check_standing<'n>(
    folder: &Path,
    names: impl IntoIterator<Item = &'n str>,
) -> Result<(), String> {
    for path in names.into_iter().filter(|name| is_edited_by_people(name)).map(|name| folder.join(name)) {
        let found = if path.exists() { ::files::read_text(&path)? } else { String::new() };
        if !found.is_empty() && !found.starts_with(HEAD) {
            let allowed = "allowed: none, or what a plan wrote; another folder takes a new one";
            return Err(format!(
                "{}: found a file that no plan wrote, {allowed}: see {OPTION}",
                path.display()
            ));
        }
    }
    Ok(())
}

/// Writes texts under their names into a folder and gives their paths; none is written unless all can be.
///
/// # Errors
/// A file that cannot be written, or that is one of `inputs`.
pub(super) fn write_all(
    folder: &Path,
    contents: &[(&str, String)],
    inputs: &[&Path],
) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let opened = contents.iter().map(|(name, text)| {
        let path = folder.join(name);
        let text = match is_edited_by_people(name) {
            true => format!("{HEAD}{}", text.strip_prefix(HEAD).unwrap_or(text)),
            false => text.clone(),
        };
        Destination::open(&path, OPTION, inputs).map(|destination| (path, destination, text))
    });
    let opened = opened.collect::<Result<Vec<_>, _>>()?;
    check_standing(folder, contents.iter().map(|(name, _)| *name))?;
    let mut written = Vec::with_capacity(opened.len());
    for (path, destination, text) in opened {
        destination.fill(|file| file.write_all(text.as_bytes()))?;
        written.push(path);
    }
    Ok(written)
}
