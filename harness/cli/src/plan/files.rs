//! The files of a plan, and those of a planned burn.

use std::{
    error::Error,
    fs,
    path::{Path, PathBuf},
};

use ::files::Destination;
use planner::spin::{PlannedBurn, start_table};

use super::picture;

const OPTION: &str = "--output";

/// Writes `burn.csv`, `burn.json`, `start.toml` and `burn.svg` into the folder, which is created if missing; gives their
/// paths.
///
/// # Errors
/// A file that cannot be written, or that is the spacecraft's.
pub(super) fn write(
    folder: &Path,
    spacecraft: Option<&Path>,
    burn: &PlannedBurn,
) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let contents = [
        ("burn.csv", String::from_utf8(burn.to_csv()?)?),
        ("burn.json", String::from_utf8(burn.to_json()?)?),
        ("start.toml", start_table(&burn.start_values())),
        ("burn.svg", picture::svg(burn)?),
    ];
    fs::create_dir_all(folder).map_err(|error| format!("{}: {error}: see {OPTION}", folder.display()))?;
    let inputs: Vec<&Path> = spacecraft.into_iter().collect();
    let contents = contents.map(|(name, text)| (name, terminal::unsigned_zeros(&text).into_owned()));
    write_all(folder, &contents, &inputs)
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
        Destination::open(&path, OPTION, inputs).map(|destination| (path, destination, text))
    });
    let opened = opened.collect::<Result<Vec<_>, _>>()?;
    let mut written = Vec::with_capacity(opened.len());
    for (path, destination, text) in opened {
        destination.fill(|file| file.write_all(text.as_bytes()))?;
        written.push(path);
    }
    Ok(written)
}
