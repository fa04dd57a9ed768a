//! Every model has the same files: `mod`, `setup`, `variables`, `inputs`, `outputs` and `dependencies`; one with a state of many parts
//! has `state` and `step` beside them.

use std::collections::BTreeSet;

use crate::sources::workspace;

const FILES: [&str; 6] = ["dependencies", "inputs", "mod", "outputs", "setup", "variables"];

/// Files that a model may have besides.
const OPTIONAL: [&str; 2] = ["state", "step"];

/// Folder of the parts that models share.
const COMMON: &str = "common";

#[test]
fn every_model_has_the_same_files() {
    let root = workspace().join("fmu-src").join("models").join("src");
    let mut models = 0;
    for entry in std::fs::read_dir(root).unwrap() {
        let folder = entry.unwrap().path();
        if !folder.is_dir() || folder.ends_with(COMMON) {
            continue;
        }
        let files = std::fs::read_dir(&folder).unwrap();
        let found: BTreeSet<String> = files
            .map(|file| file.unwrap().path().file_stem().unwrap().to_str().unwrap().to_owned())
            .filter(|name| !OPTIONAL.contains(&name.as_str()))
            .collect();
        assert_eq!(found, FILES.map(str::to_owned).into(), "{}", folder.display());
        models += 1;
    }
    assert_eq!(models, 4);
}
