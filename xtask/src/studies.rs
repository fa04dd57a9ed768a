//! `cargo xtask study NAME|list|all`: the studies of the papers, which are Python programs in `harness/studies`.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::build::Built;
use crate::paths::{dist, entries, read};
use crate::shell::{Outcome, command, root, run};
use crate::{build, python};

/// A study: `<subject>/<name>`, and what the first line of its docstring says.
struct Study {
    name: String,
    shows: String,
}

/// Runs a study or all of them, or lists them.
pub(crate) fn study(arguments: &[String]) -> Outcome {
    let studies = all()?;
    let (name, options) = match arguments {
        [name, options @ ..] if name != "list" => (name.as_str(), options),
        _ => {
            let width = studies.iter().map(|study| study.name.len()).max().unwrap_or(0);
            studies.iter().for_each(|Study { name, shows }| println!("{name:width$}  {shows}"));
            return Ok(());
        }
    };
    let is_known = name == "all" || studies.iter().any(|study| study.name == name);
    if !is_known {
        let names: Vec<&str> = studies.iter().map(|study| study.name.as_str()).collect();
        return Err(format!("no study `{name}`; there are all, {}", names.join(", ")));
    }
    let built = build::build()?;
    crate::dist::pack_stale(&built)?;
    let chosen = studies.iter().filter(|study| name == "all" || study.name == name);
    chosen.into_iter().try_for_each(|study| {
        let output = dist(&study.name);
        run(program(&built, &study.name, &output)?.args(options))
    })
}

/// A study on the FMUs in `dist/`, whose files go to `output`.
pub(crate) fn program(built: &Built, name: &str, output: &Path) -> Result<Command, String> {
    let mut program = command(python::interpreter()?);
    program.arg(folder().join(format!("{name}.py"))).arg("--dist").arg(root().join("dist"));
    program.arg("--output").arg(output);
    program.env("HELIOTORQUE", &built.heliotorque).env("PYTHONDONTWRITEBYTECODE", "1");
    Ok(program)
}

fn folder() -> PathBuf {
    root().join("harness").join("studies")
}

/// All studies by name: the files in folders of `harness/studies` that end with a call of `main`.
fn all() -> Result<Vec<Study>, String> {
    let mut studies = Vec::new();
    for subject in entries(&folder())?.iter().filter(|path| path.is_dir()) {
        for file in entries(subject)?.iter().filter(|path| path.extension().is_some_and(|it| it == "py")) {
            let text = read(file)?;
            if text.lines().next_back().is_some_and(|last| last.contains("main(")) {
                let first = text.lines().next().unwrap_or_default();
                studies.push(Study {
                    name: format!("{}/{}", stem(subject), stem(file)),
                    shows: first.trim_matches('"').to_owned(),
                });
            }
        }
    }
    Ok(studies)
}

fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}
