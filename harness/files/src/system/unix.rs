//! Unix: device and inode, advisory locks.

use std::{
    fs::{self, File, Metadata, OpenOptions, TryLockError},
    io,
    os::unix::fs::MetadataExt,
    path::{Path, PathBuf},
};

use crate::identity::Identity;

fn of(metadata: &Metadata) -> Identity {
    Identity { place: (metadata.dev(), metadata.ino()), names: metadata.nlink() }
}

/// The file that a path leads to.
pub(crate) fn identity(path: &Path) -> io::Result<Identity> {
    fs::metadata(path).map(|metadata| of(&metadata))
}

/// What stands at a path, itself if it is a link.
pub(crate) fn identity_of_link(path: &Path) -> io::Result<Identity> {
    fs::symlink_metadata(path).map(|metadata| of(&metadata))
}

/// An open file.
pub(crate) fn identity_of_open(file: &File) -> io::Result<Identity> {
    file.metadata().map(|metadata| of(&metadata))
}

/// Opens a file that no other run writes as long as it is open; [`io::ErrorKind::ResourceBusy`] where one does.
pub(crate) fn open_alone(options: &mut OpenOptions, path: &Path) -> io::Result<File> {
    let file = options.open(path)?;
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(io::ErrorKind::ResourceBusy.into()),
        Err(TryLockError::Error(error)) if error.kind() != io::ErrorKind::Unsupported => Err(error),
        _ => Ok(file),
    }
}

/// A folder, locked; where folders cannot be locked, the error says so.
pub(crate) fn lock_folder(folder: &Path) -> Result<File, TryLockError> {
    let file = File::open(folder).map_err(TryLockError::Error)?;
    file.try_lock()?;
    Ok(file)
}

/// The whole path, behind all links.
pub fn canonical(path: &Path) -> io::Result<PathBuf> {
    fs::canonicalize(path)
}

/// An error with what a person can do about it: the system's own text says it.
pub(crate) fn explained(error: io::Error) -> io::Error {
    error
}

/// Gives a file the name of another, which it replaces; who has that open keeps it.
pub(crate) fn rename(from: &Path, to: &Path) -> io::Result<()> {
    fs::rename(from, to)
}
