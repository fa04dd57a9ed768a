//! Files to write, opened before the work whose result they take.

use std::{
    fs::{self, File, OpenOptions},
    io::{self, BufWriter, Write},
    path::{Path, PathBuf},
};

/// A file that can be written. Until it is, what stood in it stays; a new one goes away again with this value.
pub struct Destination {
    path: PathBuf,
    option: &'static str,
    file: File,
    is_new: bool,
}

impl Destination {
    /// Opens the file that `option` names. Folders are not created.
    pub fn open(path: &Path, option: &'static str) -> Result<Self, String> {
        if let Some(folder) =
            path.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.exists())
        {
            let (path, folder) = (path.display(), folder.display());
            return Err(format!("{path}: there is no folder {folder}, and none is created: see {option}"));
        }
        let is_new = !path.exists();
        let file = OpenOptions::new().write(true).create(true).truncate(false).open(path);
        let file = file.map_err(|error| told(path, &error, option))?;
        Ok(Self { path: path.to_owned(), option, file, is_new })
    }

    /// Replaces the content by what `write` writes.
    pub fn fill(mut self, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), String> {
        self.is_new = false;
        self.replace(write).map_err(|error| told(&self.path, &error, self.option))
    }

    fn replace(&mut self, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
        // Pipes and terminals have no length.
        if self.file.metadata()?.is_file() {
            self.file.set_len(0)?;
        }
        let mut buffered = BufWriter::new(&self.file);
        write(&mut buffered)?;
        buffered.flush()
    }
}

impl Drop for Destination {
    fn drop(&mut self) {
        if self.is_new {
            // Somebody may have taken it away.
            let _ = fs::remove_file(&self.path);
        }
    }
}

fn told(path: &Path, error: &io::Error, option: &str) -> String {
    format!("{}: {error}: see {option}", path.display())
}

#[cfg(test)]
mod tests {
    //! Content changes only when it is replaced, and nothing empty stays behind.

    use super::*;

    #[test]
    fn an_unused_destination_leaves_no_trace() {
        let room = tempfile::tempdir().unwrap();
        let (new, old) = (room.path().join("new"), room.path().join("old"));
        fs::write(&old, "precious").unwrap();
        for path in [&new, &old] {
            drop(Destination::open(path, "--output").unwrap());
        }
        assert!(!new.exists());
        assert_eq!(fs::read_to_string(&old).unwrap(), "precious");
    }

    #[test]
    fn a_filled_destination_holds_the_new_content_only() {
        let room = tempfile::tempdir().unwrap();
        let (new, old) = (room.path().join("new"), room.path().join("old"));
        fs::write(&old, "precious").unwrap();
        for path in [&new, &old] {
            Destination::open(path, "--output").unwrap().fill(|file| file.write_all(b"ours")).unwrap();
            assert_eq!(fs::read_to_string(path).unwrap(), "ours");
        }
    }

    #[test]
    fn what_cannot_be_written_is_told_with_its_option() {
        let room = tempfile::tempdir().unwrap();
        let told = |path: &Path| Destination::open(path, "--plot").err().unwrap();
        let folder = told(&room.path().join("no/such/a.svg"));
        assert!(folder.contains("there is no folder") && folder.ends_with("see --plot"), "{folder}");
        assert!(told(room.path()).ends_with("see --plot"));
    }
}
