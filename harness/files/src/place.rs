//! Files by their identity behind links: whether one may be written, and what it is beside.

use std::{
    fs::{self, File},
    io,
    path::{Path, PathBuf},
};

use crate::{input::kind, paths::folder_of, system};

/// Refuses a target that no program may write: a file of another kind, or an input.
pub(crate) fn check_place(target: &Path, inputs: &[&Path]) -> Result<(), String> {
    let metadata = match fs::symlink_metadata(target) {
        Ok(metadata) => Some(metadata),
        Err(error) if error.kind() == io::ErrorKind::NotFound => None,
        Err(error) => return Err(error.to_string()),
    };
    if let Some(found) = metadata.as_ref().and_then(kind) {
        return Err(format!("found {found}, allowed: a regular file or - for the standard output"));
    }
    for input in inputs {
        if is_one_file(target, input) || is_inside(target, input) {
            return Err(format!("it is an input too, {}", input.display()));
        }
    }
    Ok(())
}

/// The path behind symbolic links, also where the last one leads to nothing yet.
pub(crate) fn behind_links(path: &Path) -> io::Result<PathBuf> {
    const LINKS: usize = 40;
    let mut path = path.to_owned();
    for _ in 0..LINKS {
        match fs::symlink_metadata(&path) {
            Ok(metadata) if metadata.is_symlink() => path = folder_of(&path).join(fs::read_link(&path)?),
            _ => return Ok(path),
        }
    }
    Err(io::Error::other("too many symbolic links"))
}

/// Whether two new files in existing folders have one path.
pub(crate) fn is_beside(one: &Path, two: &Path) -> bool {
    let whole = |path: &Path| Some((fs::canonicalize(folder_of(path)).ok()?, path.file_name()?.to_owned()));
    whole(one).is_some_and(|place| whole(two) == Some(place))
}

/// Whether both exist and are one file.
pub(crate) fn is_one_file(one: &Path, two: &Path) -> bool {
    let (Ok(one), Ok(two)) = (system::identity(one), system::identity(two)) else { return false };
    one.device_and_inode == two.device_and_inode
}

/// Whether a file is one of a folder's files, or would become one.
pub(crate) fn is_inside(target: &Path, folder: &Path) -> bool {
    let is_folder = fs::metadata(folder).is_ok_and(|metadata| metadata.is_dir());
    is_folder
        && fs::canonicalize(folder_of(target))
            .is_ok_and(|place| fs::canonicalize(folder).is_ok_and(|folder| place.starts_with(folder)))
}

pub(crate) fn keep_permissions(file: &File, target: &Path) -> io::Result<()> {
    match fs::metadata(target) {
        Ok(metadata) => file.set_permissions(metadata.permissions()),
        Err(_) => Ok(()),
    }
}
