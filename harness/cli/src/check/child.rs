//! Runs a probe in a process of its own and reads its findings.

use std::{ffi::OsString, path::PathBuf, time::Instant};

use clap::Args;
use files::{
    Scratch,
    outcome::{Answer, Outcome},
};
use fmi::{
    Fmu,
    conformance::{Finding, Verdict},
};
use isolation::{Bounds, ChildProcess, Link, Payload, SMALL, push_text};

/// `heliotorque probe-in-child`.
#[derive(Debug, Args)]
pub(crate) struct Probe {
    /// The FMU
    pub fmu: PathBuf,
    /// The probe
    pub name: String,
}

/// Kinds of frames: a finding, the probe's end.
const FINDING: u8 = 1;
const FINISHED: u8 = 2;

/// Findings of a probe at most, and the length of one in bytes.
const FINDINGS: usize = 10_000;
const LENGTH: usize = 1 << 14;
/// Bytes that a probe may print.
const PRINTED: u64 = 16 << 20;

/// Runs the probe until the deadline, with the whole time until then in s; a crash, a hang or an early end is a finding.
pub(super) fn run(fmu: &Fmu, probe: &str, deadline: (Instant, f64)) -> Vec<Finding> {
    let started = || {
        // What a probe leaves when it is ended goes with this folder.
        let scratch = Scratch::new()?;
        let arguments = [OsString::from("probe-in-child"), fmu.folder().into(), probe.into()];
        Ok::<_, std::io::Error>((ChildProcess::new(arguments, SMALL, Some(scratch.path()))?, scratch))
    };
    match started() {
        Ok((child, _scratch)) => supervise(child, deadline),
        Err(error) => vec![Finding::bad(format!("the probe cannot be started: {error}"))],
    }
}

/// Runs one probe or trial in this process and sends its findings to the parent.
pub(crate) fn run_probe(arguments: &Probe) -> Outcome {
    let mut link = Link::attach("heliotorque check")?;
    let fmu = Fmu::open(&arguments.fmu)?;
    let findings = fmi::conformance::run(&fmu, &arguments.name)
        .ok_or_else(|| format!("there is no probe {:?}", arguments.name))?;
    for finding in &findings {
        link.send(FINDING, |payload| {
            payload.push(finding.verdict as u64);
            let text = &finding.text;
            let cut = text.floor_char_boundary(LENGTH);
            push_text(payload, &if cut < text.len() { format!("{}...", &text[..cut]) } else { text.clone() });
        })?;
    }
    link.send(FINISHED, |_| {})?;
    Ok(Answer::Yes)
}

fn decode(mut payload: Payload<'_>) -> Option<Finding> {
    let verdict = payload.word()?;
    let verdict = Verdict::ALL.into_iter().find(|it| *it as u64 == verdict)?;
    Some(Finding::new(verdict, payload.text()?))
}

fn supervise(child: ChildProcess, deadline: (Instant, f64)) -> Vec<Finding> {
    let mut findings = Vec::new();
    let mut finished = false;
    let mut take = |kind: u8, payload: Payload<'_>| match kind {
        FINISHED => {
            finished = true;
            Ok(true)
        }
        FINDING if findings.len() < FINDINGS => {
            let finding = decode(payload).ok_or("it sent what is no finding")?;
            findings.push(finding);
            Ok(false)
        }
        FINDING => Err(format!("it sent more than {FINDINGS} findings")),
        _ => Err("it sent what is no finding".to_owned()),
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
