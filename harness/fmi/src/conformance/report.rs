//! Report of a check: findings by section, equal ones once, and their counts; as text or as one JSON object.

use std::collections::BTreeSet;

use serde::Serialize;

use super::finding::{Finding, Verdict};

/// A finding of a section.
pub struct Listed {
    /// Finding.
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
pub struct Section {
    title: String,
    findings: Vec<Listed>,
}

impl Section {
    /// Returns a section of these findings.
    pub fn new(title: impl Into<String>, findings: impl IntoIterator<Item = impl Into<Listed>>) -> Self {
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

/// Report of a check.
pub struct Report<'a> {
    file: &'a str,
    sections: &'a [Section],
    found: Vec<(&'a Section, &'a Finding)>,
}

impl<'a> Report<'a> {
    /// Returns the report on a file.
    pub fn new(file: &'a str, sections: &'a [Section]) -> Self {
        Self { file, sections, found: once(sections) }
    }

    /// Number of findings by verdict: passed, skipped, warnings, failed.
    pub fn counts(&self) -> [usize; 4] {
        Verdict::ALL.map(|verdict| self.found.iter().filter(|(_, it)| it.verdict == verdict).count())
    }

    /// One JSON object.
    ///
    /// # Errors
    /// Errors of the serializer.
    pub fn json(&self) -> serde_json::Result<String> {
        let [passed, skipped, warnings, failed] = self.counts();
        let findings = self.found.iter().map(|(section, it)| JsonFinding {
            section: &section.title,
            verdict: it.verdict.word(),
            text: &it.text,
        });
        let findings = findings.collect();
        serde_json::to_string_pretty(&Json { file: self.file, passed, skipped, warnings, failed, findings })
    }

    /// Text: every finding, or those that are not as they should be.
    pub fn text(&self, is_verbose: bool) -> String {
        let [passed, skipped, warnings, failed] = self.counts();
        let mut text = format!("{}\n\n", self.file);
        for section in self.sections {
            let worst = section.verdict();
            text.push_str(&format!("{:>8}  {}\n", worst.word(), section.title));
            for (_, finding) in self.found.iter().filter(|(of, _)| std::ptr::eq(*of, section)) {
                let shown = is_verbose || matches!(finding.verdict, Verdict::Note | Verdict::Bad);
                if shown || worst == Verdict::Skipped {
                    let lines = finding.text.replace('\n', "\n            ");
                    text.push_str(&format!("          {:<8}{lines}\n", finding.verdict.word()));
                }
            }
        }
        text + &format!("\n{passed} passed, {skipped} skipped, {warnings} warnings, {failed} failed")
    }
}
