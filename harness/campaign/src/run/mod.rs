//! `heliotorque run`: runs an FMU or a system in a process of its own, records, writes, draws.

pub mod checked;
mod child;
pub mod options;
mod settings;
mod simulated;
mod subject;

use std::{
    error::Error,
    fs::File,
    io,
    path::{Path, PathBuf},
    time::Instant,
};

pub use child::run as run_in_child;
pub(crate) use child::take_row;
use files::{
    Destination, Scratch,
    outcome::{self, Answer, Outcome},
};
use fmi::{Collector, Ended, LogMessage, RecordedPoints, Times};
use inputs::{ending::by_ending, epoch, variables};
use isolation::Bounds;
pub use options::Run;
use packing::{
    carried, pointing,
    visits::{self, VisitTable},
};
pub use settings::Settings;
pub use simulated::{Simulated, assemble_into};
pub use subject::Subject;
use tables::output::{self, DisplayContext, LimitChecks, Origin, Outputs};

/// Warnings of an FMU that are shown without `--log`.
const MAX_WARNINGS: usize = 20;

/// Why a run ends before its stop.
const LOST_READER: &str = "nobody reads the standard output any more";

/// A run whose arguments were accepted as far as they can be judged without the FMU's library.
pub struct Prepared {
    /// The arguments and the mission.
    pub simulated: Simulated,
    /// FMU or system that is run.
    pub subject: Subject,
    /// Resolved arguments.
    pub settings: Settings,
    /// Points that will be recorded.
    pub points: u64,
    outputs: Outputs,
    /// File of the visits.
    visits: Option<Destination>,
    /// Contents of the standard input, for parent and child.
    input_copy: Option<PathBuf>,
    // The packed FMU of a mission and the copy, as long as they are in use.
    _scratch: [Option<Scratch>; 2],
}

impl Prepared {
    /// Tells what looks odd before the run.
    fn note_warnings(&self) {
        let Self { simulated: Simulated { run, .. }, subject, settings, .. } = self;
        if run.quiet {
            return;
        }
        let Settings { times, sets, inputs, .. } = settings;
        let described = subject.description();
        let every_s = run.every.unwrap_or(times.step_s);
        carried::timeline::warnings(described, sets, &subject.parts())
            .into_iter()
            .chain(variables::repeated("--set", &run.set))
            .chain(long_step(times))
            .chain(subject.unread(sets))
            .chain(inputs.iter().flat_map(|it| it.warnings(described, times)))
            .chain(pointing::sparse_rows(described, sets, times, every_s))
            .for_each(|warning| terminal::note(&format!("warning: {warning}")));
    }

    /// Opens the FMU and every output.
    ///
    /// # Errors
    /// Whatever is refused, by the flag or the mission's line.
    pub fn new(arguments: &Run) -> Result<Self, Box<dyn Error>> {
        by_ending(&arguments.output, options::FORMATS)?;
        let simulated = Simulated::new(arguments)?;
        let (subject, packed) = simulated.open()?;
        subject.check_options(&simulated.run)?;
        let copied =
            copied_input(&simulated.run).map_err(|error| format!("standard input: {error}: see --input"))?;
        let (copy, input_copy) = copied.unzip();
        let settings = Settings::new(&subject, &simulated, input_copy.as_deref())?;
        subject.check_libraries()?;
        let described = subject.description();
        let context = DisplayContext::new(&subject.parts(), described, &settings.sets, &settings.limits)
            .dated(epoch::zero_epoch_s(described, &settings.sets, settings.times.start_s));
        let collector = Collector::new(described, &settings.positions);
        let origin = Origin {
            file: arguments.fmu.clone(),
            fmus: subject.fmus().into_iter().map(|(prefix, fmu)| (prefix, fmu.description())).collect(),
            described,
            times: settings.times,
            sets: &settings.sets,
            input: simulated.run.input.clone(),
        };
        let reads = simulated.reads();
        let has_visits = carried::timeline::names(&subject.folder()).is_some_and(|names| !names.is_empty());
        let table = settings.requested.table.as_ref().filter(|_| has_visits);
        let visits = table.map(|table| output::open_beside(table, ("visits", visits::HEADER), &reads));
        let visits = visits.transpose()?.flatten();
        let outputs = Outputs::open(&settings.requested, collector.recording(), &context, (&origin, &reads))?;
        let points = RecordedPoints::new(&settings.times, simulated.run.every)?.count();
        collector.fits(points)?;
        let _scratch = [packed, copy];
        Ok(Self { simulated, subject, settings, points, outputs, visits, input_copy, _scratch })
    }
}

/// A file with what the standard input holds, in a folder that goes with it, where `--input -` says so.
fn copied_input(arguments: &Run) -> io::Result<Option<(Scratch, PathBuf)>> {
    if arguments.input.as_deref() != Some(Path::new("-")) {
        return Ok(None);
    }
    let scratch = Scratch::new()?;
    let path = scratch.path().join("input.csv");
    io::copy(&mut io::stdin().lock(), &mut File::create_new(&path)?)?;
    Ok(Some((scratch, path)))
}

/// A warning where the step is longer than the run.
pub fn long_step(times: &Times) -> Option<String> {
    let Times { start_s, stop_s, step_s } = *times;
    let [run, step] = [stop_s - start_s, step_s].map(terminal::short);
    (step_s > stop_s - start_s).then(|| {
        format!(
            "the step of {step} s is longer than the run of {run} s, which is one step: see --step and --stop"
        )
    })
}

/// Makes the file of calls empty, to which the child appends.
fn begin_call_log(simulated: &Simulated) -> Result<(), String> {
    let Some(path) = &simulated.run.log_calls else { return Ok(()) };
    let log = Destination::open(path, "--log-calls", &simulated.reads())?;
    if log.is_stdout() {
        return Err("-: found the standard output, allowed: a file: see --log-calls".to_owned());
    }
    log.fill(|_| Ok(()))
}

/// Shows the FMU's log, or its first warnings.
fn note_log(messages: &[LogMessage], arguments: &Run) {
    if arguments.log {
        messages.iter().for_each(|it| terminal::note(&format!("{} {it}", it.status)));
    } else if !arguments.quiet {
        let logged = fmi::warnings(messages);
        logged.iter().take(MAX_WARNINGS).for_each(|text| terminal::note(&format!("warning: {text}")));
        if let Some(more) = logged.len().checked_sub(MAX_WARNINGS).filter(|more| *more > 0) {
            terminal::note(&format!("warning: {more} more: see --log"));
        }
    }
}

/// Shows the visits and writes them to their file.
fn write_visits(table: &VisitTable<'_>, file: Option<Destination>, is_quiet: bool) -> Result<(), String> {
    if !is_quiet {
        terminal::note(&table.shown());
    }
    outcome::write_all(file.map(|file| (file, table.csv())), is_quiet)
}

/// Runs in a child process.
pub fn run(arguments: &Run) -> Outcome {
    let prepared = Prepared::new(arguments)?;
    prepared.note_warnings();
    let Prepared { simulated, subject, settings, points, mut outputs, visits, input_copy, _scratch } =
        prepared;
    let arguments = &simulated.run;
    let described = subject.description();
    let zero_epoch_s = simulated.zero_epoch_s(settings.times.start_s);
    let Settings { times, positions, limits, requested, .. } = settings;
    let has_limits = !limits.is_empty();
    let mut checks = LimitChecks::new(limits);
    let mut collector = Collector::new(described, &positions);
    begin_call_log(&simulated)?;
    let child = child::start(&subject, input_copy.as_deref())?;
    let bounds = Bounds { call_s: arguments.timeout, ..Bounds::default() };
    let progress = terminal::progress((times.stop_s - times.start_s) as u64, "s", arguments.quiet);
    let began = Instant::now();
    let result = child::simulate(child, &subject, (bounds, points), &mut collector, |recording, time_s| {
        if let Some(time_s) = time_s {
            progress.set_position((time_s - times.start_s).max(0.0) as u64);
        }
        checks.update(recording);
        outputs.update(recording)?;
        if outputs.has_lost_reader() { Err(LOST_READER.to_owned()) } else { Ok(()) }
    });
    let elapsed = began.elapsed();
    progress.finish_and_clear();
    let recording = collector.recording();
    checks.update(recording);
    note_log(&result.messages, arguments);
    let last_s = recording.times_s.last().copied().unwrap_or(times.start_s);
    let last = terminal::short(last_s);
    if outputs.has_lost_reader() {
        // Nobody is there for the rest; what is drawn and checked at the end is not, and that is no success.
        return if requested.plots.is_empty() && !has_limits {
            Ok(Answer::Yes)
        } else {
            Err(format!("{LOST_READER}: the run ends at {last} s, without pictures and limits").into())
        };
    }
    let rows = recording.times_s.len();
    let so_far = |kept: Vec<PathBuf>| -> String {
        kept.iter().map(|path| format!("\n{rows} rows so far: {}", path.display())).collect()
    };
    let ended = match result.outcome {
        Ok(ended) => ended,
        // What was simulated until then is worth keeping.
        Err(error) => return Err(format!("{error}{}", so_far(outputs.leave(described, recording))).into()),
    };
    // Part of a recording does not replace a complete one.
    let kept = match ended {
        Ended::Cancelled => outputs.stop(described, recording)?,
        _ => outputs.finish(described, recording).map(|()| Vec::new())?,
    };
    if !result.visits.is_empty() {
        let names = carried::timeline::names(&subject.folder()).unwrap_or_default();
        let table = VisitTable { visits: &result.visits, names: &names, zero_epoch_s };
        write_visits(&table, visits, arguments.quiet)?;
    }
    if !arguments.quiet {
        let steps = ((last_s - times.start_s) / times.step_s).ceil();
        terminal::note(&format!("{steps} steps to {last} s in {:.3} s", elapsed.as_secs_f64()));
    }
    if !arguments.quiet || !checks.is_kept() {
        checks.report(described, zero_epoch_s).iter().for_each(|line| terminal::note(line));
    }
    match ended {
        Ended::AtStop => {}
        Ended::ByItself => terminal::note(&format!("{} ended by itself at {last} s", subject.name())),
        Ended::Cancelled => {
            let what = "what was recorded until then is written";
            terminal::note(&format!("interrupted at {last} s; {what}{}", so_far(kept)));
            return Ok(Answer::Interrupted);
        }
    }
    // The recording is complete; with a fault the FMU is not what it should be.
    result.fault.map_or_else(|| Ok(checks.is_kept().into()), |fault| Err(fault.into()))
}
