//! Windows: volume and file index, share modes.

use std::{
    fs::{self, File, OpenOptions, TryLockError},
    io,
    os::windows::fs::OpenOptionsExt,
    path::{Path, PathBuf},
};

use winapi_util::file::information;

use crate::identity::Identity;

/// CreateFileW's share modes, and its flags to open folders and links themselves.
const FILE_SHARE_READ: u32 = 0x1;
const FILE_SHARE_DELETE: u32 = 0x4;
const FILE_FLAG_BACKUP_SEMANTICS: u32 = 0x0200_0000;
const FILE_FLAG_OPEN_REPARSE_POINT: u32 = 0x0020_0000;
/// Errors by which an open file is refused: no access, a sharing violation, a mapped one.
const IN_USE: [i32; 3] = [5, 32, 1224];
const SHARING_VIOLATION: i32 = 32;

fn identity_from(file: &File) -> io::Result<Identity> {
    let found = information(file)?;
    Ok(Identity {
        device_and_inode: (found.volume_serial_number(), found.file_index()),
        hard_links: found.number_of_links(),
    })
}

/// Opens a path for its attributes only, which succeeds whatever the share modes of others.
fn open_for_attributes(path: &Path, flags: u32) -> io::Result<File> {
    OpenOptions::new().access_mode(0).custom_flags(FILE_FLAG_BACKUP_SEMANTICS | flags).open(path)
}

/// Identity of the file at a path, following links.
pub(crate) fn identity(path: &Path) -> io::Result<Identity> {
    identity_from(&open_for_attributes(path, 0)?)
}

/// Identity of the entry at a path, without following a link.
pub(crate) fn identity_of_link(path: &Path) -> io::Result<Identity> {
    identity_from(&open_for_attributes(path, FILE_FLAG_OPEN_REPARSE_POINT)?)
}

/// Identity of an open file.
pub(crate) fn identity_of_open(file: &File) -> io::Result<Identity> {
    identity_from(file)
}

/// Opens a file that no other program can write while it is open; [`io::ErrorKind::ResourceBusy`] where one does.
///
/// No lock: that would keep readers out too.
pub(crate) fn open_exclusively(options: &mut OpenOptions, path: &Path) -> io::Result<File> {
    options.share_mode(FILE_SHARE_READ | FILE_SHARE_DELETE).open(path).map_err(|error| {
        if error.raw_os_error() == Some(SHARING_VIOLATION) {
            io::ErrorKind::ResourceBusy.into()
        } else {
            error
        }
    })
}

/// Locks a folder while the handle is open; its files can change and it can be removed.
pub(crate) fn lock_folder(folder: &Path) -> Result<File, TryLockError> {
    let mut options = OpenOptions::new();
    options.read(true).write(true).custom_flags(FILE_FLAG_BACKUP_SEMANTICS);
    open_exclusively(&mut options, folder).map_err(|error| match error.kind() {
        io::ErrorKind::ResourceBusy => TryLockError::WouldBlock,
        _ => TryLockError::Error(error),
    })
}

/// Absolute path with links resolved, without `\\?\` where it is short enough for every program.
pub fn canonical(path: &Path) -> io::Result<PathBuf> {
    const MAX_PATH: usize = 260;
    let whole = fs::canonicalize(path)?;
    let plain = whole.to_str().and_then(|text| text.strip_prefix(r"\\?\"));
    let plain = plain.filter(|text| text.as_bytes().get(1) == Some(&b':') && text.len() < MAX_PATH);
    Ok(plain.map_or_else(|| whole.clone(), PathBuf::from))
}

/// Error with advice for the user where another program has the file open.
pub(crate) fn with_advice(error: io::Error) -> io::Error {
    match error.raw_os_error() {
        Some(code) if IN_USE.contains(&code) => io::Error::new(
            error.kind(),
            format!(
                "another program has it open, or it is protected ({error}): close it there, then try again"
            ),
        ),
        _ => error,
    }
}

/// Gives a file the name of another, which it replaces; refused where a program has that open and does not share its name.
pub(crate) fn rename(from: &Path, to: &Path) -> io::Result<()> {
    fs::rename(from, to).map_err(with_advice)
}

/// Names are written with their file.
pub(crate) fn sync_folder_of(_file: &Path) {}
