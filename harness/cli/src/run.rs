//! `heliotorque run`: runs an FMU or a system in a process of its own, records, writes, draws.

use std::{error::Error, process::ExitCode, time::Instant};

use files::Scratch;
use loader::{Collector, Ended, LogMessage, RecordedPoints};

use crate::{
    args::{Run, RunInChild},
    interrupt::INTERRUPTED,
    low_orbit,
    mission::Judge,
    outcome::Outcome,
    output::{self, Known, Outputs},
};

mod child;
mod input_copy;
pub mod settings;
pub mod simulated;
pub mod subject;

use input_copy::InputCopy;
use settings::Settings;
use simulated::Simulated;
use subject::Subject;

/// Why a run ends before its stop.
const LOST_READER: &str = "nobody reads the standard output any more";

/// A run of which everything was accepted that can be refused without the FMU's library.
pub struct Prepared {
    /// The arguments and the mission.
    pub simulated: Simulated,
    /// What is run.
    pub subject: Subject,
    /// What they mean.
    pub settings: Settings,
    /// Points that will be recorded.
    pub points: u64,
    outputs: Outputs,
    input_copy: Option<InputCopy>,
    // The packed FMU of a mission, as long as it is in use.
    _packed: Option<Scratch>,
}

impl Prepared {
    /// Opens what flies and every output.
    ///
    /// # Errors
    /// Whatever is refused, by the flag or the mission's line.
    pub fn of(arguments: &Run) -> Result<Self, Box<dyn Error>> {
        if let Some(path) = &arguments.plot {
            output::check_svg_path(path, "--plot")?;
        }
        let simulated = Simulated::of(arguments)?;
        let (subject, _packed) = simulated.open()?;
        subject.check_options(&simulated.run)?;
        let input_copy = InputCopy::of(&simulated.run)?;
        let copy = input_copy.as_ref().map(InputCopy::path);
        let settings = Settings::of(&subject, &simulated, copy.as_deref())?;
        subject.check_libraries()?;
        let described = subject.description();
        let known = Known::of(&subject.parts(), described, &settings.sets, &settings.limits);
        let collector = Collector::new(described, &settings.positions);
        let outputs = Outputs::open(&settings.requested, collector.recording(), &known, &simulated.reads())?;
        let points = RecordedPoints::new(&settings.times, simulated.run.every)?.count();
        collector.fits(points)?;
        Ok(Self { simulated, subject, settings, points, outputs, input_copy, _packed })
    }
}

/// Runs in a child process.
pub fn run(arguments: &Run) -> Outcome {
    let prepared = Prepared::of(arguments)?;
    let Prepared { simulated, subject, settings, points, mut outputs, input_copy, _packed } = prepared;
    let arguments = &simulated.run;
    let described = subject.description();
    let warnings = low_orbit::warnings(described, &settings.sets);
    let Settings { times, positions, limits, requested, .. } = settings;
    if !arguments.quiet {
        warnings.iter().for_each(|warning| terminal::note(&format!("warning: {warning}")));
    }
    let is_judged = !limits.is_empty();
    let mut judge = Judge::new(limits);
    let mut collector = Collector::new(described, &positions);
    let copy = input_copy.as_ref().map(InputCopy::path);

    let progress = terminal::progress((times.stop_s - times.start_s) as u64, "s", arguments.quiet);
    let began = Instant::now();
    let in_child =
        child::InChild { subject: &subject, input_copy: copy.as_deref(), timeout_s: arguments.timeout };
    let result = child::simulate(&in_child, points, &mut collector, |recording, time_s| {
        if let Some(time_s) = time_s {
            progress.set_position((time_s - times.start_s).max(0.0) as u64);
        }
        judge.update(recording);
        outputs.update(recording)?;
        if outputs.has_lost_reader() { Err(LOST_READER.to_owned()) } else { Ok(()) }
    });
    let elapsed = began.elapsed();
    progress.finish_and_clear();

    let recording = collector.recording();
    judge.update(recording);
    if arguments.log {
        print_log(&result.messages);
    }
    let last_s = recording.times_s.last().copied().unwrap_or(times.start_s);
    if outputs.has_lost_reader() {
        // Nobody is there for the rest; what is drawn and judged at the end is not, and that is no success.
        return if requested.plots.is_empty() && !is_judged {
            Ok(ExitCode::SUCCESS)
        } else {
            let last = terminal::short(last_s);
            Err(format!("{LOST_READER}: the run ends at {last} s, without pictures and judgement").into())
        };
    }
    let ended = match result.outcome {
        Ok(ended) => ended,
        Err(error) => {
            // What was simulated until then is worth keeping.
            let kept = outputs.leave(described, recording);
            let rows = recording.times_s.len();
            let kept: String =
                kept.iter().map(|path| format!("\n{rows} rows so far: {}", path.display())).collect();
            return Err(format!("{error}{kept}").into());
        }
    };
    // Part of a recording does not replace a complete one.
    let kept = match ended {
        Ended::Cancelled => outputs.stop(described, recording)?,
        _ => outputs.finish(described, recording).map(|()| Vec::new())?,
    };
    if !arguments.quiet {
        let steps = ((last_s - times.start_s) / times.step_s).ceil();
        let (last, elapsed) = (terminal::short(last_s), elapsed.as_secs_f64());
        terminal::note(&format!("{steps} steps to {last} s in {elapsed:.3} s"));
    }
    if !arguments.quiet || !judge.is_kept() {
        let zero_s = simulated.mission.as_ref().and_then(|mission| Some(mission.epoch_s.as_ref()?.it));
        let lines = judge.report(described, zero_s.map(|zero_s| zero_s - times.start_s));
        lines.iter().for_each(|line| terminal::note(line));
    }
    match ended {
        Ended::AtStop => {}
        Ended::ByItself => {
            let (name, last) = (subject.name(), terminal::short(last_s));
            terminal::note(&format!("{name} ended by itself at {last} s"));
        }
        Ended::Cancelled => {
            let last = terminal::short(last_s);
            let rows = recording.times_s.len();
            let kept: String =
                kept.iter().map(|path| format!("\n{rows} rows so far: {}", path.display())).collect();
            terminal::note(&format!(
                "interrupted at {last} s; what was recorded until then is written{kept}"
            ));
            return Ok(ExitCode::from(INTERRUPTED));
        }
    }
    match result.fault {
        // The recording is complete, the FMU is not what it should be.
        Some(fault) => Err(fault.into()),
        None if !judge.is_kept() => Ok(ExitCode::FAILURE),
        None => Ok(ExitCode::SUCCESS),
    }
}

/// Runs the FMU in this process for the parent.
pub fn run_in_child(arguments: &RunInChild) -> Outcome {
    child::run(arguments)
}

fn print_log(messages: &[LogMessage]) {
    for message in messages {
        terminal::note(&format!("{} {message}", message.status));
    }
}
