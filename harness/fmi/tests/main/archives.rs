//! An archive leaves nothing outside its folder and never more than it may, whatever sizes it states.

use std::{fs, io::Write, path::Path};

use fmi::{ArchiveLimits, Error, Fmu, unpack};
use zip::{ZipWriter, write::SimpleFileOptions};

fn archive(path: &Path, entries: &[(&str, &[u8])]) {
    let mut zip = ZipWriter::new(fs::File::create(path).unwrap());
    for (name, content) in entries {
        zip.start_file(*name, SimpleFileOptions::default()).unwrap();
        zip.write_all(content).unwrap();
    }
    zip.finish().unwrap();
}

/// Unpacks into `scratch/inner`, and checks that nothing else in `scratch` changed.
fn try_unpack(entries: &[(&str, &[u8])], limits: ArchiveLimits) -> Result<Vec<String>, String> {
    let scratch = tempfile::tempdir().unwrap();
    let path = scratch.path().join("a.fmu");
    archive(&path, entries);
    unpack_in(scratch.path(), &path, limits)
}

fn unpack_in(scratch: &Path, path: &Path, limits: ArchiveLimits) -> Result<Vec<String>, String> {
    let inner = scratch.join("inner");
    fs::create_dir_all(&inner).unwrap();
    let outcome = unpack(path, &inner, limits).map_err(|error| error.to_string());
    let mut beside: Vec<_> = fs::read_dir(scratch).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    beside.sort();
    assert_eq!(beside, ["a.fmu", "inner"], "something was written beside the folder");
    outcome.map(|_| {
        let mut files = Vec::new();
        list(&inner, &inner, &mut files);
        files.sort();
        files
    })
}

fn list(root: &Path, folder: &Path, files: &mut Vec<String>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            list(root, &path, files);
        } else {
            files.push(path.strip_prefix(root).unwrap().to_string_lossy().replace('\\', "/"));
        }
    }
}

#[test]
fn plain_archives_unpack() {
    let files = try_unpack(
        &[("modelDescription.xml", b"<x/>"), ("resources/a/b.txt", b"b"), ("./binaries//l.so", b"")],
        ArchiveLimits::default(),
    );
    assert_eq!(files.unwrap(), ["binaries/l.so", "modelDescription.xml", "resources/a/b.txt"]);
}

#[test]
fn backslashes_of_windows_packers_are_folders() {
    let files = try_unpack(&[("resources\\deep\\a.txt", b"a")], ArchiveLimits::default());
    assert_eq!(files.unwrap(), ["resources/deep/a.txt"]);
}

#[test]
fn paths_that_leave_the_folder_are_refused() {
    let slashes = "../evil.txt a/../../evil.txt a/.. /etc/evil .. file.txt:stream";
    let backslashes = r"..\evil.txt a\..\..\evil C:\evil C:evil \\server\share\evil";
    for name in slashes.split(' ').chain(backslashes.split(' ')) {
        let error = try_unpack(&[(name, b"evil")], ArchiveLimits::default()).unwrap_err();
        assert!(error.contains("leaves the folder") && error.contains(&format!("{name:?}")), "{error}");
    }
}

#[test]
fn links_are_refused() {
    let scratch = tempfile::tempdir().unwrap();
    let path = scratch.path().join("a.fmu");
    let mut zip = ZipWriter::new(fs::File::create(&path).unwrap());
    zip.add_symlink("resources", "/etc", SimpleFileOptions::default()).unwrap();
    zip.start_file("resources/passwd", SimpleFileOptions::default()).unwrap();
    zip.finish().unwrap();
    let error = unpack_in(scratch.path(), &path, ArchiveLimits::default()).unwrap_err();
    assert!(error.contains("symbolic link"), "{error}");
}

#[test]
fn bombs_stop_at_the_limit() {
    let zeros = vec![0; 1 << 20];
    let limits = ArchiveLimits { total_bytes: 100_000, ..ArchiveLimits::default() };
    let error = try_unpack(&[("small", b"x"), ("bomb", &zeros)], limits).unwrap_err();
    assert!(error.contains("100000 bytes") && error.contains("bomb"), "{error}");

    // Exactly the limit is allowed.
    let limits = ArchiveLimits { total_bytes: 1 << 20, ..ArchiveLimits::default() };
    assert!(try_unpack(&[("bomb", &zeros)], limits).is_ok());
    let limits = ArchiveLimits { total_bytes: (1 << 20) - 1, ..ArchiveLimits::default() };
    assert!(try_unpack(&[("bomb", &zeros)], limits).is_err());
}

#[test]
fn a_size_that_lies_gains_nothing() {
    let scratch = tempfile::tempdir().unwrap();
    let path = scratch.path().join("a.fmu");
    archive(&path, &[("bomb", &vec![7; 1 << 20])]);
    let mut bytes = fs::read(&path).unwrap();
    // The uncompressed size: at 22 in the local header (PK 3 4), at 24 in the central one (PK 1 2).
    for (signature, offset) in [(b"PK\x03\x04", 22), (b"PK\x01\x02", 24)] {
        let at = bytes.windows(4).position(|window| window == signature).unwrap();
        bytes[at + offset..at + offset + 4].copy_from_slice(&10u32.to_le_bytes());
    }
    fs::write(&path, bytes).unwrap();
    let limits = ArchiveLimits { total_bytes: 100_000, ..ArchiveLimits::default() };
    assert!(unpack_in(scratch.path(), &path, limits).is_err());
    let written = fs::metadata(scratch.path().join("inner/bomb")).map_or(0, |metadata| metadata.len());
    assert!(written <= 100_001, "{written} bytes were written");
}

#[test]
fn too_many_entries_are_refused() {
    let names: Vec<String> = (0..20).map(|k| format!("f{k}")).collect();
    let entries: Vec<(&str, &[u8])> = names.iter().map(|name| (name.as_str(), &b""[..])).collect();
    let error = try_unpack(&entries, ArchiveLimits { entries: 19, ..ArchiveLimits::default() }).unwrap_err();
    assert!(error.contains("20 entries, at most 19"), "{error}");
}

#[test]
fn torn_and_changed_archives_are_errors() {
    let scratch = tempfile::tempdir().unwrap();
    let path = scratch.path().join("a.fmu");
    let text: Vec<u8> = (0..5000u32).flat_map(|k| (k * k).to_le_bytes()).collect();
    archive(&path, &[("modelDescription.xml", &text)]);
    let whole = fs::read(&path).unwrap();
    for length in [0, 1, 4, 30, 100, whole.len() / 2, whole.len() - 22, whole.len() - 1] {
        fs::write(&path, &whole[..length]).unwrap();
        assert!(matches!(Fmu::open(&path), Err(Error::Archive { .. })), "cut to {length} bytes");
    }
    let mut changed = whole.clone();
    changed[whole.len() / 2] ^= 0x55;
    fs::write(&path, changed).unwrap();
    let error = Fmu::open(&path).unwrap_err().to_string();
    assert!(error.contains("modelDescription.xml"), "{error}");
}

#[test]
fn what_is_no_fmu_says_so() {
    let scratch = tempfile::tempdir().unwrap();
    let path = scratch.path().join("a.fmu");
    assert!(matches!(Fmu::open(&path), Err(Error::File { .. })), "missing");
    archive(&path, &[("readme.txt", b"hello")]);
    assert!(Fmu::open(&path).unwrap_err().to_string().contains("no modelDescription.xml"));
    archive(&path, &[("modelDescription.xml", b"<fmiModelDescription")]);
    let error = Fmu::open(&path).unwrap_err().to_string();
    assert!(error.contains("a.fmu") && error.contains("modelDescription.xml"), "{error}");
    archive(&path, &[("modelDescription.xml", b"\xff\xfe<\0")]);
    assert!(matches!(Fmu::open(&path), Err(Error::Unusable { .. })));
}

#[test]
fn an_entry_that_the_list_has_twice_is_refused() {
    let scratch = tempfile::tempdir().unwrap();
    let path = scratch.path().join("a.fmu");
    // The writer refuses a name twice: two names of one length, of which the second is written over.
    archive(&path, &[("modelDescription.xml", b"<x/>"), ("modelDescriptiom.xml", b"<y/>")]);
    let mut bytes = fs::read(&path).unwrap();
    let name = b"modelDescriptiom.xml";
    while let Some(at) = bytes.windows(name.len()).position(|it| it == name) {
        bytes[at..at + name.len()].copy_from_slice(b"modelDescription.xml");
    }
    fs::write(&path, bytes).unwrap();
    let refused = unpack_in(scratch.path(), &path, ArchiveLimits::default()).unwrap_err();
    assert!(refused.contains("entry \"modelDescription.xml\" stands twice in the archive"), "{refused}");
}
