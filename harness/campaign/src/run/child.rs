//! A simulation in a process of its own: the child sends rows, the parent takes them as far as they are expected.

use std::{cell::RefCell, fs::File, path::Path, sync::atomic::Ordering};

use files::outcome::Outcome;
use fmi::{Collector, Ended, Error, LogMessage, Recording, Row, Rows, Status, Watcher};
use isolation::{Bounds, ChildProcess, EndReason, Frame, Link, NOT_REQUESTED, Request, Shown, large};
use packing::visits::{Visit, Visits};

use super::{options::Run, settings::Settings, simulated::Simulated, subject::Subject};

/// Messages taken at most: as many as an instance keeps.
const MESSAGES: usize = 1000;
/// Visits taken at most: a timeline has 10,000 commands, each with an end before the next one begins.
const VISITS: usize = 20_001;

/// Result of a simulation.
pub(super) struct SimulationResult {
    /// Why it ended.
    pub outcome: Result<Ended, String>,
    /// Messages of the instance's log.
    pub messages: Vec<LogMessage>,
    /// Visits of a flight by a timeline.
    pub visits: Vec<Visit>,
    /// Fault after a good end.
    pub fault: Option<String>,
}

/// Starts the child process of a run; `input_copy` is what the parent read from the standard input.
pub(super) fn start(subject: &Subject, input_copy: Option<&Path>) -> Result<ChildProcess, String> {
    // The child reads the same arguments.
    let arguments = std::env::args_os().skip(1).collect();
    let input_copy = input_copy.map(Into::into);
    let request = Request::Run { arguments, folder: subject.folder().into(), input_copy };
    ChildProcess::new(request, large(1), None)
}

/// Takes the rows of the child process up to the last point, each FMI call within its bounds. `tick` is shown the recording so far and the beginning of
/// the step in progress.
pub(super) fn simulate(
    child: ChildProcess,
    subject: &Subject,
    (bounds, points): (Bounds, u64),
    collector: &mut Collector,
    mut tick: impl FnMut(&Recording, Option<f64>) -> Result<(), String>,
) -> SimulationResult {
    // One more row where the FMU ends by itself between two points.
    let rows_left = points.saturating_add(1);
    let inbox = Inbox { collector, rows_left, outcome: None, messages: Vec::new(), visits: Vec::new() };
    let inbox = RefCell::new(inbox);
    let mut shown = Shown::new(subject.name());
    let supervised = child.supervise(
        bounds,
        &mut |frame| inbox.borrow_mut().take(frame),
        &mut |line| shown.line(line),
        &mut |calls| tick(inbox.borrow().collector.recording(), calls.and_then(fmi::step_begin_s)),
    );
    let Inbox { outcome, messages, visits, .. } = inbox.into_inner();
    let name = supervised.calls.instance.map_or_else(|| subject.name().to_owned(), |it| subject.named(it));
    if let Some(left) = supervised.left_behind() {
        terminal::note(&format!("{name}: {left}"));
    }
    let fault = supervised.fault().map(|fault| format!("{name}: {fault}"));
    let outcome = match (outcome, &supervised.end_reason) {
        (Some(outcome), EndReason::Refused(why)) => outcome.and(Err(why.clone())),
        (Some(outcome), _) => outcome,
        (None, EndReason::Interrupted) => {
            terminal::note(&format!("{name}: {}", supervised.without_result()));
            Ok(Ended::Cancelled)
        }
        (None, EndReason::Refused(why)) => Err(why.clone()),
        (None, _) => Err(format!("{name}: {}", supervised.without_result())),
    };
    SimulationResult { outcome, messages, visits, fault }
}

/// Takes the frames of a simulation.
struct Inbox<'a> {
    collector: &'a mut Collector,
    rows_left: u64,
    outcome: Option<Result<Ended, String>>,
    messages: Vec<LogMessage>,
    visits: Vec<Visit>,
}

impl Inbox<'_> {
    /// Whether it was the last frame.
    fn take(&mut self, frame: Frame<'_>) -> Result<bool, String> {
        if self.outcome.is_some() {
            return Err(NOT_REQUESTED.to_owned());
        }
        match frame {
            Frame::Row(row) => {
                self.rows_left = self.rows_left.checked_sub(1).ok_or(NOT_REQUESTED)?;
                take_row(&row, self.collector)?;
            }
            Frame::Message(status, category, text) if self.messages.len() < MESSAGES => {
                let status = Status::from_code(status).unwrap_or(Status::Error);
                let [category, text] = [category, Some(text)].map(|it| it.map(str::to_owned));
                self.messages.push(LogMessage { status, category, text: text.unwrap_or_default() });
            }
            Frame::Numbers(numbers) if self.visits.len() < VISITS => {
                self.visits.push(Visit::from_numbers(&numbers).ok_or(NOT_REQUESTED)?);
            }
            Frame::Ended(ended) => self.outcome = Some(Ok(ended)),
            Frame::Failed(why) => self.outcome = Some(Err(why.into_owned())),
            _ => return Err(NOT_REQUESTED.to_owned()),
        }
        Ok(self.outcome.is_some())
    }
}

/// Hands the row of a child to a collector.
///
/// # Errors
/// A row that the collector does not wait for, more than memory is given for.
pub(crate) fn take_row(row: &Row<'_>, collector: &mut Collector) -> Result<(), String> {
    if row.widths() != collector.widths() {
        return Err(NOT_REQUESTED.to_owned());
    }
    collector.take(row).map_err(|error| error.to_string())
}

/// Sends rows to the parent.
struct RowSender<'a>(&'a mut Link);

impl Rows for RowSender<'_> {
    fn take(&mut self, row: &Row<'_>) -> Result<(), Error> {
        self.0.send(&Frame::Row(row.clone())).map_err(Error::Rows)
    }
}

/// Runs an FMU or a system that the parent unpacked, and sends the parent what comes of it.
pub fn run(link: Link, folder: &Path, input_copy: Option<&Path>, run: &Run) -> Outcome {
    link.answer(|link| {
        let subject = Subject::open(folder)?;
        let simulated = Simulated::new(run)?;
        let settings = Settings::new(&subject, &simulated, input_copy)?;
        if let Some(path) = &run.log_calls {
            fmi::log_calls(File::options().append(true).open(path)?);
        }
        let cancel_word = link.cancel_word();
        let mut goes_on = |_: f64| cancel_word.load(Ordering::Relaxed) == 0;
        let mut visits = match &subject {
            Subject::Fmu(fmu) => Visits::new(fmu, settings.times.stop_s, settings.given(fmu.description())),
            Subject::System(_) => None,
        };
        let watcher = visits.as_mut().map(|visits| visits as &mut dyn Watcher);
        let watched = (&mut goes_on as &mut dyn FnMut(f64) -> bool, watcher);
        let ran = settings.simulate_into(&subject, &simulated.run, watched, &mut RowSender(link));
        let (ended, messages) = ran?;
        for LogMessage { status, category, text } in &messages {
            link.send(&Frame::Message(status.code(), category.as_deref(), text))?;
        }
        for visit in visits.map(Visits::into_visits).unwrap_or_default() {
            link.send(&Frame::Numbers(visit.numbers().into()))?;
        }
        Ok(Some(Frame::Ended(ended)))
    })
}
