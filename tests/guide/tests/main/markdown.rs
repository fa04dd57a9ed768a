//! Markdown as text: headings, links, blocks of code.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Every Markdown file below a folder, sorted.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path));
        } else if path.extension().is_some_and(|extension| extension == "md") {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// Lines of a text, each with whether it stands in a block of code.
fn lines(text: &str) -> impl Iterator<Item = (&str, bool)> {
    let mut inside = false;
    text.lines().map(move |line| {
        let fence = line.trim_start().starts_with("```");
        if fence {
            inside = !inside;
        }
        (line, inside || fence)
    })
}

/// Anchors of a text's headings, as pages that show Markdown make them.
pub fn anchors(text: &str) -> BTreeSet<String> {
    let slug = |heading: &str| {
        let kept = heading.to_lowercase().replace(' ', "-");
        kept.chars().filter(|c| c.is_alphanumeric() || *c == '-' || *c == '_').collect()
    };
    lines(text)
        .filter(|(line, code)| !code && line.starts_with('#'))
        .map(|(line, _)| slug(line.trim_start_matches('#').trim()))
        .collect()
}

/// Targets of links and pictures outside of code.
pub fn links(text: &str) -> Vec<String> {
    let prose: String = lines(text).filter(|(_, code)| !code).map(|(line, _)| format!("{line}\n")).collect();
    // What stands between backticks is code too.
    let prose: String = prose.split('`').step_by(2).collect();
    prose.split("](").skip(1).filter_map(|part| part.split(')').next()).map(str::to_owned).collect()
}

/// Commands of `heliotorque` in blocks of code, continued lines joined.
pub fn commands(text: &str) -> Vec<String> {
    let code: String = lines(text).filter(|(_, code)| *code).map(|(line, _)| format!("{line}\n")).collect();
    let joined = code.replace("\\\n", " ");
    let command = |line: &str| {
        let line = line.trim();
        let line = line.strip_prefix("$ ").unwrap_or(line);
        line.starts_with("heliotorque ").then(|| line.to_owned())
    };
    joined.lines().filter_map(command).collect()
}
