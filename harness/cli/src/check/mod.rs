//! `heliotorque check`: everything that can be wrong with an FMU, found and named.
//!
//! What can be read is checked here: archive, description, exported symbols. What has to be run is run as probes,
//! each in a process of its own, so that an FMU that crashes or hangs is a finding and not the end.

mod child;
mod files;
mod mission;
mod options;
mod report;
mod system;

use std::{
    path::Path,
    time::{Duration, Instant},
};

use fmi::{
    Fmu,
    conformance::{Finding, PROBES, Probe as Probed, Trial, Verdict},
};
use packing::{carried, pointing};

use ::files::outcome::Outcome;
pub(crate) use child::run_probe;
pub(crate) use options::Check;
use report::{Listed, Section};

/// Checks an FMU, a system or a spacecraft and prints the report.
pub(crate) fn run(arguments: &Check) -> Outcome {
    if arguments.is_file() {
        return match (arguments.is_static, &arguments.probe) {
            (false, None) => {
                let file = arguments.subject.display().to_string();
                report::print_judged(&file, &files::judged(arguments, &file)?, arguments.json)
            }
            (true, _) => Err("--static is for an FMU: a spacecraft is only read".into()),
            (false, Some(_)) => Err("--probe is for an FMU: a spacecraft has no probes".into()),
        };
    }
    if systems::is_system(&arguments.subject) {
        if arguments.probe.is_some() || arguments.template.is_some() {
            return Err("--probe and --template are for an FMU or a spacecraft, and this is a system".into());
        }
        check_there(&arguments.subject)?;
        return report(arguments, &[Section::new("system", system::findings(&arguments.subject))]);
    }
    if arguments.template.is_some() {
        return Err("--template is for a spacecraft (.toml): an FMU is checked by its own library".into());
    }
    if let Some(text) = &arguments.probe
        && !PROBES.iter().any(|probe| is_selected(arguments, probe))
    {
        let names: Vec<&str> = PROBES.iter().map(|probe| probe.name).collect();
        return Err(
            format!("no probe's name contains {text:?}, allowed: {}: see --probe", names.join(", ")).into()
        );
    }
    check_there(&arguments.subject)?;
    let fmu = match Fmu::open(&arguments.subject) {
        Ok(fmu) => fmu,
        Err(error) => {
            let finding = Finding::bad(fmi::Error::chain(&error));
            return report(arguments, &[Section::new("archive", vec![finding])]);
        }
    };
    let mut sections = vec![
        Section::new("archive", fmi::conformance::archive(&fmu)),
        Section::new("modelDescription.xml", fmi::conformance::description(&fmu)),
    ];
    let folder = [(String::new(), fmu.folder().to_owned())];
    let windows = pointing::warnings(fmu.description(), &[], &pointing::windows_in(&folder));
    if !windows.is_empty() {
        sections.push(Section::new("orbit", windows.into_iter().map(Finding::note)));
    }
    let panels = carried::timeline::warnings(fmu.description(), &[], &folder);
    if !panels.is_empty() {
        sections.push(Section::new("panels", panels.into_iter().map(Finding::note)));
    }
    sections.extend(carried::summaries(&fmu).into_iter().map(|(file, read)| match read {
        Ok(summary) => Section::new(file, vec![Finding::good(summary)]),
        Err(problems) => Section::new(file, problems.lines().map(Finding::bad)),
    }));
    if !arguments.is_static && fmu.co_simulation().is_ok() {
        probe(arguments, &fmu, &mut sections);
    }
    report(arguments, &sections)
}

/// Refuses a file that is not there.
fn check_there(path: &Path) -> Result<(), String> {
    path.metadata().map(drop).map_err(|error| format!("{}: {error}", path.display()))
}

/// Whether `--probe` leaves a probe in.
fn is_selected(arguments: &Check, probe: &Probed) -> bool {
    arguments.probe.as_ref().is_none_or(|text| probe.name.contains(text.as_str()))
}

/// Runs the probes with their trials until the time is over.
fn probe(arguments: &Check, fmu: &Fmu, sections: &mut Vec<Section>) {
    let deadline = arguments.deadline();
    let loads = child::run(fmu, "library", deadline);
    // A library that loads leaves something to try, whatever it lacks.
    let usable = loads.first().is_some_and(|finding| finding.verdict == Verdict::Good);
    sections.push(Section::new("library", loads));
    let rest = PROBES.iter().filter(|probe| usable && probe.name != "library");
    for probe in rest.filter(|probe| is_selected(arguments, probe)) {
        let trials = fmi::conformance::trials().filter(|trial| trial.probe == probe.name);
        let mut findings: Vec<Listed> = Vec::new();
        for trial in [None].into_iter().chain(trials.map(Some)) {
            if Instant::now() >= deadline.0 {
                let what = format!("the {} s of the check are over (see --timeout)", deadline.1);
                findings.push(Finding::skipped(what).into());
                break;
            }
            findings.extend(match trial {
                None => child::run(fmu, probe.name, deadline).into_iter().map(Into::into).collect(),
                Some(trial) => try_out(fmu, trial, deadline),
            });
        }
        sections.push(Section::new(format!("{}: {}", probe.name, probe.title), findings));
    }
}

/// Longest wait for the answer to a call that makes no sense.
const SENSELESS_PATIENCE: Duration = Duration::from_secs(5);

/// Runs a trial; what an FMU that is lost in it leaves behind names the call.
fn try_out(fmu: &Fmu, trial: &Trial, deadline: (Instant, f64)) -> Vec<Listed> {
    let soon = (Instant::now() + SENSELESS_PATIENCE, SENSELESS_PATIENCE.as_secs_f64());
    let deadline = if trial.senseless && soon.0 < deadline.0 { soon } else { deadline };
    let mut findings: Vec<Listed> =
        child::run(fmu, &trial.name(), deadline).into_iter().map(Into::into).collect();
    let hung = Instant::now() >= deadline.0;
    let bad = findings.iter_mut().map(|it| &mut it.finding).filter(|it| it.verdict == Verdict::Bad);
    for finding in bad {
        finding.text = format!("{}, {}: {}", trial.call, trial.what, finding.text);
        if trial.disputed || hung && trial.senseless {
            finding.verdict = Verdict::Note;
        }
    }
    findings
}

fn report(arguments: &Check, sections: &[Section]) -> Outcome {
    report::print(&arguments.subject.display().to_string(), sections, arguments.verbose, arguments.json)
}
