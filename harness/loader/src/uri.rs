//! File URIs (RFC 8089) for `fmuResourceLocation`.

use std::path::Path;

use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};

/// Everything outside RFC 3986's unreserved set and the slash.
const RESERVED: &AsciiSet =
    &NON_ALPHANUMERIC.remove(b'-').remove(b'.').remove(b'_').remove(b'~').remove(b'/');

/// `file:///…` for an absolute path, every byte outside RFC 3986's unreserved set percent-encoded.
pub fn file_uri(path: &Path) -> String {
    let text = path.to_string_lossy().replace('\\', "/");
    // The colon of a drive stays.
    let drive = if text.as_bytes().get(1) == Some(&b':') { 2 } else { 0 };
    let (drive, rest) = text.split_at(drive);
    let slashes = if text.starts_with('/') { "//" } else { "///" };
    format!("file:{slashes}{drive}{}", utf8_percent_encode(rest, RESERVED))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reserved_bytes_are_encoded() {
        assert_eq!(file_uri(Path::new("/a b/50%+{x}/é#?")), "file:///a%20b/50%25%2B%7Bx%7D/%C3%A9%23%3F");
        assert_eq!(file_uri(Path::new("C:\\fmu\\r")), "file:///C:/fmu/r");
    }
}
