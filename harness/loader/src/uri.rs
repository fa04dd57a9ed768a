//! File URIs (RFC 8089) for `fmuResourceLocation`.

use std::path::Path;

/// `file:///…` for an absolute path, every byte outside RFC 3986's unreserved set percent-encoded.
pub fn file_uri(path: &Path) -> String {
    let text = path.to_string_lossy().replace('\\', "/");
    let mut uri = String::from(if text.starts_with('/') { "file://" } else { "file:///" });
    let drive_colon = text.as_bytes().get(1) == Some(&b':');
    for (position, byte) in text.bytes().enumerate() {
        let plain =
            byte.is_ascii_alphanumeric() || b"-._~/".contains(&byte) || (drive_colon && position == 1);
        if plain {
            uri.push(char::from(byte));
        } else {
            uri.push_str(&format!("%{byte:02X}"));
        }
    }
    uri
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
