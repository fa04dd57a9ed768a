//! `heliotorque check`: everything that can be wrong with an FMU, found and named.
//!
//! What can be read is checked here: archive, description, exported symbols. What has to be run is run as probes,
//! each in a process of its own, so that an FMU that crashes or hangs is a finding and not the end.

mod child;
mod figures;
mod mission;
mod problems;
mod spacecraft;
mod system;
mod timeline;

use std::{
    process::ExitCode,
    time::{Duration, Instant},
};

use conformance::{Finding, PROBES, Probe, Trial, Verdict};
use loader::Fmu;

use crate::{
    args::{self, Check},
    child::Link,
    ephemeris,
    kind::FileKind,
    low_orbit,
    outcome::Outcome,
    timeline as carried_timeline,
};

/// A group of findings under one heading.
struct Section {
    title: String,
    findings: Vec<Finding>,
}

impl Section {
    /// The worst finding; what was skipped counts only where nothing else was found.
    fn verdict(&self) -> Verdict {
        let verdicts = || self.findings.iter().map(|finding| finding.verdict);
        let worst = verdicts().filter(|verdict| *verdict != Verdict::Skipped).max();
        worst.or_else(|| verdicts().max()).unwrap_or(Verdict::Good)
    }
}

/// Whether it is about a file that a library reads, which this process then loads.
pub fn is_file(arguments: &Check) -> bool {
    arguments.subject.extension().is_some_and(|extension| extension == "toml")
}

/// Longest time in s that is counted: beyond it no clock may go.
const LONGEST_S: f64 = 1e9;

/// When all of it has to be over, and the time until then in s.
pub fn deadline(arguments: &Check) -> (Instant, f64) {
    (Instant::now() + Duration::from_secs_f64(arguments.timeout.min(LONGEST_S)), arguments.timeout)
}

/// Checks an FMU, a system or a spacecraft and prints the report.
pub fn run(arguments: &Check) -> Outcome {
    if is_file(arguments) {
        return match (arguments.is_static, &arguments.only) {
            (false, None) => match ephemeris::read(&arguments.subject)? {
                Some(read) => ephemeris::run_check(&arguments.subject, read),
                None => {
                    let text = files::read_text(&arguments.subject)?;
                    match FileKind::of(&text) {
                        FileKind::Spacecraft => spacecraft::run(arguments),
                        FileKind::Mission => mission::run(arguments),
                        FileKind::Timeline => timeline::run(arguments, &text),
                    }
                }
            },
            (true, _) => Err("--static is for an FMU: a spacecraft is only read".into()),
            (false, Some(_)) => Err("--only is for an FMU: a spacecraft has no probes".into()),
        };
    }
    if systems::is_system(&arguments.subject) {
        if arguments.only.is_some() || arguments.template.is_some() {
            return Err("--only and --template are for an FMU or a spacecraft, and this is a system".into());
        }
        let findings = system::findings(&arguments.subject);
        return report(arguments, &[Section { title: "system".to_owned(), findings }]);
    }
    if arguments.template.is_some() {
        return Err("--template is for a spacecraft (.toml): an FMU is checked by its own library".into());
    }
    let is_selected =
        |probe: &&Probe| arguments.only.as_ref().is_none_or(|only| probe.name.contains(only.as_str()));
    if let Some(only) = &arguments.only
        && !PROBES.iter().any(|probe| is_selected(&probe))
    {
        let names: Vec<&str> = PROBES.iter().map(|probe| probe.name).collect();
        return Err(
            format!("no probe's name contains {only:?}, allowed: {}: see --only", names.join(", ")).into()
        );
    }
    let mut sections = Vec::new();
    let fmu = match Fmu::open(&arguments.subject) {
        Ok(fmu) => fmu,
        Err(error) => {
            let finding = Finding::bad(loader::Error::chain(&error));
            sections.push(Section { title: "archive".to_owned(), findings: vec![finding] });
            return report(arguments, &sections);
        }
    };
    sections.push(Section { title: "archive".to_owned(), findings: conformance::archive(&fmu) });
    sections
        .push(Section { title: "modelDescription.xml".to_owned(), findings: conformance::description(&fmu) });
    let low = low_orbit::warnings(fmu.description(), &[]);
    if !low.is_empty() {
        let findings = low.into_iter().map(Finding::note).collect();
        sections.push(Section { title: "orbit".to_owned(), findings });
    }
    if let Some(read) = carried_timeline::of(&fmu) {
        let findings = match read {
            Ok(timeline) => vec![Finding::good(carried_timeline::summary(&timeline))],
            Err(problems) => problems.lines().map(Finding::bad).collect(),
        };
        sections.push(Section { title: carried_timeline::FILE.to_owned(), findings });
    }
    if let Some(read) = ephemeris::of(&fmu) {
        let findings = match read {
            Ok(carried) => vec![Finding::good(ephemeris::summary(&carried))],
            Err(problems) => problems.lines().map(Finding::bad).collect(),
        };
        sections.push(Section { title: ephemeris::FILE.to_owned(), findings });
    }
    let runnable = !arguments.is_static && fmu.co_simulation().is_ok();
    if runnable {
        let deadline = deadline(arguments);
        let loads = child::run(&fmu, "library", deadline);
        // A library that loads leaves something to try, whatever it lacks.
        let usable = loads.first().is_some_and(|finding| finding.verdict == Verdict::Good);
        sections.push(Section { title: "library".to_owned(), findings: loads });
        if usable {
            for probe in PROBES.iter().filter(|probe| probe.name != "library").filter(is_selected) {
                let trials = conformance::trials().filter(|trial| trial.probe == probe.name);
                let mut findings = Vec::new();
                for trial in [None].into_iter().chain(trials.map(Some)) {
                    if Instant::now() >= deadline.0 {
                        let what = format!("the {} s of the check are over (see --timeout)", deadline.1);
                        findings.push(Finding::skipped(what));
                        break;
                    }
                    findings.extend(match trial {
                        None => child::run(&fmu, probe.name, deadline),
                        Some(trial) => try_out(&fmu, trial, deadline),
                    });
                }
                sections.push(Section { title: format!("{}: {}", probe.name, probe.title), findings });
            }
        }
    }
    report(arguments, &sections)
}

/// Longest wait for the answer to a call that makes no sense.
const SENSELESS_PATIENCE: Duration = Duration::from_secs(5);

/// Runs a trial; what an FMU that is lost in it leaves behind names the call.
fn try_out(fmu: &Fmu, trial: &Trial, deadline: (Instant, f64)) -> Vec<Finding> {
    let soon = (Instant::now() + SENSELESS_PATIENCE, SENSELESS_PATIENCE.as_secs_f64());
    let deadline = if trial.senseless && soon.0 < deadline.0 { soon } else { deadline };
    let mut findings = child::run(fmu, &trial.name(), deadline);
    let hung = Instant::now() >= deadline.0;
    for finding in findings.iter_mut().filter(|finding| finding.verdict == Verdict::Bad) {
        finding.text = format!("{}, {}: {}", trial.call, trial.what, finding.text);
        if trial.disputed || hung && trial.senseless {
            finding.verdict = Verdict::Note;
        }
    }
    findings
}

/// Runs one probe or trial in this process and sends its findings to the parent.
pub fn run_probe(arguments: &args::Probe) -> Outcome {
    let mut link = Link::attach().map_err(|error| format!("`heliotorque check` starts this: {error}"))?;
    let fmu = Fmu::open(&arguments.fmu)?;
    let findings = conformance::run(&fmu, &arguments.name)
        .ok_or_else(|| format!("there is no probe {:?}", arguments.name))?;
    child::report(&mut link, &findings)?;
    Ok(ExitCode::SUCCESS)
}

fn report(arguments: &Check, sections: &[Section]) -> Outcome {
    let mut text = format!("{}\n\n", arguments.subject.display());
    for section in sections {
        let worst = section.verdict();
        text.push_str(&format!("{:>8}  {}\n", worst.word(), section.title));
        for finding in &section.findings {
            let shown = arguments.verbose || matches!(finding.verdict, Verdict::Note | Verdict::Bad);
            if shown || worst == Verdict::Skipped {
                let lines = finding.text.replace('\n', "\n            ");
                text.push_str(&format!("          {:<8}{lines}\n", finding.verdict.word()));
            }
        }
    }
    let count = |verdict: Verdict| {
        sections.iter().flat_map(|section| &section.findings).filter(|it| it.verdict == verdict).count()
    };
    text.push_str(&format!(
        "\n{} good, {} skipped, {} to note, {} wrong",
        count(Verdict::Good),
        count(Verdict::Skipped),
        count(Verdict::Note),
        count(Verdict::Bad)
    ));
    terminal::print(&text)?;
    Ok(if count(Verdict::Bad) == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
