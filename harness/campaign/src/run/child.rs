//! A simulation in a process of its own: the child sends rows, the parent takes them as far as they are expected.

use std::{
    cell::RefCell,
    ffi::OsString,
    fs::File,
    io,
    path::{Path, PathBuf},
    sync::atomic::{AtomicBool, Ordering},
};

use files::outcome::{Answer, Outcome};
use fmi::{Collector, Ended, Error, LogMessage, Recording, Row, Rows, Status, Watcher};
use isolation::{
    Bounds, ChildProcess, EndReason, Link, NOT_REQUESTED, Payload, Shown, large, path_option, push_text,
};
use tables::output::Visit;

use super::{options::Run, settings::Settings, simulated::Simulated, subject::Subject, visits::Visits};

/// Run of an FMU that the parent unpacked.
#[derive(Clone, Debug)]
pub struct RunInChild {
    /// The folder that the FMU was unpacked into.
    pub unpacked_in: PathBuf,
    /// Copy of the standard input of the parent.
    pub input_copy: Option<PathBuf>,
    /// Request of the parent.
    pub run: Run,
}

/// Kinds of frames: a row, a message of the log, the end of the simulation, its failure, a visit.
const ROW: u8 = 1;
const MESSAGE: u8 = 2;
const ENDED: u8 = 3;
const FAILED: u8 = 4;
const VISIT: u8 = 5;

const ENDS: [Ended; 3] = [Ended::AtStop, Ended::Cancelled, Ended::ByItself];
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
pub(super) fn start(subject: &Subject, input_copy: Option<&Path>) -> io::Result<ChildProcess> {
    let own = [OsString::from("run-in-child"), path_option("--unpacked-in=", &subject.folder())];
    let own = own.into_iter().chain(input_copy.map(|path| path_option("--input-copy=", path)));
    // After the program and `run`: the child reads the same arguments.
    ChildProcess::new(own.chain(std::env::args_os().skip(2)), large(1), None)
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
        &mut |kind, payload| inbox.borrow_mut().take(kind, payload),
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
    fn take(&mut self, kind: u8, mut payload: Payload<'_>) -> Result<bool, String> {
        if self.outcome.is_some() {
            return Err(NOT_REQUESTED.to_owned());
        }
        match kind {
            ROW => {
                self.rows_left = self.rows_left.checked_sub(1).ok_or(NOT_REQUESTED)?;
                take_row(&mut payload, self.collector)?;
            }
            MESSAGE if self.messages.len() < MESSAGES => {
                self.messages.push(message(&mut payload).ok_or(NOT_REQUESTED)?);
            }
            VISIT if self.visits.len() < VISITS => {
                self.visits.push(Visit::read(&mut payload).ok_or(NOT_REQUESTED)?);
            }
            ENDED => {
                let ended =
                    payload.word().and_then(|number| ENDS.get(usize::try_from(number).ok()?).copied());
                self.outcome = Some(Ok(ended.ok_or(NOT_REQUESTED)?));
            }
            FAILED => self.outcome = Some(Err(payload.text().ok_or(NOT_REQUESTED)?)),
            _ => return Err(NOT_REQUESTED.to_owned()),
        }
        Ok(self.outcome.is_some())
    }
}

fn message(payload: &mut Payload<'_>) -> Option<LogMessage> {
    let status = Status::from_code(payload.word()? as u32 as i32).unwrap_or(Status::Error);
    let category = if payload.word()? == 0 { None } else { Some(payload.text()?) };
    Some(LogMessage { status, category, text: payload.text()? })
}

/// Sends rows to the parent.
struct RowSender<'a>(&'a mut Link);

impl Rows for RowSender<'_> {
    fn take(&mut self, row: &Row<'_>) -> Result<(), Error> {
        self.0.send(ROW, |payload| push_row(payload, row)).map_err(Error::Rows)
    }
}

/// Appends a row to a payload, as [`take_row`] reads it.
pub(crate) fn push_row(payload: &mut Vec<u64>, row: &Row<'_>) {
    let whole = |value: &i32| u64::from(*value as u32);
    payload.push(row.time_s.to_bits());
    payload.extend(row.reals.iter().map(|value| value.to_bits()));
    payload.extend(row.integers.iter().map(whole));
    payload.extend(row.booleans.iter().map(whole));
    row.texts.iter().for_each(|text| push_text(payload, text));
}

/// Hands the row of a payload to a collector.
///
/// # Errors
/// A row that the collector does not wait for, more than memory is given for.
pub(crate) fn take_row(payload: &mut Payload<'_>, collector: &mut Collector) -> Result<(), String> {
    let [reals, integers, booleans, texts] = collector.widths();
    let time_s = f64::from_bits(payload.word().ok_or(NOT_REQUESTED)?);
    let mut words = |count: usize| payload.words(count).ok_or(NOT_REQUESTED);
    let whole = |words: &[u64]| words.iter().map(|word| *word as u32 as i32).collect::<Vec<i32>>();
    let reals: Vec<f64> = words(reals)?.iter().map(|word| f64::from_bits(*word)).collect();
    let (integers, booleans) = (whole(words(integers)?), whole(words(booleans)?));
    let texts = (0..texts).map(|_| payload.text()).collect::<Option<Vec<String>>>();
    let texts = texts.filter(|_| payload.is_empty()).ok_or(NOT_REQUESTED)?;
    let row = Row { time_s, reals: &reals, integers: &integers, booleans: &booleans, texts: &texts };
    collector.take(&row).map_err(|error| error.to_string())
}

/// End of a simulation, with its log and its visits.
type Simulation = (Ended, Vec<LogMessage>, Vec<Visit>);

/// Runs in this process and sends the parent what comes of it.
pub fn run(arguments: &RunInChild) -> Outcome {
    let mut link = Link::attach("heliotorque run")?;
    match simulation(arguments, &mut link) {
        Ok((ended, messages, visits)) => {
            for message in &messages {
                link.send(MESSAGE, |payload| {
                    payload.push(u64::from(message.status.code() as u32));
                    payload.push(u64::from(message.category.is_some()));
                    message.category.iter().for_each(|category| push_text(payload, category));
                    push_text(payload, &message.text);
                })?;
            }
            for visit in &visits {
                link.send(VISIT, |payload| visit.push(payload))?;
            }
            let number = ENDS.iter().position(|end| *end == ended).unwrap_or(0);
            link.send(ENDED, |payload| payload.push(number as u64))?;
        }
        Err(error) => {
            let text = fmi::Error::chain(error.as_ref());
            link.send(FAILED, |payload| push_text(payload, &text))?;
        }
    }
    // The failure is reported; the parent reads how the process ends.
    Ok(Answer::Yes)
}

fn simulation(arguments: &RunInChild, link: &mut Link) -> Result<Simulation, Box<dyn std::error::Error>> {
    let subject = Subject::open(&arguments.unpacked_in)?;
    let simulated = Simulated::new(&arguments.run)?;
    let settings = Settings::new(&subject, &simulated, arguments.input_copy.as_deref())?;
    if let Some(path) = &arguments.run.log_calls {
        fmi::log_calls(File::options().append(true).open(path)?);
    }
    let cancel_word = link.cancel_word();
    let cancel = AtomicBool::new(false);
    let mut check_cancel = |_: f64| cancel.store(cancel_word.load(Ordering::Relaxed) != 0, Ordering::Relaxed);
    check_cancel(0.0);
    let mut visits = Visits::new(&subject, &settings);
    let watcher = visits.as_mut().map(|visits| visits as &mut dyn Watcher);
    let watched = (&mut check_cancel as &mut dyn FnMut(f64), &cancel, watcher);
    let ran = settings.simulate_into(&subject, &simulated.run, watched, &mut RowSender(link));
    let (ended, messages) = ran?;
    Ok((ended, messages, visits.map(Visits::into_visits).unwrap_or_default()))
}
