//! Temporary files and folders, removed when they are dropped and when a signal ends the program; folders of a program that was
//! killed are removed by the next one.
//!
//! A folder is locked as long as its program runs. One that can be locked has nobody any more.

use std::{
    fs::{self, File, TryLockError},
    io::{self, Write},
    mem,
    path::{Path, PathBuf},
    sync::{Mutex, MutexGuard, Once, PoisonError},
    thread,
    time::Duration,
};

use tempfile::TempDir;

use crate::system;

static KNOWN: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn known() -> MutexGuard<'static, Vec<PathBuf>> {
    KNOWN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// How often a folder is removed in which a child that was just killed may still write, and the time between.
const ATTEMPTS: u32 = 100;
const PAUSE: Duration = Duration::from_millis(5);

/// Removes every temporary file and folder there is. The program ends next: nothing may use them any more, and a thread that makes
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
    pub(crate) fn with<T>(
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

/// Beginning and end of the names of temporary folders; six letters and digits are between.
const NAME: [&str; 2] = ["heliotorque-", ".scratch"];
const LETTERS: usize = 6;

/// A temporary folder.
#[derive(Debug)]
pub struct Scratch {
    folder: TempDir,
    _registered: Registered,
    // Locked; closed by the end of the program, however that comes.
    _lock: Option<File>,
}

impl Scratch {
    /// Makes one where the system keeps temporary files, and removes those there whose program was killed.
    ///
    /// # Errors
    /// No folder can be made.
    pub fn new() -> io::Result<Self> {
        static SWEPT: Once = Once::new();
        SWEPT.call_once(|| sweep(&std::env::temp_dir()));
        let [prefix, suffix] = NAME;
        loop {
            let make =
                || tempfile::Builder::new().prefix(prefix).suffix(suffix).rand_bytes(LETTERS).tempdir();
            let (folder, _registered) = Registered::with(make, TempDir::path)?;
            let lock = system::lock_folder(folder.path());
            // Another program may have taken it for an abandoned one until it was locked.
            if folder.path().is_dir() && !matches!(lock, Err(TryLockError::WouldBlock)) {
                return Ok(Self { folder, _registered, _lock: lock.ok() });
            }
        }
    }

    /// Path of the folder.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Writes a new file into it and gives its path.
    ///
    /// # Errors
    /// A file that is there already or cannot be written.
    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) -> io::Result<PathBuf> {
        let path = self.path().join(name);
        File::create_new(&path)?.write_all(content.as_ref())?;
        Ok(path)
    }
}

/// Removes the folders of killed programs. What cannot be removed belongs to somebody else.
fn sweep(temporaries: &Path) {
    let [prefix, suffix] = NAME;
    let is_ours = |name: &str| {
        let letters = name.strip_prefix(prefix).and_then(|rest| rest.strip_suffix(suffix));
        letters.is_some_and(|it| it.len() == LETTERS && it.bytes().all(|byte| byte.is_ascii_alphanumeric()))
    };
    for entry in fs::read_dir(temporaries).into_iter().flatten().flatten() {
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        if !is_folder || !entry.file_name().to_str().is_some_and(is_ours) {
            continue;
        }
        if let Ok(_locked) = system::lock_folder(&entry.path()) {
            let _ = fs::remove_dir_all(entry.path());
        }
    }
}

#[cfg(test)]
mod tests {
    //! Folders of killed programs go, those in use and those of others stay.

    use super::*;

    #[test]
    fn what_nobody_uses_is_removed_and_nothing_else() {
        let place = tempfile::tempdir().unwrap();
        let at = |name: &str| place.path().join(name);
        let names = [
            "heliotorque-aB3dE9.scratch",
            "heliotorque-inUse1.scratch",
            "heliotorque-aB3dE9",
            "heliotorque-results.scratch",
            "other-aB3dE9.scratch",
        ];
        for name in names {
            fs::create_dir_all(at(name).join("deep")).unwrap();
            fs::write(at(name).join("deep/file"), "x").unwrap();
        }
        fs::write(at("heliotorque-aFile0.scratch"), "x").unwrap();
        let in_use = system::lock_folder(&at(names[1])).unwrap();
        sweep(place.path());
        let left: Vec<bool> = names.iter().map(|name| at(name).join("deep/file").exists()).collect();
        assert_eq!(left, [false, true, true, true, true]);
        assert!(!at(names[0]).exists() && at("heliotorque-aFile0.scratch").exists());
        drop(in_use);
        sweep(place.path());
        assert!(!at(names[1]).exists());
    }
}
