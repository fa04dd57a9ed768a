//! Any bytes are unpacked below the folder and within the limits, or refused.
#![no_main]

use std::fs;
use std::path::Path;

use libfuzzer_sys::fuzz_target;
use fmi::{ArchiveLimits, unpack};

const LIMITS: ArchiveLimits = ArchiveLimits { entries: 20, total_bytes: 1 << 20 };

/// Files and bytes below a folder, in which there is nothing but files and folders.
fn held(folder: &Path) -> (usize, u64) {
    let (mut files, mut bytes) = (0, 0);
    for entry in fs::read_dir(folder).unwrap() {
        let entry = entry.unwrap();
        let kind = entry.file_type().unwrap();
        if kind.is_dir() {
            let below = held(&entry.path());
            (files, bytes) = (files + below.0, bytes + below.1);
        } else {
            assert!(kind.is_file(), "{:?} is {kind:?}", entry.path());
            (files, bytes) = (files + 1, bytes + entry.metadata().unwrap().len());
        }
    }
    (files, bytes)
}

fuzz_target!(|bytes: &[u8]| {
    let scratch = tempfile::tempdir().unwrap();
    let (archive, into) = (scratch.path().join("any.fmu"), scratch.path().join("into"));
    fs::write(&archive, bytes).unwrap();
    fs::create_dir(&into).unwrap();
    let outcome = unpack(&archive, &into, LIMITS);
    let (files, bytes) = held(&into);
    match &outcome {
        Ok(names) => assert!(files <= names.len(), "{files} files of {names:?}"),
        Err(error) => {
            assert!(error.to_string().contains("any.fmu") || error.to_string().contains("into"), "{error}")
        }
    }
    // The byte that is too many is written before it is noticed.
    assert!(files <= LIMITS.entries && bytes <= LIMITS.total_bytes + 1, "{files} files of {bytes} bytes");
    // Nothing beside the two.
    assert_eq!(fs::read_dir(scratch.path()).unwrap().count(), 2);
});
