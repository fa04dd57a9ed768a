//! A simulation in a process of its own: the child sends rows, the parent takes them as far as they are expected.

use std::{
    ffi::OsString,
    path::Path,
    process::ExitCode,
    sync::atomic::{AtomicBool, Ordering},
};

use loader::{Collector, Ended, Error, LogMessage, Recording, Row, Rows, Status};

use super::{
    settings::Settings,
    simulated::Simulated,
    subject::{Given, Subject},
};
use crate::{
    args::RunInChild,
    child::{Bounds, ChildProcess, EndReason, LARGE, Link, Payload, Shown, push_text},
    outcome::Outcome,
};

/// Kinds of frames: a row, a message of the log, the end of the simulation, its failure.
const ROW: u8 = 1;
const MESSAGE: u8 = 2;
const ENDED: u8 = 3;
const FAILED: u8 = 4;

const ENDS: [Ended; 3] = [Ended::AtStop, Ended::Cancelled, Ended::ByItself];
/// Messages taken at most: as many as an instance keeps.
const MESSAGES: usize = 1000;

/// What came of a simulation.
pub struct SimulationResult {
    /// Why it ended.
    pub outcome: Result<Ended, String>,
    /// What the instance logged.
    pub messages: Vec<LogMessage>,
    /// What went wrong after a good end.
    pub fault: Option<String>,
}

/// What runs in a child process.
pub struct InChild<'a> {
    /// The FMU or system.
    pub subject: &'a Subject,
    /// What the parent read from the standard input.
    pub input_copy: Option<&'a Path>,
    /// Longest time that an FMI call may take.
    pub timeout_s: Option<f64>,
}

/// Runs in a child process. `tick` is shown the recording so far and the beginning of the step in progress.
pub fn simulate(
    in_child: &InChild<'_>,
    points: u64,
    collector: &mut Collector,
    mut tick: impl FnMut(&Recording, Option<f64>) -> Result<(), String>,
) -> SimulationResult {
    let InChild { subject, input_copy, timeout_s } = *in_child;
    let option = |name: &str, path: &Path| {
        let mut option = OsString::from(name);
        option.push(path);
        option
    };
    let own = [OsString::from("run-in-child"), option("--unpacked-in=", &subject.folder())];
    let own = own.into_iter().chain(input_copy.map(|path| option("--input-copy=", path)));
    // After the program and `run`: the child reads the same arguments.
    let arguments = own.chain(std::env::args_os().skip(2));
    let child = match ChildProcess::new(arguments, LARGE, &[]) {
        Ok(child) => child,
        Err(error) => {
            let outcome = Err(format!("the process of the FMU cannot be started: {error}"));
            return SimulationResult { outcome, messages: Vec::new(), fault: None };
        }
    };
    let mut inbox = Inbox::new(collector, points);
    let inbox_cell = std::cell::RefCell::new(&mut inbox);
    let mut shown = Shown::new(subject.name());
    let supervised = child.supervise(
        Bounds { call_s: timeout_s, ..Bounds::default() },
        &mut |kind, payload| inbox_cell.borrow_mut().take(kind, payload),
        &mut |line| shown.line(line),
        &mut |calls| tick(inbox_cell.borrow().collector.recording(), calls.and_then(loader::step_begin_s)),
    );
    let Inbox { outcome, messages, .. } = inbox;
    let name = supervised.calls.instance.map_or_else(|| subject.name().to_owned(), |it| subject.named(it));
    if let Some(left) = supervised.left_behind() {
        terminal::note(&format!("{name}: {left}"));
    }
    let fault = supervised.fault().map(|fault| format!("{name}: {fault}"));
    let outcome = match (outcome, &supervised.how) {
        (Some(outcome), EndReason::Refused(why)) => outcome.and(Err(why.clone())),
        (Some(outcome), _) => outcome,
        (None, EndReason::Interrupted) => {
            terminal::note(&format!("{name}: {}", supervised.without_result()));
            Ok(Ended::Cancelled)
        }
        (None, EndReason::Refused(why)) => Err(why.clone()),
        (None, _) => Err(format!("{name}: {}", supervised.without_result())),
    };
    SimulationResult { outcome, messages, fault }
}

/// Takes the frames of a simulation.
struct Inbox<'a> {
    collector: &'a mut Collector,
    widths: [usize; 4],
    rows_left: u64,
    reals: Vec<f64>,
    integers: Vec<i32>,
    booleans: Vec<i32>,
    texts: Vec<String>,
    outcome: Option<Result<Ended, String>>,
    messages: Vec<LogMessage>,
}

impl<'a> Inbox<'a> {
    fn new(collector: &'a mut Collector, points: u64) -> Self {
        Self {
            widths: collector.widths(),
            collector,
            // One more where the FMU ends by itself between two points.
            rows_left: points.saturating_add(1),
            reals: Vec::new(),
            integers: Vec::new(),
            booleans: Vec::new(),
            texts: Vec::new(),
            outcome: None,
            messages: Vec::new(),
        }
    }

    /// Whether it was the last frame.
    fn take(&mut self, kind: u8, mut payload: Payload<'_>) -> Result<bool, String> {
        const NOT_REQUESTED: &str = "it sent what was not requested";
        if self.outcome.is_some() {
            return Err(NOT_REQUESTED.to_owned());
        }
        match kind {
            ROW => {
                self.rows_left = self.rows_left.checked_sub(1).ok_or(NOT_REQUESTED)?;
                let time_s = self.row(&mut payload).filter(|_| payload.is_empty()).ok_or(NOT_REQUESTED)?;
                let Self { collector, reals, integers, booleans, texts, .. } = self;
                let row = Row { time_s, reals, integers, booleans, texts };
                collector.take(&row).map_err(|error| error.to_string())?;
            }
            MESSAGE if self.messages.len() < MESSAGES => {
                self.messages.push(message(&mut payload).ok_or(NOT_REQUESTED)?);
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

    fn row(&mut self, payload: &mut Payload<'_>) -> Option<f64> {
        let time_s = f64::from_bits(payload.word()?);
        let [reals, integers, booleans, texts] = self.widths;
        self.reals.clear();
        self.reals.extend(payload.words(reals)?.iter().map(|word| f64::from_bits(*word)));
        let whole = |word: &u64| *word as u32 as i32;
        self.integers.clear();
        self.integers.extend(payload.words(integers)?.iter().map(whole));
        self.booleans.clear();
        self.booleans.extend(payload.words(booleans)?.iter().map(whole));
        self.texts.clear();
        for _ in 0..texts {
            self.texts.push(payload.text()?);
        }
        Some(time_s)
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
        let whole = |value: &i32| u64::from(*value as u32);
        self.0
            .send(ROW, |payload| {
                payload.push(row.time_s.to_bits());
                payload.extend(row.reals.iter().map(|value| value.to_bits()));
                payload.extend(row.integers.iter().map(whole));
                payload.extend(row.booleans.iter().map(whole));
                row.texts.iter().for_each(|text| push_text(payload, text));
            })
            .map_err(Error::Rows)
    }
}

/// Runs in this process and sends the parent what comes of it.
pub fn run(arguments: &RunInChild) -> Outcome {
    let mut link = Link::attach().map_err(|error| format!("`heliotorque run` starts this: {error}"))?;
    match simulation(arguments, &mut link) {
        Ok((ended, messages)) => {
            for message in &messages {
                link.send(MESSAGE, |payload| {
                    payload.push(u64::from(message.status.code() as u32));
                    payload.push(u64::from(message.category.is_some()));
                    message.category.iter().for_each(|category| push_text(payload, category));
                    push_text(payload, &message.text);
                })?;
            }
            let number = ENDS.iter().position(|end| *end == ended).unwrap_or(0);
            link.send(ENDED, |payload| payload.push(number as u64))?;
        }
        Err(error) => {
            let text = loader::Error::chain(error.as_ref());
            link.send(FAILED, |payload| push_text(payload, &text))?;
        }
    }
    // The failure is reported; the parent reads how the process ends.
    Ok(ExitCode::SUCCESS)
}

fn simulation(
    arguments: &RunInChild,
    link: &mut Link,
) -> Result<(Ended, Vec<LogMessage>), Box<dyn std::error::Error>> {
    let subject = Subject::open(&arguments.unpacked_in)?;
    let simulated = Simulated::of(&arguments.run)?;
    let settings = Settings::of(&subject, &simulated, arguments.input_copy.as_deref())?;
    let (cancel, cancel_word) = (AtomicBool::new(link.is_cancelled()), link.cancel_word());
    let mut check_cancel = |_: f64| {
        if cancel_word.load(Ordering::Relaxed) != 0 {
            cancel.store(true, Ordering::Relaxed);
        }
    };
    let given = Given {
        sets: settings.sets,
        inputs: settings.inputs.as_ref(),
        positions: settings.positions,
        progress: &mut check_cancel,
        cancel: &cancel,
    };
    Ok(subject.simulate_into(&simulated.run, given, &mut RowSender(link))?)
}
