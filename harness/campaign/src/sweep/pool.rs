//! Processes that simulate the runs of a campaign: each takes every n-th run, another one continues where one crashes or hangs.

use std::{
    cell::RefCell,
    ops::Range,
    path::Path,
    sync::{
        atomic::{AtomicBool, Ordering},
        mpsc::Sender,
    },
};

use files::Destination;
use fmi::{Collector, Recording, csv};
use isolation::{
    Bounds, ChildProcess, EndReason, Frame, NOT_REQUESTED, Request, ResourceLimits, Runs, Shown, Supervised,
    interrupt,
};

use super::{histories::HistoryPlace, series::Series, started::Started, worker::RunStatus};
use crate::run::take_row;

/// Result of a run.
#[derive(Clone)]
pub(super) struct RunResult {
    pub run: u64,
    pub status: RunStatus,
    /// Why it is not ok.
    pub reason: String,
    /// Kept numbers, as named by the columns.
    pub numbers: Vec<f64>,
    /// Whether its instance had simulated another run and was reset.
    pub was_reset: bool,
}

/// Why runs are simulated.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Attempt {
    /// They are next.
    First,
    /// Their process was killed from outside; one that is killed again fails.
    Again,
    /// To be compared: nothing of them is written.
    Afresh,
}

/// Common data of the processes.
pub(super) struct Pool<'a> {
    pub started: &'a Started<'a>,
    pub folder: &'a Path,
    pub runs: Range<u64>,
    pub workers: u64,
    pub attempt: Attempt,
    /// Limits of each process.
    pub limits: ResourceLimits,
    pub histories: Option<&'a HistoryPlace>,
    pub series: Option<&'a Series>,
    /// Raised where the rest need not be simulated.
    pub is_over: &'a AtomicBool,
}

/// Why a process is ended where the rest need not be simulated.
const IS_OVER: &str = "the sweep is over";

impl<'a> Pool<'a> {
    /// For one of its runs, in a process of its own.
    pub(super) fn alone(&self, run: u64, attempt: Attempt) -> Self {
        let writes = attempt != Attempt::Afresh;
        Self {
            runs: run..run + 1,
            workers: 1,
            attempt,
            histories: self.histories.filter(|_| writes),
            series: self.series.filter(|_| writes),
            ..*self
        }
    }
}

impl Pool<'_> {
    /// Simulates every n-th run from `worker` on, by as many processes as it takes; an error ends the campaign.
    pub(super) fn follow(&self, worker: u64, results: &Sender<RunResult>) -> Result<(), String> {
        let mut next = self.runs.start + worker;
        let mut is_fresh = self.attempt == Attempt::Afresh;
        while next < self.runs.end && !self.is_done() {
            let mut inbox = Inbox {
                pool: self,
                results,
                next,
                current: None,
                was_reset: false,
                has_ended: false,
                refused: None,
                points: Vec::new(),
                collector: None,
            };
            let supervised = self.one_process(next, is_fresh, &mut inbox)?;
            if let Some(why) = inbox.refused.take() {
                return Err(why);
            }
            if inbox.has_ended || self.is_done() {
                return Ok(());
            }
            match inbox.current {
                Some(run) => inbox.failed(run, &supervised)?,
                // It did not come to a run: with the instance that is reset, a new one each time is left to try.
                None if inbox.next == next && !is_fresh => is_fresh = true,
                None if inbox.next == next => {
                    return Err(format!(
                        "{}: {}",
                        self.started.described.model_name,
                        supervised.without_result()
                    ));
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
    fn one_process(&self, first: u64, is_fresh: bool, inbox: &mut Inbox<'_>) -> Result<Supervised, String> {
        let (campaign, folder) = (self.started.arguments.campaign.as_path().into(), self.folder.into());
        let (stride, end) = (self.workers, self.runs.end);
        let runs = Runs { campaign, folder, first, stride, end, is_fresh };
        let child = ChildProcess::new(Request::Sweep(runs), self.limits, None)?;
        let bounds = Bounds { call_s: self.started.arguments.timeout, ..Bounds::default() };
        let mut shown = Shown::new(&self.started.described.model_name);
        let inbox = RefCell::new(inbox);
        let supervised = child.supervise(
            bounds,
            &mut |frame| inbox.borrow_mut().take(frame),
            &mut |line| shown.line(line),
            &mut |_| if self.is_over.load(Ordering::Relaxed) { Err(IS_OVER.to_owned()) } else { Ok(()) },
        );
        if let EndReason::Refused(why) = &supervised.end_reason
            && ![IS_OVER, NOT_REQUESTED].contains(&why.as_str())
        {
            return Err(why.clone());
        }
        Ok(supervised)
    }
}

/// Takes the frames of a process.
struct Inbox<'a> {
    pool: &'a Pool<'a>,
    results: &'a Sender<RunResult>,
    /// The first run that it has not begun.
    next: u64,
    /// The run that it has begun and not ended, and whether its instance was reset for it.
    current: Option<u64>,
    was_reset: bool,
    has_ended: bool,
    refused: Option<String>,
    /// Percentiles' rows of the current run.
    points: Vec<f64>,
    collector: Option<Collector>,
}

impl Inbox<'_> {
    /// Whether it was the last frame.
    fn take(&mut self, frame: Frame<'_>) -> Result<bool, String> {
        if self.has_ended {
            return Err(NOT_REQUESTED.to_owned());
        }
        let kept = &self.pool.started.campaign.kept;
        match (frame, self.current) {
            (Frame::RunStarted(run, was_reset), None) if run == self.next => {
                self.current = Some(run);
                self.was_reset = was_reset;
                self.next += self.pool.workers;
                self.points.clear();
                let has_history = kept.histories > 0;
                self.collector =
                    has_history.then(|| Collector::new(self.pool.started.described, &kept.positions));
            }
            (Frame::Numbers(numbers), Some(_)) if numbers.len() == kept.percentiles.len() => {
                self.points.extend_from_slice(&numbers);
            }
            (Frame::Row(row), Some(_)) => take_row(&row, self.collector.as_mut().ok_or(NOT_REQUESTED)?)?,
            (Frame::RunEnded(status, numbers, reason), Some(run)) if numbers.len() == kept.count() => {
                let status = *RunStatus::ALL.get(usize::from(status)).ok_or(NOT_REQUESTED)?;
                let (numbers, reason) = (numbers.into_owned(), reason.into_owned());
                self.end(RunResult { run, status, reason, numbers, was_reset: self.was_reset })?;
            }
            (Frame::Done(_), None) => self.has_ended = true,
            (Frame::Failed(why), _) => {
                self.refused = Some(why.into_owned());
                return Ok(true);
            }
            _ => return Err(NOT_REQUESTED.to_owned()),
        }
        Ok(self.has_ended)
    }

    /// A run that its process did not end.
    fn failed(&mut self, run: u64, supervised: &Supervised) -> Result<(), String> {
        let count = self.pool.started.campaign.kept.count();
        let why = supervised.without_result();
        let (status, reason) = match (supervised.end_reason.is_from_outside(), self.pool.attempt) {
            (true, Attempt::First) => (RunStatus::Killed, format!("killed from outside: {why}")),
            _ => (RunStatus::Failed, why),
        };
        let numbers = vec![f64::NAN; count];
        self.end(RunResult { run, status, reason, numbers, was_reset: self.was_reset })
    }

    fn end(&mut self, result: RunResult) -> Result<(), String> {
        self.current = None;
        if let Some(series) = self.pool.series {
            series.put(result.run, &self.points)?;
        }
        if let (Some(place), Some(collector)) = (self.pool.histories, self.collector.take()) {
            let columns = self.pool.started.campaign.kept.histories;
            write_history(place.destination(result.run)?, collector.recording(), columns)?;
        }
        // Without a receiver the campaign is over.
        let _ = self.results.send(result);
        Ok(())
    }
}

fn write_history(destination: Destination, recording: &Recording, columns: usize) -> Result<(), String> {
    destination.fill(|file| {
        csv::write_header(recording, columns, file)?;
        csv::write_rows(recording, columns, 0..recording.times_s.len(), file)
    })
}
