//! `cargo xtask lines`: lines of code by crate, without blanks, comments, lone brackets and tests.

use std::path::Path;

use crate::paths::{entries, name_of, read};
use crate::shell::{Outcome, root};

/// The crate that is counted by folders too.
const PHYSICS: &str = "fmu-src/physics";
/// The folders of everything that ends inside the FMU.
const CORE: [&str; 2] = ["fmu-src/", "modelDescription"];

/// Prints the lines of every crate but those of tests, and those of [`PHYSICS`] by folder.
pub(crate) fn print() -> Outcome {
    let root = root();
    let text = read(&root.join("Cargo.toml"))?;
    let (mut core, mut all) = (0, 0);
    let row = |lines: usize, name: &str| println!("{lines:7} {name}");
    for member in members(&text).filter(|member| !is_of_tests(member)) {
        let lines = below(&root.join(member))?;
        row(lines, member);
        if member == PHYSICS {
            for (folder, lines) in folders(&root.join(member).join("src"))? {
                row(lines, &format!("  {folder}"));
            }
        }
        all += lines;
        core += if CORE.iter().any(|folder| member.starts_with(folder)) { lines } else { 0 };
    }
    row(core, "fmu-src and modelDescription");
    row(all, "all");
    Ok(())
}

/// The folders of a workspace's crates.
fn members(manifest: &str) -> impl Iterator<Item = &str> {
    let list = manifest.split_once("members = [").and_then(|(_, rest)| rest.split_once(']'));
    list.map_or("", |(list, _)| list)
        .split(',')
        .map(|item| item.trim().trim_matches('"'))
        .filter(|it| !it.is_empty())
}

/// Whether a folder below the workspace holds tests alone.
fn is_of_tests(folder: &str) -> bool {
    folder.split('/').any(|part| part == "tests")
}

/// The lines below every folder in `folder`, by name.
fn folders(folder: &Path) -> Result<Vec<(String, usize)>, String> {
    let mut found = Vec::new();
    for path in entries(folder)?.iter().filter(|path| path.is_dir()) {
        found.push((name_of(path), below(path)?));
    }
    Ok(found)
}

/// The lines of all files below `folder` that are not for tests.
fn below(folder: &Path) -> Result<usize, String> {
    let mut lines = 0;
    for path in entries(folder)? {
        let name = name_of(&path);
        if path.is_dir() {
            lines += if is_of_tests(&name) || name == "target" { 0 } else { below(&path)? };
        } else if name.ends_with(".rs") && !is_test_file(&name) {
            lines += counted(&read(&path)?);
        }
    }
    Ok(lines)
}

fn is_test_file(name: &str) -> bool {
    name == "tests.rs" || name.ends_with("_tests.rs") || name.starts_with("test_")
}

/// The lines of a file that hold a letter, digit or `_` outside of line comments, up to its inline module of tests.
fn counted(text: &str) -> usize {
    let mut lines = text.lines().map(str::trim).peekable();
    let mut count = 0;
    while let Some(line) = lines.next() {
        if line == "#[cfg(test)]" && lines.peek().is_some_and(|next| is_inline_module(next)) {
            break;
        }
        let is_code = |line: &str| line.contains(|c: char| c.is_ascii_alphanumeric() || c == '_');
        count += usize::from(!line.starts_with("//") && is_code(line));
    }
    count
}

fn is_inline_module(line: &str) -> bool {
    line.starts_with("mod ") && line.ends_with('{')
}

#[cfg(test)]
mod tests {
    //! Lines and members that count.
    use super::*;

    #[test]
    fn blanks_comments_brackets_and_tests_do_not_count() {
        let text = "//! A file.\n\nuse a::b;\n\n/// A function.\nfn f() -> u8 {\n    // Seven.\n    7 // days\n}\n\
                    #[cfg(test)]\nmod apart;\n#[cfg(test)]\nfn g() {\n    _();\n}\n);\n#[cfg(test)]\nmod tests {\n    use super::*;\n}\n";
        // The import, `f` and its body, both attributes before the tests, `mod apart`, `g` and its body.
        assert_eq!(counted(text), 8);
        assert_eq!(counted("#[cfg(test)]\nmod tests {\n}\nfn f() {}\n"), 0);
    }

    #[test]
    fn files_and_folders_of_tests_are_told_by_their_names() {
        assert!(["tests.rs", "orbit_tests.rs", "test_orbit.rs"].map(is_test_file).iter().all(|it| *it));
        assert!(!["latest.rs", "contest.rs"].map(is_test_file).iter().any(|it| *it));
        let manifest = "[workspace]\nmembers = [\n    \"a/b\",\n    \"tests\",\n    \"tests/probe\",\n]\n";
        assert_eq!(members(manifest).filter(|it| !is_of_tests(it)).collect::<Vec<_>>(), ["a/b"]);
    }
}
