//! Kind of a file that was given for an FMU but is no ZIP archive, by its first bytes.

use std::{io::Read, path::Path};

/// Bytes looked at.
const BYTES: u64 = 4096;

/// First bytes of ELF, of Windows and of Mach-O (64 bits, 32 bits, and both in one file).
const LIBRARIES: [&[u8]; 5] =
    [b"\x7fELF", b"MZ", b"\xcf\xfa\xed\xfe", b"\xce\xfa\xed\xfe", b"\xca\xfe\xba\xbe"];

/// Returns the kind of a file and what to do with it; `None` for a ZIP archive and what is not recognised.
pub(crate) fn kind(path: &Path) -> Option<&'static str> {
    let mut bytes = Vec::new();
    files::open(path).ok()?.take(BYTES).read_to_end(&mut bytes).ok()?;
    if bytes.is_empty() {
        return Some("it is an empty file");
    }
    if bytes.starts_with(b"PK") {
        return None;
    }
    if LIBRARIES.iter().any(|magic| bytes.starts_with(magic)) {
        return Some("it is a shared library or a program: see `heliotorque pack --library`");
    }
    let is_tar = bytes.get(257..262) == Some(b"ustar");
    if is_tar || bytes.starts_with(b"\x1f\x8b") || bytes.starts_with(b"7z\xbc\xaf") {
        return Some("it is an archive of another kind, allowed: a ZIP archive");
    }
    let text = match std::str::from_utf8(&bytes) {
        Ok(text) => text,
        // The last letter is cut where the bytes end.
        Err(error) if error.error_len().is_none() => {
            std::str::from_utf8(&bytes[..error.valid_up_to()]).ok()?
        }
        Err(_) => return None,
    };
    let text = text.trim_start_matches('\u{feff}').trim_start();
    if text.starts_with('<') {
        return Some("it is an XML file, allowed: a ZIP archive with a modelDescription.xml in it");
    }
    if path.extension().is_some_and(|it| it == "toml") || text.lines().find_map(is_toml) == Some(true) {
        return Some("it is a TOML file: see `heliotorque check` and `heliotorque pack`");
    }
    Some("it is a text file, allowed: a ZIP archive")
}

/// Whether the first line that says something is a table's head or sets a key.
fn is_toml(line: &str) -> Option<bool> {
    let line = line.trim();
    if line.is_empty() || line.starts_with('#') {
        return None;
    }
    let is_key = |key: &str| {
        let key = key.trim().trim_matches('"');
        !key.is_empty()
            && key.chars().all(|letter| letter.is_ascii_alphanumeric() || matches!(letter, '_' | '-' | '.'))
    };
    let is_table = line.starts_with('[') && line.contains(']');
    Some(is_table || line.split_once('=').is_some_and(|(key, _)| is_key(key)))
}
