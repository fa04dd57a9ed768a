//! Temporary files and folders, removed when they are dropped and when a signal ends the program.

use std::{
    fs, io, mem,
    path::{Path, PathBuf},
    sync::{Mutex, MutexGuard, PoisonError},
    thread,
    time::Duration,
};

use tempfile::TempDir;

static KNOWN: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn known() -> MutexGuard<'static, Vec<PathBuf>> {
    KNOWN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// How often a folder is removed in which a child that was just killed may still write, and the time between.
const ATTEMPTS: u32 = 100;
const PAUSE: Duration = Duration::from_millis(5);

/// Removes every temporary file and folder there is. The program ends next: nothing may use them any more, and whoever makes
/// another one waits for that end.
pub fn remove_temporaries() {
    let mut known = known();
    for path in known.drain(..) {
        for _ in 0..ATTEMPTS {
            // What is gone already needs no removing.
            let _ = if path.is_dir() { fs::remove_dir_all(&path) } else { fs::remove_file(&path) };
            if fs::symlink_metadata(&path).is_err() {
                break;
            }
            thread::sleep(PAUSE);
        }
    }
    mem::forget(known);
}

/// A path that [`remove_temporaries`] removes until this value is dropped.
#[derive(Debug)]
pub(crate) struct Registered(PathBuf);

impl Registered {
    /// With what `make` makes there; no end of the program falls between the two.
    pub fn with<T>(
        make: impl FnOnce() -> io::Result<T>,
        path: impl FnOnce(&T) -> &Path,
    ) -> io::Result<(T, Self)> {
        let mut known = known();
        let made = make()?;
        let path = path(&made).to_owned();
        known.push(path.clone());
        Ok((made, Self(path)))
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
        let make = || tempfile::Builder::new().prefix(prefix).tempdir();
        let (folder, _registered) = Registered::with(make, TempDir::path)?;
        Ok(Self { folder, _registered })
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }
}
