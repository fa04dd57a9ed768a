//! Files to write, checked before the work whose result they take.

use std::{
    ffi::OsString,
    fs::{self, OpenOptions},
    io::{self, BufWriter, Write},
    path::{Path, PathBuf},
};

use tempfile::NamedTempFile;

use crate::{
    part::Part,
    paths::{folder_of, part_of},
    place::{behind_links, check_place, is_beside, is_inside, is_one_file, keep_permissions},
    system,
    temporary::Registered,
};

/// The name that stands for the standard output, and the system's own for it.
const STDOUT: &str = "-";
const SYSTEM_STDOUT: [&str; 3] = ["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"];

/// Whether a path is `-` or one of the system's names for the standard output.
pub fn is_stdout(path: &Path) -> bool {
    path == Path::new(STDOUT) || cfg!(unix) && SYSTEM_STDOUT.iter().any(|name| path == Path::new(name))
}

/// A file that can be written. Until its new content is complete, what stood in it stays.
#[derive(Debug)]
pub struct Destination {
    path: PathBuf,
    pub(crate) option: &'static str,
    // Behind all symbolic links; `None` is the standard output.
    pub(crate) target: Option<PathBuf>,
}

impl Destination {
    /// Looks at the file that `option` names; `-` is the standard output, and so are the system's names for it. Refused: what is no regular file, what
    /// cannot be written, and what is one of `inputs` (files, or folders with all that is in them), under whatever
    /// name. Folders are not created.
    pub fn open(path: &Path, option: &'static str, inputs: &[&Path]) -> Result<Self, String> {
        if is_stdout(path) {
            return Ok(Self { path: path.to_owned(), option, target: None });
        }
        let refuse = |what: String| format!("{}: {what}: see {option}", path.display());
        let target = behind_links(path).map_err(|error| refuse(error.to_string()))?;
        let folder = folder_of(&target);
        if !folder.exists() {
            return Err(refuse(format!("there is no folder {}, and none is created", folder.display())));
        }
        check(&target, inputs).map_err(refuse)?;
        let destination = Self { path: path.to_owned(), option, target: Some(target) };
        // Its folder has to take a new file.
        destination.temporary().map_err(|error| destination.message(&error))?;
        Ok(destination)
    }

    /// As it was named.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether it is the standard output.
    pub fn is_stdout(&self) -> bool {
        self.target.is_none()
    }

    /// The file that would be replaced; `None` where there is none yet.
    pub fn existing(&self) -> Option<&Path> {
        self.target.as_deref().filter(|target| target.exists())
    }

    /// File that [`Destination::grow`] would record to; `None` on the standard output.
    pub fn part_path(&self) -> Option<PathBuf> {
        self.target.as_deref().map(part_of)
    }

    /// Whether it leads to a file in a folder or below, behind all links; the standard output is nowhere.
    pub fn is_within(&self, folder: &Path) -> bool {
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        self.target.as_deref().is_none_or(|target| is_inside(target, folder))
    }

    /// Whether both lead to one place.
    pub fn is_same(&self, other: &Self) -> bool {
        match (&self.target, &other.target) {
            (Some(one), Some(two)) => one == two || is_one_file(one, two) || is_beside(one, two),
            (None, None) => true,
            _ => false,
        }
    }

    /// Replaces the content by what `write` writes, all of it or nothing.
    pub fn fill(self, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), String> {
        self.replace(write, false).map_err(|error| self.message(&error))
    }

    /// The same; the new content takes its name once the disk has it.
    pub fn fill_durably(self, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), String> {
        self.replace(write, true).map_err(|error| self.message(&error))
    }

    /// Takes a recording in progress: it grows as `<name>.part`, on the standard output as it is.
    ///
    /// A `.part` of an earlier recording is replaced once there is something to write; that of one in progress, of any program, is
    /// refused.
    pub fn grow(self, inputs: &[&Path]) -> Result<Growing, String> {
        Ok(Growing::new(self.part(inputs)?, self))
    }

    /// Takes numbers in progress that the file is made of at the end: they stand in `<name>.part`, with the rules of [`Destination::grow`];
    /// `None` on the standard output.
    pub fn part(&self, inputs: &[&Path]) -> Result<Option<Part>, String> {
        self.target.as_deref().map(|target| Part::open(&part_of(target), self.option, inputs)).transpose()
    }

    fn replace(&self, write: impl FnOnce(&mut dyn Write) -> io::Result<()>, syncs: bool) -> io::Result<()> {
        let Some(target) = &self.target else {
            let mut out = BufWriter::new(terminal::Output);
            return gone_reader_is_no_error(write(&mut out).and_then(|()| out.flush()));
        };
        let (temporary, _registered) = self.temporary()?;
        let mut buffered = BufWriter::new(temporary.as_file());
        write(&mut buffered)?;
        buffered.flush()?;
        drop(buffered);
        if syncs {
            temporary.as_file().sync_all()?;
        }
        keep_permissions(temporary.as_file(), target)?;
        let temporary = temporary.into_temp_path().keep()?;
        system::rename(&temporary, target).inspect_err(|_| {
            let _ = fs::remove_file(&temporary);
        })?;
        if syncs {
            system::sync_folder_of(target);
        }
        Ok(())
    }

    /// A new file in the folder of the target.
    fn temporary(&self) -> io::Result<(NamedTempFile, Registered)> {
        let target = self.target.as_deref().unwrap_or(Path::new(STDOUT));
        let mut prefix = OsString::from(".");
        prefix.push(target.file_name().unwrap_or_default());
        prefix.push(".");
        let mut builder = tempfile::Builder::new();
        builder.prefix(&prefix).suffix(".tmp");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // What a program makes by default; the user's mask takes away from it.
            builder.permissions(fs::Permissions::from_mode(0o666));
        }
        Registered::with(|| builder.tempfile_in(folder_of(target)), NamedTempFile::path)
    }

    pub(crate) fn message(&self, error: &io::Error) -> String {
        format!("{}: {error}: see {}", self.path.display(), self.option)
    }
}

/// A recording in progress: whole rows in `<name>.part`, which takes its name when it is complete.
#[derive(Debug)]
pub struct Growing {
    destination: Destination,
    part: Option<Part>,
    lost_reader: bool,
}

impl Growing {
    fn new(part: Option<Part>, destination: Destination) -> Self {
        Self { destination, part, lost_reader: false }
    }

    /// Appends these bytes at once.
    pub fn append(&mut self, bytes: &[u8]) -> Result<(), String> {
        let Some(part) = &mut self.part else {
            let mut out = terminal::Output;
            let written = out.write_all(bytes).and_then(|()| out.flush());
            self.lost_reader |= matches!(&written, Err(error) if error.kind() == io::ErrorKind::BrokenPipe);
            return gone_reader_is_no_error(written).map_err(|error| self.destination.message(&error));
        };
        part.append(bytes).map_err(|error| part.message(&error))
    }

    /// Continues the recording of an earlier run and keeps its first bytes; on the standard output there is none.
    pub fn keep(&mut self, bytes: u64) -> Result<(), String> {
        let Some(part) = &mut self.part else { return Ok(()) };
        part.keep(bytes).map_err(|error| part.message(&error))
    }

    /// The whole content that a recording before left; nothing on the standard output.
    pub fn left(&mut self) -> Result<Vec<u8>, String> {
        let Some(part) = &mut self.part else { return Ok(Vec::new()) };
        part.content().map_err(|error| part.message(&error))
    }

    /// Whether the reader of the standard output went away: what is appended then goes nowhere.
    pub fn has_lost_reader(&self) -> bool {
        self.lost_reader
    }

    /// The file that would be replaced; `None` where there is none yet.
    pub fn existing(&self) -> Option<&Path> {
        self.destination.existing()
    }

    /// Gives the complete recording its name, once the disk has it.
    pub fn finish(mut self) -> Result<(), String> {
        self.rename().map_err(|error| self.destination.message(&error))
    }

    /// Leaves what was recorded as it is and gives its path, if anything was.
    pub fn leave(self) -> Option<PathBuf> {
        self.part.as_ref().and_then(Part::begun_path).map(Path::to_owned)
    }

    fn rename(&mut self) -> io::Result<()> {
        let (Some(part), Some(target)) = (&mut self.part, &self.destination.target) else { return Ok(()) };
        part.rename(target)
    }
}

/// Why a file cannot be the target: it is of another kind, not to be written, or an input.
fn check(target: &Path, inputs: &[&Path]) -> Result<(), String> {
    check_place(target, inputs)?;
    match OpenOptions::new().write(true).open(target) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => {
            // A file that is protected against writing is not replaced.
            Err(system::with_advice(error).to_string())
        }
        _ => Ok(()),
    }
}

pub(crate) fn gone_reader_is_no_error(outcome: io::Result<()>) -> io::Result<()> {
    match outcome {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        other => other,
    }
}

#[cfg(test)]
mod tests;
