//! Temporary files and folders, removed when they are dropped and when a signal ends the program.

use std::{
    fs, io,
    path::{Path, PathBuf},
    sync::{Mutex, MutexGuard, PoisonError},
};

use tempfile::TempDir;

static KNOWN: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn known() -> MutexGuard<'static, Vec<PathBuf>> {
    KNOWN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes every temporary file and folder there is. The program ends next: nothing may use them any more.
pub fn remove_temporaries() {
    for path in known().drain(..) {
        // What is gone already needs no removing.
        let _ = if path.is_dir() { fs::remove_dir_all(&path) } else { fs::remove_file(&path) };
    }
}

/// A path that [`remove_temporaries`] removes until this value is dropped.
#[derive(Debug)]
pub(crate) struct Registered(PathBuf);

impl Registered {
    pub fn new(path: &Path) -> Self {
        known().push(path.to_owned());
        Self(path.to_owned())
    }
}

impl Drop for Registered {
    fn drop(&mut self) {
        known().retain(|path| *path != self.0);
    }
}

/// A temporary folder.
#[derive(Debug)]
pub struct Scratch {
    folder: TempDir,
    _registered: Registered,
}

impl Scratch {
    /// Makes one where the system keeps temporary files; `prefix` begins its name.
    pub fn new(prefix: &str) -> io::Result<Self> {
        let folder = tempfile::Builder::new().prefix(prefix).tempdir()?;
        let _registered = Registered::new(folder.path());
        Ok(Self { folder, _registered })
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }
}
