//! Imports run one way: a module uses only itself and modules that come before it.

use std::fs;
use std::path::{Path, PathBuf};

const ORDER: &[&str] = &[
    "constants",
    "numerics",
    "bodies",
    "spacecraft",
    "environment",
    "radiation",
    "attitude",
    "momentum",
    "guidance",
    "plant",
    "spin",
];

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// Names after `crate::` in code lines, with grouped imports taken apart.
fn used_modules(text: &str) -> Vec<String> {
    let code: String =
        text.lines().filter(|line| !line.trim_start().starts_with("//")).map(|l| format!("{l}\n")).collect();
    let mut used = Vec::new();
    for (at, _) in code.match_indices("crate::") {
        let rest = &code[at + "crate::".len()..];
        if let Some(group) = rest.strip_prefix('{') {
            let mut depth = 0;
            let mut name = String::new();
            for c in group.chars() {
                match c {
                    '{' => depth += 1,
                    '}' if depth == 0 => break,
                    '}' => depth -= 1,
                    ',' if depth == 0 => used.push(std::mem::take(&mut name)),
                    _ if depth == 0 => name.push(c),
                    _ => {}
                }
            }
            used.push(name);
        } else {
            used.push(rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect());
        }
    }
    used.into_iter()
        .map(|name| name.trim().split("::").next().unwrap_or_default().to_owned())
        .filter(|name| !name.is_empty())
        .collect()
}

#[test]
fn a_module_uses_only_earlier_ones() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    sources(&root, &mut files);
    let mut seen = 0;
    for file in files {
        let inside = file.strip_prefix(&root).unwrap();
        let module = inside.iter().next().unwrap().to_str().unwrap().trim_end_matches(".rs");
        if module == "lib" {
            continue;
        }
        let rank = |name: &str| ORDER.iter().position(|known| *known == name);
        let own = rank(module).unwrap_or_else(|| panic!("{} is in no listed module", file.display()));
        for used in used_modules(&fs::read_to_string(&file).unwrap()) {
            let other = rank(&used)
                .unwrap_or_else(|| panic!("{}: `crate::{used}` is no listed module", file.display()));
            assert!(other <= own, "{} uses `{used}`, which comes after `{module}`", inside.display());
            seen += 1;
        }
    }
    assert!(seen > 20, "the scan found hardly any use: {seen}");
}

#[test]
fn grouped_imports_are_taken_apart() {
    let text =
        "use crate::{a::{b, c}, d, e::f};\nuse crate::g::h;\n// crate::comment\nlet x = crate::i::j();";
    assert_eq!(used_modules(text), ["a", "d", "e", "g", "i"]);
}
