//! File URIs (RFC 8089) for `fmuResourceLocation`.

use std::path::Path;

use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};

/// Everything outside RFC 3986's unreserved set and the slash.
const RESERVED: &AsciiSet =
    &NON_ALPHANUMERIC.remove(b'-').remove(b'.').remove(b'_').remove(b'~').remove(b'/');

/// `file:///…` for an absolute path, every byte outside RFC 3986's unreserved set percent-encoded; on Windows
/// `file:///C:/…`, and `file://server/share/…` (appendix E.3.1) for a folder of another computer.
pub fn file_uri(path: &Path) -> String {
    let path = path.to_string_lossy();
    if cfg!(windows) { windows_uri(&path) } else { format!("file://{}", encoded(&path)) }
}

fn encoded(path: &str) -> impl std::fmt::Display {
    utf8_percent_encode(path, RESERVED)
}

/// URI of a path of Windows. `\\?\`, which lifts the limit on its length, is not part of it.
fn windows_uri(path: &str) -> String {
    let path = path.replace('\\', "/");
    let path = match path.strip_prefix("//?/") {
        Some(rest) => rest.strip_prefix("UNC/").map_or(rest.to_owned(), |share| format!("//{share}")),
        None => path,
    };
    match path.strip_prefix("//") {
        Some(share) => format!("file://{}", encoded(share)),
        None => {
            // The colon of a drive stays.
            let (drive, rest) = path.split_at(if path.as_bytes().get(1) == Some(&b':') { 2 } else { 0 });
            format!("file:///{drive}{}", encoded(rest))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reserved_bytes_are_encoded() {
        let encoded = "a%20b/50%25%2B%7Bx%7D/%C3%A9%23%3F";
        if cfg!(unix) {
            assert_eq!(file_uri(Path::new("/a b/50%+{x}/é#?")), format!("file:///{encoded}"));
            assert_eq!(file_uri(Path::new("/C:/a\\b")), "file:///C%3A/a%5Cb");
        }
        assert_eq!(windows_uri("C:\\a b\\50%+{x}/é#?"), format!("file:///C:/{encoded}"));
    }

    #[test]
    fn drives_and_shares_of_windows() {
        for (path, uri) in [
            ("C:\\fmu\\r", "file:///C:/fmu/r"),
            ("\\\\server\\my share\\r", "file://server/my%20share/r"),
            ("//server/share/r", "file://server/share/r"),
            ("\\\\?\\C:\\fmu\\r", "file:///C:/fmu/r"),
            ("\\\\?\\UNC\\server\\share\\r", "file://server/share/r"),
        ] {
            assert_eq!(windows_uri(path), uri);
        }
    }
}
