//! Every file of the corpus has one fault, named by the file, and reader or validator name exactly that one.
//!
//! `valid.xml` is written by hand. The others are `valid.xml` with the edits of `faults.txt`; after changing either, run
//! the tests once with `UPDATE_CORPUS=1`. A file is named by the code of its fault and, after `--`, its kind.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

use model_description::*;

use crate::faults::{Fault, faults};

const VALID: &str = include_str!("../corpus/valid.xml");

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/corpus")
}

fn findings(bytes: &[u8]) -> Vec<Finding> {
    parse(bytes).map_or_else(|error| vec![error.into()], |parsed| parsed.findings())
}

/// `valid.xml` with the edits of one fault; every edit must fit one place only.
fn edited(name: &str, edits: &[(String, String)]) -> String {
    edits.iter().fold(VALID.to_owned(), |text, (from, to)| {
        assert_eq!(text.matches(from.as_str()).count(), 1, "{name}: {from}");
        text.replace(from.as_str(), to)
    })
}

#[test]
fn files_are_the_base_with_one_edit() {
    let update = std::env::var_os("UPDATE_CORPUS").is_some();
    let mut known: BTreeSet<String> = ["valid.xml".to_owned()].into();
    for Fault { name, edits } in faults() {
        let file = folder().join(format!("{name}.xml"));
        let text = edited(name, &edits);
        if update {
            fs::write(&file, &text).unwrap();
        }
        let committed = fs::read_to_string(&file).unwrap_or_default();
        assert_eq!(committed, text, "{name}: run with UPDATE_CORPUS=1");
        assert!(known.insert(format!("{name}.xml")), "{name} stands twice");
    }
    let found: BTreeSet<String> = fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".xml"))
        .collect();
    assert_eq!(found, known);
}

#[test]
fn the_base_is_valid() {
    assert_eq!(findings(VALID.as_bytes()), Vec::new());
}

#[test]
fn each_file_has_its_fault_and_no_other() {
    for Fault { name, edits } in faults() {
        let code = name.split("--").next().unwrap();
        let found = findings(edited(name, &edits).as_bytes());
        let codes: BTreeSet<&str> = found.iter().map(|finding| finding.code.as_str()).collect();
        assert_eq!(codes, BTreeSet::from([code]), "{name}: {found:#?}");
        for finding in found {
            assert!(finding.line.is_some(), "{name}: {finding}");
        }
    }
}

#[test]
fn every_code_has_a_file() {
    let faults = faults();
    let covered: BTreeSet<&str> = faults.iter().map(|it| it.name.split("--").next().unwrap()).collect();
    let codes: BTreeSet<&str> = Code::ALL.iter().map(|code| code.as_str()).collect();
    assert_eq!(covered, codes);
}

/// The README's verdicts of ours; FMPy's are held by `tests/python/test_corpus_table.py`.
#[test]
fn the_table_shows_what_is_found() {
    let readme = fs::read_to_string(folder().join("README.md")).unwrap();
    for Fault { name, edits } in faults() {
        let found: BTreeSet<String> = findings(edited(name, &edits).as_bytes())
            .iter()
            .map(|finding| format!("{} ({})", finding.code.as_str(), finding.severity()))
            .collect();
        let row = format!("| [{name}]({name}.xml) | {} | ", Vec::from_iter(found).join(", "));
        assert_eq!(readme.matches(&row).count(), 1, "no row {row}");
    }
    assert_eq!(readme.matches(".xml) | ").count(), faults().len());
}
