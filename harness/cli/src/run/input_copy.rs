//! A file with what the standard input holds, for `run --input -`: parent and child both read it.

use std::{
    fs::File,
    io,
    path::{Path, PathBuf},
};

use files::Scratch;

use crate::args::Run;

/// The copy, which goes with it.
pub struct InputCopy(Scratch);

impl InputCopy {
    /// Reads the standard input to its end where `--input -` says so.
    pub fn of(arguments: &Run) -> Result<Option<Self>, String> {
        if arguments.input.as_deref() != Some(Path::new("-")) {
            return Ok(None);
        }
        let text = |error: io::Error| format!("standard input: {error}: see --input");
        let copy = Self(Scratch::new().map_err(text)?);
        let mut file = File::create_new(copy.path()).map_err(text)?;
        io::copy(&mut io::stdin().lock(), &mut file).map_err(text)?;
        Ok(Some(copy))
    }

    /// Where it stands.
    pub fn path(&self) -> PathBuf {
        self.0.path().join("input.csv")
    }
}
