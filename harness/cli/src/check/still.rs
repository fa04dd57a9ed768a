//! What can be checked without running the FMU.

use loader::Fmu;
use model_description::Severity;

use super::{Finding, Verdict};

/// Folders and files that FMI 2.0 knows at the top of an archive (2.3).
const KNOWN: [&str; 7] =
    ["modelDescription.xml", "model.png", "documentation", "licenses", "sources", "binaries", "resources"];

/// The archive's layout.
pub fn archive(fmu: &Fmu) -> Vec<Finding> {
    let mut findings = vec![Finding::good(
        "opens: no path leaves the folder, no link, no size beyond reason, no torn entry",
    )];
    match fmu.binary_path() {
        Ok(path) => {
            let shown = path.strip_prefix(fmu.folder()).unwrap_or(&path).display().to_string();
            findings.push(Finding::good(format!("has a library for this computer: {shown}")));
        }
        Err(error) => findings.push(Finding::bad(error.to_string())),
    }
    let Ok(entries) = std::fs::read_dir(fmu.folder()) else { return findings };
    let mut names: Vec<String> =
        entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    for name in &names {
        // Vendors may add folders of their own below `extra` (2.3).
        if !KNOWN.contains(&name.as_str()) && name != "extra" {
            findings.push(Finding::note(format!("{name} is none of FMI 2.0's own files and folders")));
        }
    }
    for wanted in ["documentation", "licenses"] {
        let verdict = if names.iter().any(|name| name == wanted) { Verdict::Good } else { Verdict::Note };
        let text =
            if verdict == Verdict::Good { format!("has {wanted}") } else { format!("has no {wanted}") };
        findings.push(Finding::new(verdict, text));
    }
    findings
}

/// Everything the reader and the validator say, with lines.
pub fn description(fmu: &Fmu) -> Vec<Finding> {
    let said = fmu.parsed().findings();
    let mut findings: Vec<Finding> = said
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
