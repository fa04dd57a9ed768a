//! Files to write, checked before the work whose result they take.

use std::{
    ffi::OsString,
    fs::{self, File, OpenOptions},
    io::{self, BufWriter, Seek, Write},
    path::{Path, PathBuf},
};

use tempfile::NamedTempFile;

use crate::{input::kind, system, temporary::Registered};

/// The name that stands for the standard output, and the system's own for it.
const STDOUT: &str = "-";
const SYSTEM_STDOUT: [&str; 3] = ["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"];

/// A file that can be written. Until its new content is complete, what stood in it stays.
#[derive(Debug)]
pub struct Destination {
    path: PathBuf,
    option: &'static str,
    // Behind all symbolic links; `None` is the standard output.
    target: Option<PathBuf>,
}

impl Destination {
    /// Looks at the file that `option` names; `-` is the standard output, and so are the system's names for it. Refused: what is no regular file, what
    /// cannot be written, and what is one of `inputs` (files, or folders with all that is in them), under whatever
    /// name. Folders are not created.
    pub fn open(path: &Path, option: &'static str, inputs: &[&Path]) -> Result<Self, String> {
        if path == Path::new(STDOUT) || cfg!(unix) && SYSTEM_STDOUT.iter().any(|name| path == Path::new(name))
        {
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
        self.replace(write).map_err(|error| self.message(&error))
    }

    /// Takes a recording in progress: it grows as `<name>.part`, on the standard output as it is.
    ///
    /// A `.part` of an earlier recording is replaced once there is something to write; that of one in progress, of any program, is
    /// refused.
    pub fn grow(self, inputs: &[&Path]) -> Result<Growing, String> {
        let part = self.target.as_deref().map(part_of).map(|path| {
            Part::open(&path, inputs)
                .map_err(|what| format!("{}: {what}: see {}", path.display(), self.option))
        });
        Ok(Growing { part: part.transpose()?, destination: self, lost_reader: false })
    }

    fn replace(&self, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
        let Some(target) = &self.target else {
            let mut out = BufWriter::new(terminal::Output);
            return gone_reader_is_no_error(write(&mut out).and_then(|()| out.flush()));
        };
        let (temporary, _registered) = self.temporary()?;
        let mut buffered = BufWriter::new(temporary.as_file());
        write(&mut buffered)?;
        buffered.flush()?;
        drop(buffered);
        keep_permissions(temporary.as_file(), target)?;
        let temporary = temporary.into_temp_path().keep()?;
        system::rename(&temporary, target).inspect_err(|_| {
            let _ = fs::remove_file(&temporary);
        })
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

    fn message(&self, error: &io::Error) -> String {
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
    /// Appends these bytes at once.
    pub fn append(&mut self, bytes: &[u8]) -> Result<(), String> {
        let Some(part) = &mut self.part else {
            let mut out = terminal::Output;
            let written = out.write_all(bytes).and_then(|()| out.flush());
            self.lost_reader |= matches!(&written, Err(error) if error.kind() == io::ErrorKind::BrokenPipe);
            return gone_reader_is_no_error(written).map_err(|error| self.destination.message(&error));
        };
        part.append(bytes)
            .map_err(|error| format!("{}: {error}: see {}", part.path.display(), self.destination.option))
    }

    /// Continues with what a recording before left, of which the first bytes are kept; on the standard output there is none.
    pub fn keep(&mut self, bytes: u64) -> Result<(), String> {
        let Some(part) = &mut self.part else { return Ok(()) };
        part.keep(bytes)
            .map_err(|error| format!("{}: {error}: see {}", part.path.display(), self.destination.option))
    }

    /// Whether the reader of the standard output went away: what is appended then goes nowhere.
    pub fn has_lost_reader(&self) -> bool {
        self.lost_reader
    }

    /// The file that would be replaced; `None` where there is none yet.
    pub fn existing(&self) -> Option<&Path> {
        self.destination.existing()
    }

    /// Gives the complete recording its name.
    pub fn finish(mut self) -> Result<(), String> {
        self.rename().map_err(|error| self.destination.message(&error))
    }

    /// Leaves what was recorded as it is and gives its path, if anything was.
    pub fn leave(self) -> Option<PathBuf> {
        self.part.filter(|part| part.is_begun).map(|part| part.path.clone())
    }

    fn rename(&mut self) -> io::Result<()> {
        let (Some(part), Some(target)) = (&mut self.part, &self.destination.target) else { return Ok(()) };
        part.append(&[])?;
        keep_permissions(&part.file, target)?;
        system::rename(&part.path, target)
    }
}

/// The file of a recording in progress, locked against others as long as it is open.
#[derive(Debug)]
struct Part {
    path: PathBuf,
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
    fn open(path: &Path, inputs: &[&Path]) -> Result<Self, String> {
        let text = |error: io::Error| match error.kind() {
            io::ErrorKind::ResourceBusy => "another run is writing it".to_owned(),
            _ => error.to_string(),
        };
        for _ in 0..Self::ATTEMPTS {
            check_place(path, inputs)?;
            let (file, is_new) =
                match system::open_exclusively(OpenOptions::new().write(true).create_new(true), path) {
                    Ok(file) => (file, true),
                    Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                        match system::open_exclusively(OpenOptions::new().write(true), path) {
                            Ok(file) => (file, false),
                            Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
                            Err(error) => return Err(text(error)),
                        }
                    }
                    Err(error) => return Err(text(error)),
                };
            // Until it was locked, another run may have given it its name, and a link may lead elsewhere.
            if is_at(&file, path) {
                return Ok(Self { path: path.to_owned(), file, is_new, is_begun: false });
            }
            if has_other_names(&file) {
                fs::remove_file(path).map_err(text)?;
            }
        }
        Err("others take it away again and again".to_owned())
    }

    fn keep(&mut self, bytes: u64) -> io::Result<()> {
        self.file.set_len(bytes)?;
        self.file.seek(io::SeekFrom::End(0))?;
        self.is_begun = true;
        Ok(())
    }

    fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        if !self.is_begun {
            self.file.set_len(0)?;
            self.is_begun = true;
        }
        self.file.write_all(bytes)
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

/// Why a file cannot be the target whoever writes it: it is of another kind or an input.
fn check_place(target: &Path, inputs: &[&Path]) -> Result<(), String> {
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

/// Where the recording of a file in progress grows.
pub fn part_of(target: &Path) -> PathBuf {
    with_ending(target, ".part")
}

/// The file beside a table that tells of it.
pub fn sidecar_of(table: &Path) -> PathBuf {
    with_ending(table, ".toml")
}

fn with_ending(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(ending);
    PathBuf::from(name)
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// The path behind symbolic links, also where the last one leads to nothing yet.
fn behind_links(path: &Path) -> io::Result<PathBuf> {
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
fn is_beside(one: &Path, two: &Path) -> bool {
    let whole = |path: &Path| Some((fs::canonicalize(folder_of(path)).ok()?, path.file_name()?.to_owned()));
    whole(one).is_some_and(|place| whole(two) == Some(place))
}

/// Whether both exist and are one file.
fn is_one_file(one: &Path, two: &Path) -> bool {
    let (Ok(one), Ok(two)) = (system::identity(one), system::identity(two)) else { return false };
    one.device_and_inode == two.device_and_inode
}

/// Whether a file is one of a folder's files, or would become one.
fn is_inside(target: &Path, folder: &Path) -> bool {
    let is_folder = fs::metadata(folder).is_ok_and(|metadata| metadata.is_dir());
    is_folder
        && fs::canonicalize(folder_of(target))
            .is_ok_and(|place| fs::canonicalize(folder).is_ok_and(|folder| place.starts_with(folder)))
}

fn keep_permissions(file: &File, target: &Path) -> io::Result<()> {
    match fs::metadata(target) {
        Ok(metadata) => file.set_permissions(metadata.permissions()),
        Err(_) => Ok(()),
    }
}

fn gone_reader_is_no_error(outcome: io::Result<()>) -> io::Result<()> {
    match outcome {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        other => other,
    }
}

#[cfg(test)]
mod tests;
