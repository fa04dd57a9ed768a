//! `heliotorque run`: flies an FMU, records, writes, draws.

use std::{
    io::IsTerminal,
    path::{Path, PathBuf},
    process::ExitCode,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::Instant,
};

use indicatif::{ProgressBar, ProgressStyle};
use loader::{Ended, Fmu, InputTable, InstanceOptions, LogMessage, Options, Recording, Times};

use crate::{app::Outcome, args::Run, destination::Destination, output, plot};

/// The usual exit status of a program that Ctrl-C ended.
const INTERRUPTED: u8 = 130;

/// Flies the FMU.
pub fn run(arguments: &Run) -> Outcome {
    if let Some(path) = &arguments.plot {
        plot::check_path(path)?;
    }
    let fmu = Fmu::open(&arguments.fmu)?;
    let times = Times::of(&fmu, arguments.start, arguments.stop, arguments.step)?;
    let mut sets = Vec::new();
    for setting in &arguments.set {
        sets.extend(loader::parse_assignment(&fmu, setting)?);
    }
    let inputs = arguments.input.as_deref().map(|path| read_table(&fmu, path)).transpose()?;
    let record = selection(&fmu, &arguments.record)?;

    let cancel = interruptible()?;
    // After all that can be refused, before what takes long.
    let files = Files::open(arguments)?;
    let progress = progress_bar(&times, arguments.quiet);
    let mut advance = |time_s: f64| {
        progress.set_position((time_s - times.start_s) as u64);
    };
    let began = Instant::now();
    let outcome = loader::simulate(
        &fmu,
        Options {
            start_s: arguments.start,
            stop_s: arguments.stop,
            step_s: arguments.step,
            record_every_s: arguments.every,
            sets,
            inputs: inputs.as_ref(),
            input_derivatives: arguments.slopes,
            record,
            instance: InstanceOptions { logging: arguments.log, ..InstanceOptions::default() },
            progress: (!progress.is_hidden()).then_some(&mut advance),
            cancel: Some(&cancel),
        },
    );
    let elapsed = began.elapsed();
    progress.finish_and_clear();

    let flight = match outcome {
        Ok(flight) => flight,
        Err(stopped) => {
            // What was flown until then is worth keeping.
            if !stopped.partial.times_s.is_empty() {
                files.write(&fmu, &stopped.partial)?;
            }
            return Err(stopped.error.into());
        }
    };
    if arguments.log {
        print_log(&flight.messages);
    }
    files.write(&fmu, &flight.recording)?;
    let last_s = flight.recording.times_s.last().copied().unwrap_or(times.start_s);
    if !arguments.quiet {
        if arguments.output.is_none() && arguments.plot.is_none() {
            output::print(&summary(&fmu, &flight.recording))?;
        }
        let steps = ((last_s - times.start_s) / times.step_s).ceil();
        let (last, elapsed) = (output::short(last_s), elapsed.as_secs_f64());
        output::note(&format!("{steps} steps to {last} s in {elapsed:.3} s"));
    }
    match flight.ended {
        Ended::AtStop => {}
        Ended::ByItself => {
            output::note(&format!("the FMU ended by itself at {} s", output::short(last_s)));
        }
        Ended::Cancelled => {
            let last = output::short(last_s);
            output::note(&format!("interrupted at {last} s; what was recorded until then is written"));
            return Ok(ExitCode::from(INTERRUPTED));
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// Positions of the variables to record; `None` for all outputs.
fn selection(fmu: &Fmu, patterns: &[String]) -> Result<Option<Vec<usize>>, loader::Error> {
    if patterns.is_empty() {
        return Ok(None);
    }
    let mut positions = Vec::new();
    for pattern in patterns {
        for position in loader::select(fmu, pattern)? {
            if !positions.contains(&position) {
                positions.push(position);
            }
        }
    }
    Ok(Some(positions))
}

/// A flag that Ctrl-C raises; a second Ctrl-C ends the program at once.
fn interruptible() -> Result<Arc<AtomicBool>, ctrlc::Error> {
    let cancel = Arc::new(AtomicBool::new(false));
    let raised = Arc::clone(&cancel);
    ctrlc::set_handler(move || {
        if raised.swap(true, Ordering::Relaxed) {
            std::process::exit(i32::from(INTERRUPTED));
        }
    })?;
    Ok(cancel)
}

fn progress_bar(times: &Times, quiet: bool) -> ProgressBar {
    if quiet || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new((times.stop_s - times.start_s) as u64);
    let template = "{bar:40.cyan/blue} {percent:>3}%  {elapsed} gone, {eta} to go";
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar
}

/// Reads an input table.
fn read_table(fmu: &Fmu, path: &Path) -> Result<InputTable, Box<dyn std::error::Error>> {
    let in_file = |error: &dyn std::error::Error| format!("{}: {}", path.display(), output::chain(error));
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_path(path)
        .map_err(|error| format!("{}: see --input", in_file(&error)))?;
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| in_file(&error))?;
        rows.push(record.iter().map(str::to_owned).collect::<Vec<_>>());
    }
    let header = if rows.is_empty() { Vec::new() } else { rows.remove(0) };
    Ok(InputTable::parse(fmu, &header, &rows).map_err(|error| in_file(&error))?)
}

/// What a flight leaves.
struct Files {
    output: Option<Destination>,
    plot: Option<Destination>,
}

impl Files {
    fn open(arguments: &Run) -> Result<Self, String> {
        let open = |path: &Option<PathBuf>, option| {
            path.as_deref().map(|path| Destination::open(path, option)).transpose()
        };
        Ok(Self { output: open(&arguments.output, "--output")?, plot: open(&arguments.plot, "--plot")? })
    }

    fn write(self, fmu: &Fmu, recording: &Recording) -> Result<(), Box<dyn std::error::Error>> {
        if let Some(file) = self.output {
            file.fill(|mut file| recording.write_csv(&mut file))?;
        }
        if let Some(file) = self.plot {
            let svg = plot::chart(fmu, recording).to_svg()?;
            file.fill(|file| file.write_all(svg.as_bytes()))?;
        }
        Ok(())
    }
}

fn print_log(messages: &[LogMessage]) {
    for message in messages {
        output::note(&format!("{} {message}", message.status));
    }
}

/// First, smallest, largest and last value of everything recorded.
fn summary(fmu: &Fmu, recording: &Recording) -> String {
    let mut table = output::table(&["variable", "unit", "first", "smallest", "largest", "last"]);
    for (name, column) in recording.names.iter().zip(&recording.columns) {
        let variable = fmu.find(name);
        let display = variable.and_then(|variable| loader::display_unit(fmu.description(), variable));
        let own = variable.and_then(|variable| loader::unit(fmu.description(), variable)).unwrap_or_default();
        let (unit, factor, offset) = display.unwrap_or((own, 1.0, 0.0));
        if let loader::Column::Text(texts) = column {
            let at = |text: Option<&String>| text.cloned().unwrap_or_default();
            table.add_row([
                name.clone(),
                String::new(),
                at(texts.first()),
                String::new(),
                String::new(),
                at(texts.last()),
            ]);
            continue;
        }
        let values: Vec<f64> = column.numbers().into_iter().map(|value| factor * value + offset).collect();
        let smallest = values.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let first = values.first().copied().unwrap_or(f64::NAN);
        let last = values.last().copied().unwrap_or(f64::NAN);
        table.add_row([
            name.clone(),
            unit.to_owned(),
            output::short(first),
            output::short(smallest),
            output::short(largest),
            output::short(last),
        ]);
    }
    table.to_string()
}
