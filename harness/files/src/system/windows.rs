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
/// What refuses an open file: no access, a sharing violation, a mapped one.
const IN_USE: [i32; 3] = [5, 32, 1224];
const SHARING_VIOLATION: i32 = 32;

fn of(file: &File) -> io::Result<Identity> {
    let found = information(file)?;
    Ok(Identity { place: (found.volume_serial_number(), found.file_index()), names: found.number_of_links() })
}

/// Opens what a path leads to without access, which whoever has it open allows.
fn look(path: &Path, flags: u32) -> io::Result<File> {
    OpenOptions::new().access_mode(0).custom_flags(FILE_FLAG_BACKUP_SEMANTICS | flags).open(path)
}

/// The file that a path leads to.
pub(crate) fn identity(path: &Path) -> io::Result<Identity> {
    of(&look(path, 0)?)
}

/// What stands at a path, itself if it is a link.
pub(crate) fn identity_of_link(path: &Path) -> io::Result<Identity> {
    of(&look(path, FILE_FLAG_OPEN_REPARSE_POINT)?)
}

/// An open file.
pub(crate) fn identity_of_open(file: &File) -> io::Result<Identity> {
    of(file)
}

/// Opens a file that no other program writes as long as it is open; [`io::ErrorKind::ResourceBusy`] where one does.
///
/// No lock: that would keep readers out too.
pub(crate) fn open_alone(options: &mut OpenOptions, path: &Path) -> io::Result<File> {
    options.share_mode(FILE_SHARE_READ | FILE_SHARE_DELETE).open(path).map_err(|error| {
        if error.raw_os_error() == Some(SHARING_VIOLATION) {
            io::ErrorKind::ResourceBusy.into()
        } else {
            error
        }
    })
}

/// A folder that nobody else locks as long as it is open; files in it come and go, and it may be removed.
pub(crate) fn lock_folder(folder: &Path) -> Result<File, TryLockError> {
    let mut options = OpenOptions::new();
    options.read(true).write(true).custom_flags(FILE_FLAG_BACKUP_SEMANTICS);
    open_alone(&mut options, folder).map_err(|error| match error.kind() {
        io::ErrorKind::ResourceBusy => TryLockError::WouldBlock,
        _ => TryLockError::Error(error),
    })
}

/// The whole path, behind all links, as people write it: without `\\?\` where it is short enough for every program.
pub fn canonical(path: &Path) -> io::Result<PathBuf> {
    const MAX_PATH: usize = 260;
    let whole = fs::canonicalize(path)?;
    let plain = whole.to_str().and_then(|text| text.strip_prefix(r"\\?\"));
    let plain = plain.filter(|text| text.as_bytes().get(1) == Some(&b':') && text.len() < MAX_PATH);
    Ok(plain.map_or_else(|| whole.clone(), PathBuf::from))
}

/// An error with what a person can do about it, where another program is the reason.
pub(crate) fn explained(error: io::Error) -> io::Error {
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
    fs::rename(from, to).map_err(explained)
}
