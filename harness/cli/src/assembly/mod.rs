//! FMUs of the files that people write, put together around a library: for `pack`, `check`, `run` and `map`.

mod assemble;
mod per_plate;
mod schedule;
mod source;
mod start;
mod without_effect;

use std::error::Error;

use files::{Entries, Scratch};
use loader::Fmu;

pub(crate) use assemble::{Assembled, Parts, assemble};
pub(crate) use source::{Source, common_keys, description, model_of, open_template, spacecraft_of};
pub(crate) use start::{START, with_values};
pub(crate) use without_effect::{can_read_map, unused_map};

/// Paths within an archive with what stands there.
type Contents = Vec<(String, Vec<u8>)>;

/// The files of the reference flight of the FMU that these files make; an error where it cannot simulate it.
pub(crate) fn reference_flight(entries: &Entries, inputs: &str) -> Result<Contents, Box<dyn Error>> {
    let folder = Scratch::new()?;
    entries.write_below(folder.path())?;
    let fmu = Fmu::open(folder.path())?;
    Ok(reference::record(&fmu, inputs).map_err(|error| loader::Error::chain(&error))?)
}
