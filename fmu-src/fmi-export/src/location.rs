//! From the importer's `fmuResourceLocation` to a folder, and from there to the texts of setup and schedule.
//!
//! Importers disagree on how to write a file URI (RFC 8089): `file:///a`, `file:/a`, `file://localhost/a`,
//! percent-encoded once, twice or not at all, or a plain path. Each reading is tried; the first that is a
//! folder is taken.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use percent_encoding::percent_decode;

/// No file is larger than this.
const MAX_BYTES: u64 = 64 << 20;

/// The folder a resource location means, `None` where that is empty: see [`beside_library`]. The error shows the location and
/// what is wrong with it.
pub(crate) fn resolve(location: &[u8]) -> Result<Option<PathBuf>, String> {
    if location.is_empty() {
        return Ok(None);
    }
    let candidates = paths(location, cfg!(windows))?;
    match candidates.iter().find(|path| path.is_dir()) {
        Some(folder) => Ok(Some(folder.clone())),
        None => Err(format!(
            "the resource location `{}` means the folder `{}`, which does not exist",
            String::from_utf8_lossy(location),
            candidates.first().map(|path| path.display().to_string()).unwrap_or_default()
        )),
    }
}

/// The folder `resources` of the unpacked FMU that this library lies in, `binaries/<platform>/`; `None` where the system does
/// not say where the library lies. Masters that leave the resource location out are answered from it.
pub(crate) fn beside_library() -> Option<PathBuf> {
    Some(own_path::of_library()?.parent()?.parent()?.parent()?.join("resources"))
}

/// The text of `file` in `folder`, if there is such a file.
pub(crate) fn read_if_there(folder: &Path, file: &str) -> Result<Option<String>, String> {
    // A link that leads nowhere is there.
    match std::fs::symlink_metadata(folder.join(file)) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
        _ => read(folder, file).map(Some),
    }
}

/// The text of `file` in `folder`.
pub(crate) fn read(folder: &Path, file: &str) -> Result<String, String> {
    let path = folder.join(file);
    // Opening a pipe waits until somebody writes to it.
    if std::fs::metadata(&path).is_ok_and(|found| !found.is_file()) {
        return Err(format!("`{}` is no regular file", path.display()));
    }
    let mut bytes = Vec::new();
    let read = File::open(&path).and_then(|opened| opened.take(MAX_BYTES + 1).read_to_end(&mut bytes));
    match read {
        Ok(count) if count as u64 > MAX_BYTES => {
            Err(format!("`{}` is larger than {MAX_BYTES} bytes", path.display()))
        }
        Ok(_) => String::from_utf8(bytes).map_err(|error| {
            let good = &error.as_bytes()[..error.utf8_error().valid_up_to()];
            let line = 1 + good.iter().filter(|byte| **byte == b'\n').count();
            format!("cannot read `{}`: line {line} is not UTF-8", path.display())
        }),
        Err(error) => Err(format!("cannot read `{}`: {error}", path.display())),
    }
}

/// Every reading of a location, the standard's first.
fn paths(location: &[u8], windows: bool) -> Result<Vec<PathBuf>, String> {
    let encoded = local_part(location, windows)?;
    // `%41` becomes `A`; `+` stays, and so does a `%` that two hexadecimal digits do not follow.
    let once: Vec<u8> = percent_decode(&encoded).collect();
    let twice = percent_decode(&once).collect();
    let mut found: Vec<PathBuf> = Vec::new();
    for reading in [once, encoded, twice] {
        if reading.contains(&0) {
            return Err(format!("the resource location `{}` holds a NUL", String::from_utf8_lossy(location)));
        }
        let path = to_path(without_drive_slash(reading, windows))?;
        if !found.contains(&path) {
            found.push(path);
        }
    }
    Ok(found)
}

/// The path part of a file URI, still encoded; a plain absolute path is its own.
fn local_part(location: &[u8], windows: bool) -> Result<Vec<u8>, String> {
    let shown = || String::from_utf8_lossy(location).into_owned();
    if is_plain_path(location, windows) {
        return Ok(location.to_vec());
    }
    let Some(rest) = strip_scheme(location) else {
        return Err(format!(
            "the resource location `{}` is no file URI (expected file:///path/to/resources)",
            shown()
        ));
    };
    let Some(after_slashes) = rest.strip_prefix(b"//") else {
        return Ok(rest.to_vec());
    };
    let end = after_slashes.iter().position(|&byte| byte == b'/').unwrap_or(after_slashes.len());
    let (host, path) = after_slashes.split_at(end);
    if host.is_empty() || host.eq_ignore_ascii_case(b"localhost") {
        Ok(path.to_vec())
    } else if windows && is_drive(host) {
        // file://C:/x, one slash short.
        Ok(after_slashes.to_vec())
    } else if windows {
        Ok([b"//", host, path].concat())
    } else {
        Err(format!(
            "the resource location `{}` names the host `{}`; only local folders can be read",
            shown(),
            String::from_utf8_lossy(host)
        ))
    }
}

fn is_plain_path(location: &[u8], windows: bool) -> bool {
    location.starts_with(b"/") || (windows && (location.starts_with(b"\\") || is_drive(location)))
}

fn is_drive(path: &[u8]) -> bool {
    matches!(path, [letter, b':', ..] if letter.is_ascii_alphabetic())
}

fn strip_scheme(location: &[u8]) -> Option<&[u8]> {
    let (scheme, rest) = location.split_at_checked(5)?;
    scheme.eq_ignore_ascii_case(b"file:").then_some(rest)
}

/// `/C:/x` becomes `C:/x` on Windows.
fn without_drive_slash(path: Vec<u8>, windows: bool) -> Vec<u8> {
    match path.as_slice() {
        [b'/', rest @ ..] if windows && is_drive(rest) => rest.to_vec(),
        _ => path,
    }
}

#[cfg(unix)]
fn to_path(bytes: Vec<u8>) -> Result<PathBuf, String> {
    use std::os::unix::ffi::OsStringExt;
    Ok(PathBuf::from(std::ffi::OsString::from_vec(bytes)))
}

#[cfg(not(unix))]
fn to_path(bytes: Vec<u8>) -> Result<PathBuf, String> {
    String::from_utf8(bytes)
        .map(PathBuf::from)
        .map_err(|error| format!("the resource location is not UTF-8: {error}"))
}

mod own_path;

#[cfg(test)]
mod tests;
