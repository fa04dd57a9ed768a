//! Checks without running the FMU.

use std::path::{Component, Path};

use crate::{Fmu, Requirements};
use model_description::Severity;

use crate::conformance::{Finding, Verdict};

/// Files and folders that FMI 2.0.5 knows at the top of an archive (2.3).
const KNOWN: [&str; 8] = [
    "modelDescription.xml",
    "model.png",
    "documentation",
    "sources",
    "binaries",
    "resources",
    "extra",
    "terminalsAndIcons",
];

/// The entries to an FMU's licences (2.3).
const LICENSE_ENTRIES: [&str; 2] =
    ["documentation/licenses/license.txt", "documentation/licenses/license.html"];

/// The archive's layout.
pub fn archive(fmu: &Fmu) -> Vec<Finding> {
    let mut findings = vec![Finding::good(
        "opens: no path leaves the folder, no link, no size beyond reason, no damaged entry",
    )];
    match fmu.binary_path() {
        Ok(path) => {
            let shown = path.strip_prefix(fmu.folder()).unwrap_or(&path).display().to_string();
            findings.push(Finding::good(format!("has a library for this computer: {shown}")));
        }
        Err(error) => findings.push(Finding::bad(error.to_string())),
    }
    findings.extend(fmu.requirements().into_iter().map(|(path, read)| match read {
        Ok(requirements) if requirements.is_in_platform_folder() => {
            Finding::good(format!("{}: {requirements}", path.display()))
        }
        Ok(requirements) => Finding::bad(misplaced(&path, &requirements)),
        Err(error) => Finding::note(error.to_string()),
    }));
    separators(fmu, &mut findings);
    source_files(fmu, &mut findings);
    top_level(fmu, &mut findings);
    let has = |path: &str| fmu.folder().join(path).exists();
    findings.push(presence(has("documentation"), "documentation"));
    findings.push(presence(LICENSE_ENTRIES.into_iter().any(has), &LICENSE_ENTRIES.join(" or ")));
    findings
}

/// Names the folder that a library in another platform's folder belongs to.
fn misplaced(path: &Path, requirements: &Requirements) -> String {
    let suffix = requirements.suffix();
    let allowed = match requirements.platform_folders().first() {
        Some(folder) => format!("binaries/{folder}/*{suffix}"),
        None => format!("*{suffix} in a folder of its own platform"),
    };
    format!("{}: found {requirements}; allowed for it: {allowed} (2.3)", path.display())
}

fn presence(there: bool, what: &str) -> Finding {
    if there { Finding::good(format!("has {what}")) } else { Finding::note(format!("has no {what}")) }
}

/// Paths in a zip are written with slashes (2.3, and 4.4.17 of the zip specification).
fn separators(fmu: &Fmu, findings: &mut Vec<Finding>) {
    for name in fmu.entries().iter().filter(|name| name.contains('\\')) {
        findings
            .push(Finding::bad(format!("the path {name:?} has a backslash; allowed are slashes only (2.3)")));
    }
}

/// Checks that the source files which the description lists are there.
fn source_files(fmu: &Fmu, findings: &mut Vec<Finding>) {
    let description = fmu.description();
    let of_exchange = description.model_exchange.iter().map(|it| ("ModelExchange", &it.source_files));
    let of_simulation = description.co_simulation.iter().map(|it| ("CoSimulation", &it.source_files));
    for (element, files) in of_exchange.chain(of_simulation) {
        for name in files {
            // An absolute path or `..` would be searched outside the FMU.
            let inside = Path::new(name).components().all(|part| matches!(part, Component::Normal(_)));
            findings.push(if inside && fmu.folder().join("sources").join(name).is_file() {
                Finding::good(format!("sources/{name} is there, as {element}/SourceFiles lists"))
            } else {
                Finding::bad(format!(
                    "{element}/SourceFiles lists {name:?}; sources holds no such file (2.3)"
                ))
            });
        }
    }
}

fn top_level(fmu: &Fmu, findings: &mut Vec<Finding>) {
    for name in files::names_in(fmu.folder()).iter().filter(|name| !KNOWN.contains(&name.as_str())) {
        findings.push(Finding::note(format!("{name} is none of FMI 2.0.5's own files and folders (2.3)")));
    }
}

/// Everything the reader and the validator say, with lines.
pub fn description(fmu: &Fmu) -> Vec<Finding> {
    let found = fmu.parsed().findings();
    let mut findings: Vec<Finding> = found
        .iter()
        .map(|finding| {
            let verdict = match finding.severity() {
                Severity::Error => Verdict::Bad,
                Severity::Warning => Verdict::Note,
            };
            Finding::new(verdict, finding.to_string())
        })
        .collect();
    if findings.is_empty() {
        findings.push(Finding::good("valid: every rule of the validator holds"));
    }
    if let Err(error) = fmu.co_simulation() {
        findings.push(Finding::bad(error.to_string()));
    }
    findings
}
