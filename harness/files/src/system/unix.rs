//! Unix: device and inode, advisory locks.

use std::{
    fs::{self, File, Metadata, OpenOptions, TryLockError},
    io,
    os::unix::fs::MetadataExt,
    path::{Path, PathBuf},
};

use crate::{identity::Identity, paths::folder_of};

fn identity_from(metadata: &Metadata) -> Identity {
    Identity { device_and_inode: (metadata.dev(), metadata.ino()), hard_links: metadata.nlink() }
}

/// Identity of the file at a path, following links.
pub(crate) fn identity(path: &Path) -> io::Result<Identity> {
    fs::metadata(path).map(|metadata| identity_from(&metadata))
}

/// Identity of the entry at a path, without following a link.
pub(crate) fn identity_of_link(path: &Path) -> io::Result<Identity> {
    fs::symlink_metadata(path).map(|metadata| identity_from(&metadata))
}

/// Identity of an open file.
pub(crate) fn identity_of_open(file: &File) -> io::Result<Identity> {
    file.metadata().map(|metadata| identity_from(&metadata))
}

/// Opens a file that no other run can write while it is open; [`io::ErrorKind::ResourceBusy`] where one does.
pub(crate) fn open_exclusively(options: &mut OpenOptions, path: &Path) -> io::Result<File> {
    let file = options.open(path)?;
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(io::ErrorKind::ResourceBusy.into()),
        Err(TryLockError::Error(error)) if error.kind() != io::ErrorKind::Unsupported => Err(error),
        _ => Ok(file),
    }
}

/// Locks a folder; an error where folders cannot be locked.
pub(crate) fn lock_folder(folder: &Path) -> Result<File, TryLockError> {
    let file = File::open(folder).map_err(TryLockError::Error)?;
    file.try_lock()?;
    Ok(file)
}

/// Absolute path with links resolved.
pub fn canonical(path: &Path) -> io::Result<PathBuf> {
    fs::canonicalize(path)
}

/// Error with advice for the user; none is needed here.
pub(crate) fn with_advice(error: io::Error) -> io::Error {
    error
}

/// Renames a file, replacing the target; programs that have the target open keep the old content.
pub(crate) fn rename(from: &Path, to: &Path) -> io::Result<()> {
    fs::rename(from, to)
}

/// Lets the disk have the names of a file's folder, where the file system can.
pub(crate) fn sync_folder_of(file: &Path) {
    // The content is there already; a name that is lost leaves the file before.
    let _ = File::open(folder_of(file)).and_then(|folder| folder.sync_all());
}
