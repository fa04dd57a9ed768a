//! Inputs: regular files only, so that nothing waits for a FIFO or reads a device without end.

use std::{
    fs::{File, Metadata},
    io::{self, Read},
    path::Path,
};

/// Returns the kind of a file that is no regular file; `None` for a regular file.
pub fn kind(metadata: &Metadata) -> Option<&'static str> {
    let kind = metadata.file_type();
    if kind.is_file() {
        return None;
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        let kinds = [
            (kind.is_fifo(), "a FIFO"),
            (kind.is_char_device(), "a character device"),
            (kind.is_block_device(), "a block device"),
            (kind.is_socket(), "a socket"),
        ];
        if let Some((_, name)) = kinds.into_iter().find(|(is, _)| *is) {
            return Some(name);
        }
    }
    Some(if kind.is_dir() { "a directory" } else { "no regular file" })
}

/// Opens a regular file for reading; anything else is an error that names what was found.
pub fn open(path: &Path) -> io::Result<File> {
    // Looked at before it is opened: opening a FIFO waits for its writer.
    refuse(&std::fs::metadata(path)?)?;
    let file = File::open(path)?;
    refuse(&file.metadata()?)?;
    Ok(file)
}

/// Names of what a folder holds, in their order; none where it cannot be read.
pub fn names_in(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<String> =
        entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// Longest text that [`read_text`] takes, in bytes: that of the TOML files.
pub const MAX_TEXT_BYTES: u64 = 4 << 20;
/// Largest table of numbers that is read, in bytes.
pub const MAX_TABLE_BYTES: u64 = 64 << 20;

/// First bytes of a ZIP archive.
const ZIP: &[u8] = b"PK\x03\x04";

/// Reads a regular file whole.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    read_at_most(path, u64::MAX)
}

/// Reads a regular file of at most `most_bytes`; a larger one is refused before it is read.
pub fn read_at_most(path: &Path, most_bytes: u64) -> io::Result<Vec<u8>> {
    let file = open_at_most(path, most_bytes)?;
    let mut bytes = Vec::new();
    // It may grow while it is read.
    if file.take(most_bytes.saturating_add(1)).read_to_end(&mut bytes)? as u64 > most_bytes {
        return Err(too_large("more", most_bytes));
    }
    Ok(bytes)
}

/// Opens a regular file of at most `most_bytes` for reading.
pub fn open_at_most(path: &Path, most_bytes: u64) -> io::Result<File> {
    let file = open(path)?;
    let found = file.metadata()?.len();
    if found > most_bytes { Err(too_large(found, most_bytes)) } else { Ok(file) }
}

fn too_large(found: impl std::fmt::Display, most_bytes: u64) -> io::Error {
    io::Error::other(format!("found {found} bytes, allowed: at most {most_bytes}"))
}

/// Reads a text file; the error names the file, and what it is instead or the line that is not UTF-8.
pub fn read_text(path: &Path) -> Result<String, String> {
    let no_text = |found: &str| format!("{}: found {found}, allowed: a text saved as UTF-8", path.display());
    let mut head = Vec::new();
    let read = open(path).and_then(|file| file.take(ZIP.len() as u64).read_to_end(&mut head));
    // Before its size is reported: that is no text's.
    if read.is_ok() && head == ZIP {
        return Err(no_text("a ZIP archive, as FMUs and systems are"));
    }
    let bytes = read_at_most(path, MAX_TEXT_BYTES).map_err(|error| format!("{}: {error}", path.display()))?;
    let is_utf_16 = matches!(bytes.as_slice(), [0xff, 0xfe, ..] | [0xfe, 0xff, ..]);
    if !is_utf_16 && bytes.contains(&0) {
        return Err(no_text("a binary file"));
    }
    String::from_utf8(bytes).map_err(|error| {
        let good = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + good.iter().filter(|byte| **byte == b'\n').count();
        let found = match error.as_bytes() {
            [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => " (it is UTF-16)",
            _ => "",
        };
        format!("{}: line {line} is not UTF-8{found}, allowed: a text saved as UTF-8", path.display())
    })
}

fn refuse(metadata: &Metadata) -> io::Result<()> {
    match kind(metadata) {
        None => Ok(()),
        Some(found) => Err(io::Error::other(format!("found {found}, allowed: a regular file"))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_text_is_named() {
        let scratch = tempfile::tempdir().unwrap();
        let file = scratch.path().join("file");
        for (bytes, found) in [
            (&b"PK\x03\x04rest"[..], "a ZIP archive"),
            (b"a\0b", "a binary file"),
            (b"\xff\xfea\0", "line 1 is not UTF-8 (it is UTF-16)"),
        ] {
            std::fs::write(&file, bytes).unwrap();
            let refused = read_text(&file).unwrap_err();
            assert!(
                refused.contains(found) && refused.contains("allowed: a text saved as UTF-8"),
                "{refused}"
            );
        }
    }

    #[test]
    fn only_regular_files_are_read() {
        let scratch = tempfile::tempdir().unwrap();
        let file = scratch.path().join("file");
        std::fs::write(&file, "text").unwrap();
        assert_eq!(read(&file).unwrap(), b"text");
        assert!(read(scratch.path()).unwrap_err().to_string().contains("a directory"));
        assert_eq!(read(&scratch.path().join("none")).unwrap_err().kind(), io::ErrorKind::NotFound);
        #[cfg(unix)]
        assert!(read(Path::new("/dev/null")).unwrap_err().to_string().contains("a character device"));
    }
}
