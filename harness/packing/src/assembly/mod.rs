//! FMUs of the files that people write, put together around a library: for `pack`, `check`, `run` and `map`.

pub mod assemble;
pub mod orbit_default;
pub mod per_plate;
pub mod schedule;
pub mod source;
pub mod start;
pub mod without_effect;

use std::error::Error;

use files::{Entries, Scratch};
use fmi::{Fmu, Times};

use crate::instance;
pub use assemble::{Assembled, Parts, assemble};
pub use source::{Source, common_keys, description, model_of, open_template, spacecraft_of};
pub use start::{START, with_values};
pub use without_effect::{can_read_map, defaults_at_bounds, unused_map};

/// Paths within an archive with what stands there.
type Contents = Vec<(String, Vec<u8>)>;

/// The files of the reference flight of the FMU that these files make, and what it warns of where it begins; an error where it
/// cannot simulate it.
pub fn reference_flight(entries: &Entries, inputs: &str) -> Result<(Contents, Vec<String>), Box<dyn Error>> {
    let folder = Scratch::new()?;
    entries.write_below(folder.path())?;
    let fmu = Fmu::open(folder.path())?;
    let files = fmi::reference::record(&fmu, inputs).map_err(|error| fmi::Error::chain(&error))?;
    let start_s = Times::from_fmu(&fmu, None, None, None)?.start_s;
    let messages = instance::started(&fmu, "warnings", start_s, &[])?.messages();
    Ok((files, fmi::warnings(&messages).into_iter().map(str::to_owned).collect()))
}
