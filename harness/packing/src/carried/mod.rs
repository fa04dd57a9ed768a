//! Files of FMUs of this project beside the spacecraft: commands and positions over time.

pub mod ephemeris;
pub mod timeline;

use std::path::Path;

use files::outcome::Refusal;
use fmi::Fmu;
use inputs::home;

/// Reads a file of some resources: what it holds in a line, or what is wrong with it.
type Read = fn(&Fmu, &Path) -> Result<String, Refusal>;

/// Returns the summaries of an FMU's files, by their names.
pub fn summaries(fmu: &Fmu) -> Vec<(&'static str, Result<String, Refusal>)> {
    let resources = fmu.folder().join("resources");
    let all: [(&str, Read); 2] =
        [(timeline::FILE, timeline::read), (ephemeris::FILE, |_, resources| ephemeris::read(resources))];
    // Other exporters' files of these names mean something else.
    let is_ours = home::is_ours(fmu.description());
    let there = all.into_iter().filter(|(file, _)| is_ours && resources.join(file).exists());
    there.map(|(file, read)| (file, read(fmu, &resources))).collect()
}
