//! Report of a check: findings by section, equal ones once, and their counts; as text or as one JSON object.

use std::collections::BTreeSet;

use ::files::outcome::{self, Answer, Outcome};
use fmi::conformance::{Finding, Verdict};
use packing::check::Judged;
use serde::Serialize;

/// A finding of a section.
pub(super) struct Listed {
    pub finding: Finding,
    /// Fault without the call that met it, by which equal findings are known.
    pub fault: String,
}

impl From<Finding> for Listed {
    fn from(finding: Finding) -> Self {
        Self { fault: finding.text.clone(), finding }
    }
}

/// A group of findings under one heading.
pub(super) struct Section {
    title: String,
    findings: Vec<Listed>,
}

impl Section {
    /// Returns a section of these findings.
    pub(super) fn new(
        title: impl Into<String>,
        findings: impl IntoIterator<Item = impl Into<Listed>>,
    ) -> Self {
        Self { title: title.into(), findings: findings.into_iter().map(Into::into).collect() }
    }

    /// The worst finding; what was skipped counts only where nothing else was found.
    fn verdict(&self) -> Verdict {
        let verdicts = || self.findings.iter().map(|it| it.finding.verdict);
        let worst = verdicts().filter(|verdict| *verdict != Verdict::Skipped).max();
        worst.or_else(|| verdicts().max()).unwrap_or(Verdict::Good)
    }
}

/// `--json` of a check.
#[derive(Serialize)]
struct Json<'a> {
    file: &'a str,
    passed: usize,
    skipped: usize,
    warnings: usize,
    failed: usize,
    findings: Vec<JsonFinding<'a>>,
}

/// A finding of `--json`.
#[derive(Serialize)]
struct JsonFinding<'a> {
    section: &'a str,
    verdict: &'static str,
    text: &'a str,
}

/// Findings with their sections; of equal warnings and of equal faults the first.
fn once(sections: &[Section]) -> Vec<(&Section, &Finding)> {
    let mut known = BTreeSet::new();
    let all = sections.iter().flat_map(|section| section.findings.iter().map(move |it| (section, it)));
    let first = all.filter(|(_, it)| {
        !matches!(it.finding.verdict, Verdict::Note | Verdict::Bad)
            || known.insert((it.finding.verdict, it.fault.as_str()))
    });
    first.map(|(section, it)| (section, &it.finding)).collect()
}

/// Prints the sections of an FMU or a system.
pub(super) fn print(file: &str, sections: &[Section], is_verbose: bool, is_json: bool) -> Outcome {
    let found = once(sections);
    let count = |verdict: Verdict| found.iter().filter(|(_, it)| it.verdict == verdict).count();
    let [passed, skipped, warnings, failed] = Verdict::ALL.map(count);
    let answer = Answer::from(failed == 0);
    if is_json {
        let findings = found.iter().map(|(section, it)| JsonFinding {
            section: &section.title,
            verdict: it.verdict.word(),
            text: &it.text,
        });
        let json = Json { file, passed, skipped, warnings, failed, findings: findings.collect() };
        return outcome::printed(&serde_json::to_string_pretty(&json)?).map(|_| answer);
    }
    let mut text = format!("{file}\n\n");
    for section in sections {
        let worst = section.verdict();
        text.push_str(&format!("{:>8}  {}\n", worst.word(), section.title));
        for (_, finding) in found.iter().filter(|(of, _)| std::ptr::eq(*of, section)) {
            let shown = is_verbose || matches!(finding.verdict, Verdict::Note | Verdict::Bad);
            if shown || worst == Verdict::Skipped {
                let lines = finding.text.replace('\n', "\n            ");
                text.push_str(&format!("          {:<8}{lines}\n", finding.verdict.word()));
            }
        }
    }
    text.push_str(&format!("\n{passed} passed, {skipped} skipped, {warnings} warnings, {failed} failed"));
    terminal::print(&text)?;
    Ok(answer)
}

/// Prints the verdict on a file.
pub(super) fn print_judged(file: &str, judged: &Judged, is_json: bool) -> Outcome {
    if is_json {
        let findings: Vec<Finding> = match judged {
            Judged::Taken { summary, warnings } => {
                [Finding::good(summary)].into_iter().chain(warnings.iter().map(Finding::note)).collect()
            }
            Judged::Refused { problems, .. } => problems.lines().map(Finding::bad).collect(),
        };
        let title = match judged {
            Judged::Taken { .. } => "file",
            Judged::Refused { kind, .. } => kind,
        };
        return print(file, &[Section::new(title, findings)], true, true);
    }
    match judged {
        Judged::Taken { summary, warnings } => {
            let warnings: String = warnings.iter().map(|warning| format!("\nwarning: {warning}")).collect();
            outcome::printed(&format!("{summary}{warnings}"))
        }
        Judged::Refused { problems, kind } => outcome::refused(file, problems, kind),
    }
}
