//! `heliotorque run`: runs an FMU or a system in a process of its own, records, writes, draws.

use std::{process::ExitCode, time::Instant};

use loader::{Collector, Ended, LogMessage};

use crate::{
    args::{Run, RunInChild},
    interrupt::INTERRUPTED,
    mission::Judge,
    outcome::Outcome,
    output::{self, Known, Outputs},
};

mod child;
pub mod flown;
mod input_copy;
pub mod settings;
pub mod subject;

use flown::Flown;
use input_copy::InputCopy;
use settings::Settings;

/// Runs in a child process.
pub fn run(arguments: &Run) -> Outcome {
    if let Some(path) = &arguments.plot {
        output::check_svg_path(path, "--plot")?;
    }
    let flown = Flown::of(arguments)?;
    let arguments = &flown.run;
    let (subject, _packed) = flown.open()?;
    subject.check_options(arguments)?;
    // Everything that can be refused without the FMU's library is refused here.
    let copy = InputCopy::of(arguments)?;
    let input_copy = copy.as_ref().map(InputCopy::path);
    let settings = Settings::of(&subject, &flown, input_copy.as_deref())?;
    subject.check_libraries()?;
    let described = subject.description();
    let known = Known::of(&subject.parts(), described, &settings.sets, &settings.limits);
    let mut outputs = Outputs::open(arguments, &settings.plots, settings.columns, &known, &flown.reads())?;
    let Settings { times, positions, limits, .. } = settings;
    let mut judge = Judge::new(limits);
    let mut collector = Collector::new(described, &positions);
    let every = loader::steps_between_points(&times, arguments.every)?;
    let points = times.steps().div_ceil(every).saturating_add(1);
    collector.fits(points)?;

    let progress = terminal::progress((times.stop_s - times.start_s) as u64, "s", arguments.quiet);
    let began = Instant::now();
    let in_child =
        child::InChild { subject: &subject, input_copy: input_copy.as_deref(), timeout_s: arguments.timeout };
    let simulated = child::simulate(&in_child, points, &mut collector, |recording, time_s| {
        if let Some(time_s) = time_s {
            progress.set_position((time_s - times.start_s).max(0.0) as u64);
        }
        judge.update(recording);
        outputs.update(recording)
    });
    let elapsed = began.elapsed();
    progress.finish_and_clear();

    let recording = collector.recording();
    judge.update(recording);
    if arguments.log {
        print_log(&simulated.messages);
    }
    let last_s = recording.times_s.last().copied().unwrap_or(times.start_s);
    let ended = match simulated.outcome {
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
    outputs.finish(described, recording)?;
    if !arguments.quiet {
        let steps = ((last_s - times.start_s) / times.step_s).ceil();
        let (last, elapsed) = (terminal::short(last_s), elapsed.as_secs_f64());
        terminal::note(&format!("{steps} steps to {last} s in {elapsed:.3} s"));
    }
    if !arguments.quiet || !judge.is_kept() {
        let zero_s = flown.mission.as_ref().and_then(|mission| Some(mission.epoch_s.as_ref()?.it));
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
            terminal::note(&format!("interrupted at {last} s; what was recorded until then is written"));
            return Ok(ExitCode::from(INTERRUPTED));
        }
    }
    match simulated.fault {
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
