//! Every link inside the guide, and every relative link of the texts beside it, leads to something.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Component, Path, PathBuf};

use heliotorque_guide::{build, project};

use crate::{html, markdown};

/// Texts outside of the guide.
const TEXTS: &[&str] =
    &["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "examples/README.md", "dist/README.md"];

fn is_elsewhere(link: &str) -> bool {
    link.contains("://") || link.starts_with("mailto:") || link.starts_with("data:")
}

/// The path without `.` and `..`.
fn plain(path: &Path) -> PathBuf {
    let mut found = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => {
                found.pop();
            }
            Component::CurDir => {}
            part => found.push(part),
        }
    }
    found
}

fn pages(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(pages(&path));
        } else if path.extension().is_some_and(|extension| extension == "html") {
            found.push(path);
        }
    }
    found
}

#[test]
fn every_link_of_the_built_guide_leads_somewhere_in_it() {
    let folder = project().join("target").join("guide");
    let index = build(&project().join("docs"), &folder).unwrap();
    assert!(index.exists());
    let texts: BTreeMap<PathBuf, String> =
        pages(&folder).into_iter().map(|path| (path.clone(), fs::read_to_string(path).unwrap())).collect();
    assert!(texts.len() > 20, "{} pages", texts.len());
    let anchors: BTreeMap<&PathBuf, BTreeSet<String>> =
        texts.iter().map(|(path, text)| (path, html::anchors(text))).collect();
    let mut wrong = Vec::new();
    let mut followed = 0;
    for (path, text) in &texts {
        // The page for addresses that do not exist is shown below any of them.
        if path.ends_with("404.html") {
            continue;
        }
        for link in html::references(text) {
            if is_elsewhere(&link) {
                wrong.push(format!("{}: {link} leads out of the guide", path.display()));
                continue;
            }
            followed += 1;
            let (file, anchor) = link.split_once('#').unwrap_or((&link, ""));
            let mut target = plain(&path.parent().unwrap().join(file));
            if file.is_empty() {
                target.clone_from(path);
            }
            if !target.exists() {
                wrong.push(format!("{}: {link}", path.display()));
            } else if !anchor.is_empty() && !anchors.get(&target).is_some_and(|found| found.contains(anchor))
            {
                wrong.push(format!("{}: no anchor {link}", path.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(followed > 1000, "{followed}");
}

#[test]
fn every_relative_link_of_the_texts_beside_it_exists() {
    let mut wrong = Vec::new();
    for name in TEXTS {
        let path = project().join(name);
        let text = fs::read_to_string(&path).unwrap();
        for link in markdown::links(&text).into_iter().filter(|link| !is_elsewhere(link)) {
            let (file, anchor) = link.split_once('#').unwrap_or((&link, ""));
            let target = if file.is_empty() { path.clone() } else { path.parent().unwrap().join(file) };
            if !target.exists() {
                wrong.push(format!("{name}: {link}"));
            } else if !anchor.is_empty()
                && !markdown::anchors(&fs::read_to_string(&target).unwrap()).contains(anchor)
            {
                wrong.push(format!("{name}: no heading for {link}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_file_that_the_guide_names_in_the_code_exists() {
    let mut named = 0;
    for path in markdown::files(&project().join("docs").join("src")) {
        let text = fs::read_to_string(&path).unwrap();
        for part in text.split('`').skip(1).step_by(2) {
            let is_path = ["fmu-src/", "harness/", "tests/", "examples/", "modelDescription/", "xtask/"]
                .iter()
                .any(|start| part.starts_with(start))
                && !part.contains([' ', '*', '|', '<']);
            if is_path {
                named += 1;
                assert!(project().join(part).exists(), "{}: `{part}`", path.display());
            }
        }
    }
    assert!(named > 40, "{named}");
}
