//! Archives that are the same, byte for byte, whenever their content is.

use std::{
    collections::BTreeMap,
    fs,
    io::{self, Cursor, Write},
    path::Path,
};

use zip::{CompressionMethod, DateTime, System, ZipWriter, result::ZipError, write::SimpleFileOptions};

/// The files of an archive, by path.
#[derive(Debug, Default)]
pub struct Entries(BTreeMap<String, Vec<u8>>);

impl Entries {
    /// Adds a file; `path` is relative with forward slashes.
    pub fn add(&mut self, path: &str, content: Vec<u8>) -> Result<(), String> {
        match self.0.insert(path.to_owned(), content) {
            None => Ok(()),
            Some(_) => Err(format!("{path} would stand twice in the archive")),
        }
    }

    /// Writes the files below an existing folder.
    ///
    /// # Errors
    /// What cannot be written.
    pub fn write_below(&self, folder: &Path) -> io::Result<()> {
        for (path, content) in &self.0 {
            let path = folder.join(path);
            if let Some(parent) = path.parent() {
                fs::create_dir_all(parent)?;
            }
            fs::write(path, content)?;
        }
        Ok(())
    }

    /// The archive: entries sorted by path, dated 1980-01-01, deflated, without data descriptors, as made on Unix
    /// wherever it is made.
    pub fn to_zip(&self) -> Result<Vec<u8>, ZipError> {
        let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
        for (path, content) in &self.0 {
            let permissions = if path.starts_with("binaries/") { 0o755 } else { 0o644 };
            let options = SimpleFileOptions::default()
                .compression_method(CompressionMethod::Deflated)
                .compression_level(Some(9))
                .last_modified_time(DateTime::default())
                .system(System::Unix)
                .unix_permissions(permissions);
            zip.start_file(path, options)?;
            zip.write_all(content)?;
        }
        Ok(zip.finish()?.into_inner())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_files_give_the_same_bytes_in_any_order() {
        let files = [("b/two.txt", "2"), ("a.txt", "one"), ("binaries/linux64/x.so", "\u{7f}ELF")];
        let archive = |order: &[usize]| {
            let mut entries = Entries::default();
            for &index in order {
                entries.add(files[index].0, files[index].1.as_bytes().to_vec()).unwrap();
            }
            entries.to_zip().unwrap()
        };
        let bytes = archive(&[0, 1, 2]);
        assert_eq!(bytes, archive(&[2, 1, 0]));
        // Local file header: flags at 6 (bit 3 is the data descriptor), time at 10, date at 12.
        assert_eq!(bytes[6] & 8, 0, "data descriptor");
        assert_eq!(&bytes[10..14], [0, 0, 0x21, 0], "1980-01-01 00:00");
        let mut zip = zip::ZipArchive::new(Cursor::new(bytes)).unwrap();
        let names: Vec<String> =
            (0..zip.len()).map(|k| zip.by_index(k).unwrap().name().unwrap().into_owned()).collect();
        assert_eq!(names, ["a.txt", "b/two.txt", "binaries/linux64/x.so"]);
        assert_eq!(zip.by_index(2).unwrap().unix_mode().unwrap() & 0o777, 0o755);
    }

    #[test]
    fn a_path_stands_once() {
        let mut entries = Entries::default();
        entries.add("a", vec![]).unwrap();
        assert!(entries.add("a", vec![]).unwrap_err().contains('a'));
    }
}
