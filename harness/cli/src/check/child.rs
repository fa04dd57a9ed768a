//! Runs a probe in a process of its own and reads its findings.

use std::{path::Path, time::Instant};

use files::{
    Scratch,
    outcome::{Answer, Outcome},
};
use fmi::{Fmu, conformance::Finding};
use isolation::{Bounds, ChildProcess, Frame, Link, Request, SMALL};

/// Findings of a probe at most, and the length of one in bytes.
const FINDINGS: usize = 10_000;
const LENGTH: usize = 1 << 14;
/// Bytes that a probe may print.
const PRINTED: u64 = 16 << 20;

/// Runs the probe until the deadline, with the whole time until then in s; a crash, a hang or an early end is a finding.
pub(super) fn run(fmu: &Fmu, probe: &str, deadline: (Instant, f64)) -> Vec<Finding> {
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
pub(crate) fn run_probe(link: Link, folder: &Path, name: &str) -> Outcome {
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
