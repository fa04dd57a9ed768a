//! `heliotorque run`: runs an FMU in a process of its own, records, writes, draws.

use std::{
    path::{Path, PathBuf},
    process::ExitCode,
    time::Instant,
};

use files::{Destination, Growing};
use loader::{Collector, Ended, Fmu, InputTable, LogMessage, Recording, Times};

use crate::{
    app::Outcome,
    args::{Run, RunInChild},
    interrupt::INTERRUPTED,
    plot,
};

mod child;

/// Runs the FMU in a child process.
pub fn run(arguments: &Run) -> Outcome {
    if let Some(path) = &arguments.plot {
        plot::check_path(path)?;
    }
    let fmu = Fmu::open(&arguments.fmu)?;
    // Everything that can be refused without the FMU's library is refused here.
    let settings = Settings::of(&fmu, arguments)?;
    fmu.binary_path()?;
    let mut files = Files::open(arguments)?;
    let (times, positions) = (settings.times, settings.positions);
    let mut collector = Collector::new(&fmu, &positions);
    let every = loader::steps_between_points(&times, arguments.every)?;
    let points = times.steps().div_ceil(every).saturating_add(1);
    collector.fits(points)?;

    let progress = terminal::progress((times.stop_s - times.start_s) as u64, "s", arguments.quiet);
    let began = Instant::now();
    let simulated = child::simulate(&fmu, arguments.timeout, points, &mut collector, |recording, time_s| {
        if let Some(time_s) = time_s {
            progress.set_position((time_s - times.start_s).max(0.0) as u64);
        }
        files.record(recording)
    });
    let elapsed = began.elapsed();
    progress.finish_and_clear();

    let recording = collector.recording();
    if arguments.log {
        print_log(&simulated.messages);
    }
    let last_s = recording.times_s.last().copied().unwrap_or(times.start_s);
    let ended = match simulated.outcome {
        Ok(ended) => ended,
        Err(error) => {
            // What was simulated until then is worth keeping.
            let kept = files.leave(&fmu, recording);
            let rows = recording.times_s.len();
            let kept: String =
                kept.iter().map(|path| format!("\n{rows} rows so far: {}", path.display())).collect();
            return Err(format!("{error}{kept}").into());
        }
    };
    let shows_summary = !arguments.quiet && arguments.output.is_none() && arguments.plot.is_none();
    files.finish(&fmu, recording)?;
    if shows_summary {
        terminal::print(&summary(&fmu, recording))?;
    }
    if !arguments.quiet {
        let steps = ((last_s - times.start_s) / times.step_s).ceil();
        let (last, elapsed) = (terminal::short(last_s), elapsed.as_secs_f64());
        terminal::note(&format!("{steps} steps to {last} s in {elapsed:.3} s"));
    }
    match ended {
        Ended::AtStop => {}
        Ended::ByItself => {
            terminal::note(&format!("the FMU ended by itself at {} s", terminal::short(last_s)));
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
        None => Ok(ExitCode::SUCCESS),
    }
}

/// Runs the FMU in this process for the parent.
pub fn run_in_child(arguments: &RunInChild) -> Outcome {
    child::run(arguments)
}

/// What the arguments mean for an FMU.
struct Settings {
    times: Times,
    sets: Vec<(String, loader::Value)>,
    inputs: Option<InputTable>,
    positions: Vec<usize>,
}

impl Settings {
    fn of(fmu: &Fmu, arguments: &Run) -> Result<Self, Box<dyn std::error::Error>> {
        let times = Times::of(fmu, arguments.start, arguments.stop, arguments.step)?;
        let mut sets = Vec::new();
        for setting in &arguments.set {
            sets.extend(loader::parse_assignment(fmu, setting)?);
        }
        let inputs = arguments.input.as_deref().map(|path| read_table(fmu, path)).transpose()?;
        let positions = selection(fmu, &arguments.record)?.unwrap_or_else(|| loader::outputs(fmu));
        Ok(Self { times, sets, inputs, positions })
    }
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

/// Reads an input table.
fn read_table(fmu: &Fmu, path: &Path) -> Result<InputTable, Box<dyn std::error::Error>> {
    let in_file =
        |error: &dyn std::error::Error| format!("{}: {}", path.display(), loader::Error::chain(error));
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(files::open(path).map_err(|error| format!("{}: see --input", in_file(&error)))?);
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| in_file(&error))?;
        rows.push(record.iter().map(str::to_owned).collect::<Vec<_>>());
    }
    let header = if rows.is_empty() { Vec::new() } else { rows.remove(0) };
    Ok(InputTable::parse(fmu, &header, &rows).map_err(|error| in_file(&error))?)
}

/// Rows of a table that are written at once.
const ROWS_AT_ONCE: usize = 64;

/// What a simulation leaves.
struct Files {
    output: Option<Growing>,
    plot: Option<Destination>,
    rows_written: Option<usize>,
    bytes: Vec<u8>,
}

impl Files {
    fn open(arguments: &Run) -> Result<Self, String> {
        let inputs: Vec<&Path> =
            [arguments.fmu.as_path()].into_iter().chain(arguments.input.as_deref()).collect();
        let open = |path: &Option<PathBuf>, option| {
            path.as_deref().map(|path| Destination::open(path, option, &inputs)).transpose()
        };
        let (output, plot) = (open(&arguments.output, "--output")?, open(&arguments.plot, "--plot")?);
        if let (Some(output), Some(plot)) = (&output, &plot)
            && output.is_same(plot)
        {
            return Err("one file cannot take both: see --output and --plot".to_owned());
        }
        let output = output.map(|output| output.grow(&inputs)).transpose()?;
        Ok(Self { output, plot, rows_written: None, bytes: Vec::new() })
    }

    /// Appends the rows that are new.
    fn record(&mut self, recording: &Recording) -> Result<(), String> {
        let rows = recording.times_s.len();
        let Some(output) = self.output.as_mut() else { return Ok(()) };
        let write = |output: &mut Growing, bytes: &mut Vec<u8>, from: Option<usize>, to: usize| {
            bytes.clear();
            let written = match from {
                None => recording.write_header(bytes),
                Some(from) => recording.write_rows(from..to, bytes),
            };
            written.map_err(|error| error.to_string())?;
            output.append(bytes)
        };
        if self.rows_written.is_none() && rows > 0 {
            write(output, &mut self.bytes, None, 0)?;
            self.rows_written = Some(0);
        }
        while let Some(from) = self.rows_written.filter(|from| *from < rows) {
            let to = rows.min(from + ROWS_AT_ONCE);
            write(output, &mut self.bytes, Some(from), to)?;
            self.rows_written = Some(to);
        }
        Ok(())
    }

    /// Gives the complete files their names.
    fn finish(mut self, fmu: &Fmu, recording: &Recording) -> Result<(), Box<dyn std::error::Error>> {
        self.record(recording)?;
        if let Some(output) = self.output {
            output.finish()?;
        }
        if let Some(plot) = self.plot {
            let svg = plot::chart(fmu, recording).to_svg()?;
            plot.fill(|file| file.write_all(svg.as_bytes()))?;
        }
        Ok(())
    }

    /// Leaves what there is under the names of recordings in progress, and tells them.
    fn leave(mut self, fmu: &Fmu, recording: &Recording) -> Vec<PathBuf> {
        // The simulation failed already: what cannot be kept now changes nothing of that.
        let _ = self.record(recording);
        let table = self.output.and_then(Growing::leave);
        let picture = self.plot.filter(|_| !recording.times_s.is_empty()).and_then(|plot| {
            let svg = plot::chart(fmu, recording).to_svg().ok()?;
            let mut part = plot.grow(&[]).ok()?;
            part.append(svg.as_bytes()).ok()?;
            part.leave()
        });
        table.into_iter().chain(picture).collect()
    }
}

fn print_log(messages: &[LogMessage]) {
    for message in messages {
        terminal::note(&format!("{} {message}", message.status));
    }
}

/// First, smallest, largest and last value of everything recorded.
fn summary(fmu: &Fmu, recording: &Recording) -> String {
    let mut table = terminal::table(&["variable", "unit", "first", "smallest", "largest", "last"]);
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
            terminal::short(first),
            terminal::short(smallest),
            terminal::short(largest),
            terminal::short(last),
        ]);
    }
    table.to_string()
}
