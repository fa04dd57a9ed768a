//! Copies of an FMU's folders.

use std::{fs, path::Path};

use crate::Error;

/// Copies the contents of a folder into another one, which it creates.
#[allow(clippy::disallowed_methods, reason = "the copy is a temporary one of an FMU")]
pub fn copy_folder(from: &Path, to: &Path) -> Result<(), Error> {
    fs::create_dir_all(to).map_err(Error::file(to))?;
    for entry in fs::read_dir(from).map_err(Error::file(from))? {
        let path = entry.map_err(Error::file(from))?.path();
        let target = to.join(path.file_name().unwrap_or_default());
        if path.is_dir() {
            copy_folder(&path, &target)?;
        } else {
            fs::copy(&path, &target).map_err(Error::file(&target))?;
        }
    }
    Ok(())
}
