//! File in progress, `<name>.part`, locked against other runs as long as it is open.

use std::{
    fs::{self, File, OpenOptions},
    io::{self, Read, Seek, SeekFrom, Write},
    path::{Path, PathBuf},
};

use crate::{
    place::{check_place, keep_permissions},
    system,
};

/// File in progress beside a destination, `<name>.part`, locked against others as long as it is open.
#[derive(Debug)]
pub struct Part {
    path: PathBuf,
    option: &'static str,
    file: File,
    /// Whether nothing was there before.
    is_new: bool,
    /// Whether it holds this recording.
    is_begun: bool,
}

impl Part {
    /// How often a file is opened that others take away meanwhile.
    const ATTEMPTS: usize = 100;

    /// Opens and locks it; what it holds of an earlier recording stays until something is appended.
    pub(crate) fn open(path: &Path, option: &'static str, inputs: &[&Path]) -> Result<Self, String> {
        Self::locked(path, option, inputs).map_err(|what| format!("{}: {what}: see {option}", path.display()))
    }

    fn locked(path: &Path, option: &'static str, inputs: &[&Path]) -> Result<Self, String> {
        let text = |error: io::Error| match error.kind() {
            io::ErrorKind::ResourceBusy => "another run is writing it".to_owned(),
            _ => error.to_string(),
        };
        let options = || {
            let mut options = OpenOptions::new();
            options.read(true).write(true);
            options
        };
        for _ in 0..Self::ATTEMPTS {
            check_place(path, inputs)?;
            let (file, is_new) = match system::open_exclusively(options().create_new(true), path) {
                Ok(file) => (file, true),
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                    match system::open_exclusively(&mut options(), path) {
                        Ok(file) => (file, false),
                        Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
                        Err(error) => return Err(text(error)),
                    }
                }
                Err(error) => return Err(text(error)),
            };
            // Until it was locked, another run may have given it its name, and a link may lead elsewhere.
            if is_at(&file, path) {
                return Ok(Self { path: path.to_owned(), option, file, is_new, is_begun: false });
            }
            if has_other_names(&file) {
                fs::remove_file(path).map_err(text)?;
            }
        }
        Err("others take it away again and again".to_owned())
    }

    /// Returns the whole content that an earlier recording left.
    pub(crate) fn content(&mut self) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        self.file.rewind()?;
        self.file.read_to_end(&mut bytes)?;
        Ok(bytes)
    }

    /// Returns its path once it holds something of this recording.
    pub(crate) fn begun_path(&self) -> Option<&Path> {
        self.is_begun.then_some(&self.path)
    }

    /// Gives it the name of the complete file, once the disk has its content.
    pub(crate) fn rename(&mut self, target: &Path) -> io::Result<()> {
        self.append(&[])?;
        self.file.sync_all()?;
        keep_permissions(&self.file, target)?;
        system::rename(&self.path, target)?;
        system::sync_folder_of(target);
        Ok(())
    }

    /// Continues the part of an earlier run and keeps its first bytes.
    pub fn keep(&mut self, bytes: u64) -> io::Result<()> {
        self.file.set_len(bytes)?;
        self.file.seek(SeekFrom::End(0))?;
        self.is_begun = true;
        Ok(())
    }

    pub(crate) fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        if !self.is_begun {
            self.keep(0)?;
        }
        self.file.write_all(bytes)
    }

    /// Writes bytes at a place; without [`Part::keep`] before, what an earlier run left goes first.
    pub fn write_at(&mut self, place: u64, bytes: &[u8]) -> Result<(), String> {
        let begun = if self.is_begun { Ok(()) } else { self.keep(0) };
        let written = begun
            .and_then(|()| self.file.seek(SeekFrom::Start(place)))
            .and_then(|_| self.file.write_all(bytes));
        written.map_err(|error| self.message(&error))
    }

    /// Fills a buffer with the bytes from a place on.
    pub fn read_at(&mut self, place: u64, bytes: &mut [u8]) -> io::Result<()> {
        self.file.seek(SeekFrom::Start(place))?;
        self.file.read_exact(bytes)
    }

    /// Removes it.
    pub fn remove(mut self) -> Result<(), String> {
        self.is_begun = true;
        fs::remove_file(&self.path).map_err(|error| self.message(&error))
    }

    pub(crate) fn message(&self, error: &io::Error) -> String {
        format!("{}: {error}: see {}", self.path.display(), self.option)
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        if self.is_new && !self.is_begun {
            // Nobody else has it: it is still locked.
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// Whether an open file is the one at this path, under no other name and behind no link.
fn is_at(file: &File, path: &Path) -> bool {
    let (Ok(open), Ok(there)) = (system::identity_of_open(file), system::identity_of_link(path)) else {
        return false;
    };
    open.device_and_inode == there.device_and_inode && open.hard_links == 1
}

/// Whether an open file has more names than one.
fn has_other_names(file: &File) -> bool {
    system::identity_of_open(file).is_ok_and(|identity| identity.hard_links > 1)
}
