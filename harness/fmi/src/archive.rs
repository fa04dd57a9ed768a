//! Unpacks an `.fmu` into a folder without trusting it.

use std::{
    collections::BTreeSet,
    fs::{self, File},
    io::{self, Read, Seek, SeekFrom, Write},
    path::{Component, Path, PathBuf},
};

use model_description::MAX_BYTES;
use zip::ZipArchive;

use crate::{Error, foreign};

/// How much an archive may hold.
#[derive(Clone, Copy, Debug)]
pub struct ArchiveLimits {
    /// Entries, folders included.
    pub entries: usize,
    /// Bytes of all unpacked files together.
    pub total_bytes: u64,
    /// Bytes of an XML file in the archive's root.
    pub description_bytes: u64,
}

impl Default for ArchiveLimits {
    /// 10,000 entries and 4 GiB: far above any sane FMU, far below a full disk.
    fn default() -> Self {
        Self { entries: 10_000, total_bytes: 4 << 30, description_bytes: MAX_BYTES as u64 }
    }
}

/// Unpacks `archive` into the existing folder `into`.
///
/// Refused: a path that is absolute, leaves the folder or has a drive or backslash root; a symbolic link; an
/// encrypted entry; the same path twice; more entries or bytes than `limits` by the archive's own list, before
/// anything is unpacked; an entry that holds more than the list says; a damaged or corrupted archive.
///
/// Gives the paths of the entries as the archive writes them.
pub fn unpack(archive: &Path, into: &Path, limits: ArchiveLimits) -> Result<Vec<String>, Error> {
    let refuse = |what: String| Error::Archive { path: archive.to_owned(), what };
    let file = files::open(archive).map_err(Error::file(archive))?;
    let mut zip = ZipArchive::new(io::BufReader::new(file))
        .map_err(|error| refuse(foreign::kind(archive).map_or_else(|| error.to_string(), str::to_owned)))?;
    if zip.len() > limits.entries {
        return Err(refuse(format!("{} entries, at most {} are allowed", zip.len(), limits.entries)));
    }
    if let Some(name) = listed_twice(archive, zip.central_directory_start()) {
        return Err(refuse(format!("entry {name:?} stands twice in the archive")));
    }
    let mut total_bytes = 0;
    for index in 0..zip.len() {
        let entry = zip.by_index_raw(index).map_err(|error| refuse(error.to_string()))?;
        let (name, bytes) = (String::from_utf8_lossy(entry.name_raw()).into_owned(), entry.size());
        if bytes > limits.description_bytes && is_description(&name) {
            let most = limits.description_bytes;
            return Err(refuse(format!("{name} unpacks to {bytes} bytes, at most {most} are allowed")));
        }
        total_bytes = bytes.saturating_add(total_bytes);
        if total_bytes > limits.total_bytes {
            let most = limits.total_bytes;
            return Err(refuse(format!("unpacks to more than {most} bytes at entry {name:?}")));
        }
    }
    let mut names = Vec::with_capacity(zip.len());
    for index in 0..zip.len() {
        let mut entry = zip.by_index(index).map_err(|error| refuse(error.to_string()))?;
        let name = String::from_utf8_lossy(entry.name_raw()).into_owned();
        if entry.is_symlink() {
            return Err(refuse(format!("entry {name:?} is a symbolic link")));
        }
        if entry.encrypted() {
            return Err(refuse(format!("entry {name:?} is encrypted")));
        }
        // Some Windows packers write backslashes; they mean the same folders.
        let relative =
            path_inside(&name).ok_or_else(|| refuse(format!("entry {name:?} leaves the folder")))?;
        let target = into.join(&relative);
        let at_target = Error::file(&target);
        if entry.is_dir() || name.ends_with('\\') {
            fs::create_dir_all(&target).map_err(&at_target)?;
            names.push(name);
            continue;
        }
        if let Some(parent) = target.parent() {
            fs::create_dir_all(parent).map_err(&at_target)?;
        }
        let mut output = File::create_new(&target).map_err(|source| match source.kind() {
            io::ErrorKind::AlreadyExists => refuse(format!("entry {name:?} stands twice in the archive")),
            _ => at_target(source),
        })?;
        let listed = entry.size();
        let written = copy(&mut entry.by_ref().take(listed.saturating_add(1)), &mut output).map_err(
            |error| match error {
                CopyError::Read(error) => refuse(format!("entry {name:?}: {error}")),
                CopyError::Write(source) => at_target(source),
            },
        )?;
        if written > listed {
            return Err(refuse(format!(
                "entry {name:?} unpacks to more than the {listed} bytes it is listed with"
            )));
        }
        names.push(name);
    }
    Ok(names)
}

/// The first name that the archive's own list has twice: the reader's has it once, with the later content.
fn listed_twice(archive: &Path, list_begins: u64) -> Option<String> {
    /// Signature, length, and places of the lengths of name, extra field and comment of an entry of the list.
    const SIGNATURE: &[u8] = b"PK\x01\x02";
    const LENGTH: usize = 46;
    const LENGTHS: [usize; 3] = [28, 30, 32];
    let mut list = io::BufReader::new(files::open(archive).ok()?);
    list.seek(SeekFrom::Start(list_begins)).ok()?;
    let (mut head, mut known) = ([0; LENGTH], BTreeSet::new());
    while list.read_exact(&mut head).is_ok() && head.starts_with(SIGNATURE) {
        let [name, extra, comment] = LENGTHS.map(|at| u16::from_le_bytes([head[at], head[at + 1]]));
        let mut bytes = vec![0; usize::from(name)];
        list.read_exact(&mut bytes).ok()?;
        list.seek_relative(i64::from(extra) + i64::from(comment)).ok()?;
        if let Some(twice) = known.replace(bytes) {
            return Some(String::from_utf8_lossy(&twice).into_owned());
        }
    }
    None
}

/// Whether an entry is read as XML whole: the description of an FMU or of a system, or what lies beside it.
fn is_description(name: &str) -> bool {
    let endings = [".xml", ".ssd", ".ssv"];
    endings.iter().any(|ending| name.to_ascii_lowercase().ends_with(ending))
}

/// Side of a copy that failed: a damaged archive is not a full disk.
enum CopyError {
    Read(io::Error),
    Write(io::Error),
}

/// Bytes copied, all there are.
fn copy(from: &mut impl Read, to: &mut impl Write) -> Result<u64, CopyError> {
    let mut block = vec![0; 1 << 16];
    let mut copied = 0;
    loop {
        let count = match from.read(&mut block) {
            Ok(0) => return Ok(copied),
            Ok(count) => count,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(error) => return Err(CopyError::Read(error)),
        };
        to.write_all(&block[..count]).map_err(CopyError::Write)?;
        copied += count as u64;
    }
}

/// A path below a folder, or `None` if it leaves it.
pub fn path_inside(name: &str) -> Option<PathBuf> {
    if name.contains('\0') {
        return None;
    }
    let name = name.replace('\\', "/");
    let mut path = PathBuf::new();
    for (position, part) in name.split('/').enumerate() {
        // An empty first part is an absolute path, a colon a Windows drive or stream; `..` is found below.
        if (part.is_empty() && position == 0) || part.contains(':') {
            return None;
        }
        if !part.is_empty() && part != "." {
            path.push(part);
        }
    }
    let plain = path.components().all(|part| matches!(part, Component::Normal(_)));
    (plain && path.components().next().is_some()).then_some(path)
}

#[cfg(test)]
mod tests {
    //! A full disk is reported as such, not as a damaged archive.

    use super::*;

    struct Full;

    impl Write for Full {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(io::ErrorKind::StorageFull.into())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn what_cannot_be_written_is_no_fault_of_the_archive() {
        let outcome = copy(&mut io::repeat(1).take(10), &mut Full);
        assert!(
            matches!(outcome, Err(CopyError::Write(error)) if error.kind() == io::ErrorKind::StorageFull)
        );
        let mut all = Vec::new();
        assert_eq!(copy(&mut io::repeat(1).take(200_000), &mut all).ok(), Some(200_000));
        assert_eq!(all.len(), 200_000);
    }
}
