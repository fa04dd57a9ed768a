//! Probes of an FMU, each in a process of its own, and their findings.

use std::{
    path::Path,
    time::{Duration, Instant},
};

use files::{
    Scratch,
    outcome::{Answer, Outcome},
};
use fmi::{
    Fmu,
    conformance::{Finding, Listed, PROBES, Probe, Section, Trial, Verdict},
};

use crate::{
    channel::Link,
    frame::{Frame, Request},
    limits::SMALL,
    supervisor::{Bounds, ChildProcess},
};

/// Findings of a probe at most, and the length of one in bytes.
const FINDINGS: usize = 10_000;
const LENGTH: usize = 1 << 14;
/// Bytes that a probe may print.
const PRINTED: u64 = 16 << 20;

/// Runs the probes that are selected, with their trials, until the deadline, with the whole time until then in s.
pub fn sections(fmu: &Fmu, is_selected: impl Fn(&Probe) -> bool, deadline: (Instant, f64)) -> Vec<Section> {
    let loads = run(fmu, "library", deadline);
    // A library that loads leaves something to try, whatever it lacks.
    let usable = loads.first().is_some_and(|finding| finding.verdict == Verdict::Good);
    let mut sections = vec![Section::new("library", loads)];
    let rest = PROBES.iter().filter(|probe| usable && probe.name != "library");
    for probe in rest.filter(|probe| is_selected(probe)) {
        let trials = fmi::conformance::trials().filter(|trial| trial.probe == probe.name);
        let mut findings: Vec<Listed> = Vec::new();
        for trial in [None].into_iter().chain(trials.map(Some)) {
            if Instant::now() >= deadline.0 {
                let what = format!("the {} s of the check are over (see --timeout)", deadline.1);
                findings.push(Finding::skipped(what).into());
                break;
            }
            findings.extend(match trial {
                None => run(fmu, probe.name, deadline).into_iter().map(Into::into).collect(),
                Some(trial) => try_out(fmu, trial, deadline),
            });
        }
        sections.push(Section::new(format!("{}: {}", probe.name, probe.title), findings));
    }
    sections
}

/// Longest wait for the answer to a call that makes no sense.
const SENSELESS_PATIENCE: Duration = Duration::from_secs(5);

/// Runs a trial; what an FMU that is lost in it leaves behind names the call.
fn try_out(fmu: &Fmu, trial: &Trial, deadline: (Instant, f64)) -> Vec<Listed> {
    let soon = (Instant::now() + SENSELESS_PATIENCE, SENSELESS_PATIENCE.as_secs_f64());
    let deadline = if trial.senseless && soon.0 < deadline.0 { soon } else { deadline };
    let mut findings: Vec<Listed> = run(fmu, &trial.name(), deadline).into_iter().map(Into::into).collect();
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

/// Runs the probe until the deadline, with the whole time until then in s; a crash, a hang or an early end is a finding.
fn run(fmu: &Fmu, probe: &str, deadline: (Instant, f64)) -> Vec<Finding> {
    let started = || {
        // What a probe leaves when it is ended goes with this folder.
        let scratch = Scratch::new().map_err(|error| error.to_string())?;
        let request = Request::Probe { folder: fmu.folder().into(), name: probe.to_owned() };
        Ok::<_, String>((ChildProcess::new(request, SMALL, Some(scratch.path()))?, scratch))
    };
    match started() {
        Ok((child, _scratch)) => supervise(child, deadline),
        Err(error) => vec![Finding::bad(error)],
    }
}

/// Runs one probe or trial in this process and sends its findings to the parent.
///
/// # Errors
/// A parent that went away.
pub fn run_in_child(link: Link, folder: &Path, name: &str) -> Outcome {
    link.answer(|link| {
        let fmu = Fmu::open(folder)?;
        let findings =
            fmi::conformance::run(&fmu, name).ok_or_else(|| format!("there is no probe {name:?}"))?;
        for mut finding in findings {
            let cut = finding.text.floor_char_boundary(LENGTH);
            if cut < finding.text.len() {
                finding.text.replace_range(cut.., "...");
            }
            link.send(&Frame::Finding(finding))?;
        }
        Ok(Some(Frame::Done(Answer::Yes)))
    })
}

fn supervise(child: ChildProcess, deadline: (Instant, f64)) -> Vec<Finding> {
    let mut findings = Vec::new();
    let mut finished = false;
    let mut take = |frame: Frame<'_>| {
        match frame {
            Frame::Done(_) => finished = true,
            Frame::Failed(why) => return Err(why.into_owned()),
            Frame::Finding(finding) if findings.len() < FINDINGS => findings.push(finding),
            Frame::Finding(_) => return Err(format!("it sent more than {FINDINGS} findings")),
            _ => return Err("it sent what is no finding".to_owned()),
        }
        Ok(finished)
    };
    let bounds = Bounds { deadline: Some(deadline), call_s: None, printed: Some(PRINTED) };
    let supervised = child.supervise(bounds, &mut take, &mut |_| {}, &mut |_| Ok(()));
    match supervised.fault() {
        Some(fault) => findings.push(Finding::bad(fault)),
        None if !finished => findings.push(Finding::bad(supervised.without_result())),
        None => {}
    }
    findings.extend(supervised.left_behind().map(Finding::note));
    findings
}
