//! Processes that simulate the runs of a campaign: each takes every n-th run, another one continues where one crashes or hangs.

use std::{
    cell::RefCell,
    ffi::OsString,
    ops::Range,
    path::{Path, PathBuf},
    sync::{
        atomic::{AtomicBool, Ordering},
        mpsc::Sender,
    },
};

use files::Destination;
use loader::{Collector, Recording, csv};
use model_description::Description;

use super::{
    resolved::Campaign,
    series::Series,
    worker::{ALL_ENDED, BEGUN, ENDED, POINT, REFUSED, ROW, RunStatus},
};
use crate::{
    child::{Bounds, ChildProcess, EndReason, LARGE, NOT_REQUESTED, Payload, Shown, path_option},
    interrupt,
    run::take_row,
};

/// What came of a run.
pub(super) struct RunResult {
    pub run: u64,
    pub status: RunStatus,
    /// Why it is not ok.
    pub reason: String,
    /// What is kept, as named by its columns.
    pub numbers: Vec<f64>,
}

/// What the processes have in common.
pub(super) struct Pool<'a> {
    pub file: &'a Path,
    pub campaign: &'a Campaign,
    pub described: &'a Description,
    pub folder: &'a Path,
    pub runs: Range<u64>,
    pub workers: u64,
    /// Longest time of a call in s.
    pub timeout_s: Option<f64>,
    pub histories: Option<&'a Path>,
    pub series: Option<&'a Series>,
    /// Raised where the rest need not be simulated.
    pub is_over: &'a AtomicBool,
}

/// Why a process is ended where the rest need not be simulated.
const IS_OVER: &str = "the sweep is over";

impl Pool<'_> {
    /// Simulates every n-th run from `worker` on, by as many processes as it takes; an error ends the campaign.
    pub(super) fn follow(&self, worker: u64, results: &Sender<RunResult>) -> Result<(), String> {
        let mut next = self.runs.start + worker;
        let mut is_fresh = false;
        while next < self.runs.end && !self.is_done() {
            let mut inbox = Inbox {
                pool: self,
                results,
                next,
                current: None,
                has_ended: false,
                refused: None,
                points: Vec::new(),
                collector: None,
            };
            let end_reason = self.one_process(next, is_fresh, &mut inbox)?;
            if let Some(why) = inbox.refused.take() {
                return Err(why);
            }
            if inbox.has_ended || self.is_done() {
                return Ok(());
            }
            match inbox.current {
                Some(run) => inbox.failed(run, &end_reason)?,
                // It did not come to a run: with the instance that is reset, a new one each time is left to try.
                None if inbox.next == next && !is_fresh => is_fresh = true,
                None if inbox.next == next => {
                    return Err(format!("{}: {end_reason}", self.described.model_name));
                }
                None => {}
            }
            next = inbox.next;
        }
        Ok(())
    }

    fn is_done(&self) -> bool {
        interrupt::raised() || self.is_over.load(Ordering::Relaxed)
    }

    /// Until a process has ended; how it did.
    fn one_process(&self, first: u64, is_fresh: bool, inbox: &mut Inbox<'_>) -> Result<String, String> {
        let mut arguments = vec![
            OsString::from("sweep-in-child"),
            path_option("--campaign=", self.file),
            path_option("--unpacked-in=", self.folder),
            format!("--first={first}").into(),
            format!("--stride={}", self.workers).into(),
            format!("--end={}", self.runs.end).into(),
        ];
        arguments.extend(is_fresh.then(|| "--fresh".into()));
        let child = ChildProcess::new(arguments, LARGE, None)
            .map_err(|error| format!("a process of the FMU cannot be started: {error}"))?;
        let bounds = Bounds { call_s: self.timeout_s, ..Bounds::default() };
        let mut shown = Shown::new(&self.described.model_name);
        let inbox = RefCell::new(inbox);
        let supervised = child.supervise(
            bounds,
            &mut |kind, payload| inbox.borrow_mut().take(kind, payload),
            &mut |line| shown.line(line),
            &mut |_| if self.is_over.load(Ordering::Relaxed) { Err(IS_OVER.to_owned()) } else { Ok(()) },
        );
        if let EndReason::Refused(why) = &supervised.end_reason
            && ![IS_OVER, NOT_REQUESTED].contains(&why.as_str())
        {
            return Err(why.clone());
        }
        Ok(supervised.without_result())
    }
}

/// Takes the frames of a process.
struct Inbox<'a> {
    pool: &'a Pool<'a>,
    results: &'a Sender<RunResult>,
    /// The first run that it has not begun.
    next: u64,
    /// The run that it has begun and not ended.
    current: Option<u64>,
    has_ended: bool,
    refused: Option<String>,
    /// Percentiles' rows of the current run.
    points: Vec<f64>,
    collector: Option<Collector>,
}

impl Inbox<'_> {
    /// Whether it was the last frame.
    fn take(&mut self, kind: u8, mut payload: Payload<'_>) -> Result<bool, String> {
        if self.has_ended {
            return Err(NOT_REQUESTED.to_owned());
        }
        match (kind, self.current) {
            (BEGUN, None) => {
                let run = payload.word().filter(|run| *run == self.next).ok_or(NOT_REQUESTED)?;
                self.current = Some(run);
                self.next += self.pool.workers;
                self.points.clear();
                let Campaign { kept, .. } = self.pool.campaign;
                let has_history = self.pool.histories.is_some();
                self.collector = has_history.then(|| Collector::new(self.pool.described, &kept.positions));
            }
            (POINT, Some(_)) => {
                let words = payload.words(self.pool.campaign.kept.percentiles.len()).ok_or(NOT_REQUESTED)?;
                self.points.extend(words.iter().map(|word| f64::from_bits(*word)));
            }
            (ROW, Some(_)) => {
                take_row(&mut payload, self.collector.as_mut().ok_or(NOT_REQUESTED)?)?;
            }
            (ENDED, Some(run)) => {
                let number = payload.word().and_then(|it| usize::try_from(it).ok()).ok_or(NOT_REQUESTED)?;
                let status = *RunStatus::ALL.get(number).ok_or(NOT_REQUESTED)?;
                let count = self.pool.campaign.kept.columns(self.pool.described).len();
                let words = payload.words(count).ok_or(NOT_REQUESTED)?;
                let numbers = words.iter().map(|word| f64::from_bits(*word)).collect();
                let reason = payload.text().ok_or(NOT_REQUESTED)?;
                self.end(RunResult { run, status, reason, numbers })?;
            }
            (ALL_ENDED, None) => self.has_ended = true,
            (REFUSED, _) => {
                self.refused = Some(payload.text().ok_or(NOT_REQUESTED)?);
                return Ok(true);
            }
            _ => return Err(NOT_REQUESTED.to_owned()),
        }
        Ok(self.has_ended)
    }

    /// A run that its process did not end.
    fn failed(&mut self, run: u64, end_reason: &str) -> Result<(), String> {
        let count = self.pool.campaign.kept.columns(self.pool.described).len();
        let numbers = vec![f64::NAN; count];
        self.end(RunResult { run, status: RunStatus::Failed, reason: end_reason.to_owned(), numbers })
    }

    fn end(&mut self, result: RunResult) -> Result<(), String> {
        self.current = None;
        if let Some(series) = self.pool.series {
            series.put(result.run, &self.points)?;
        }
        if let (Some(folder), Some(collector)) = (self.pool.histories, self.collector.take()) {
            write_history(folder, result.run, collector.recording(), self.pool.campaign.kept.histories)?;
        }
        // Without a receiver the campaign is over.
        let _ = self.results.send(result);
        Ok(())
    }
}

/// The table over time of a run.
pub(super) fn history_path(folder: &Path, run: u64) -> PathBuf {
    folder.join(format!("run-{run}.csv"))
}

fn write_history(folder: &Path, run: u64, recording: &Recording, columns: usize) -> Result<(), String> {
    Destination::open(&history_path(folder, run), "keep.histories", &[])?.fill(|file| {
        csv::write_header(recording, columns, file)?;
        csv::write_rows(recording, columns, 0..recording.times_s.len(), file)
    })
}
