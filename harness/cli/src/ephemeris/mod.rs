//! `heliotorque ephemeris`: Chebyshev fits and coarse elements of what an FMU flies, as an ephemeris file that others carry.

mod fit;
pub mod options;
mod report;
mod source;

use std::{
    path::{Path, PathBuf},
    process::ExitCode,
};

use files::Destination;
use physics::environment::flown::{FlownEphemeris, to_toml};

use crate::{interrupt, outcome::Outcome};
use fit::Asked;
use options::Ephemeris;
pub use report::{FILE, of, read, summary};
use source::Source;

/// Tells what a file holds, or everything that is wrong with it.
pub fn run_check(path: &Path, (bytes, read): (usize, Result<FlownEphemeris, String>)) -> Outcome {
    match read {
        Ok(carried) => {
            terminal::print(&format!("{}: ok: {}", path.display(), report::table(&carried, bytes)))?;
            Ok(ExitCode::SUCCESS)
        }
        Err(problems) => {
            terminal::print(&problems)?;
            let count = problems.lines().count();
            let plural = if count == 1 { "problem" } else { "problems" };
            terminal::note(&format!("{}: {count} {plural}, judged as an ephemeris", path.display()));
            Ok(ExitCode::FAILURE)
        }
    }
}

/// Makes the file.
pub fn run(arguments: &Ephemeris) -> Outcome {
    let [start_s, stop_s] = arguments.span_s()?;
    let output = arguments.output.clone().unwrap_or_else(|| PathBuf::from(FILE));
    let inputs: Vec<&Path> = vec![arguments.source.as_path()];
    let destination = Destination::open(&output, "--output", &inputs)?;
    let mut source = Source::open(&arguments.source, &arguments.set, start_s)?;
    let mut made = FlownEphemeris { source: Some(source.title()), ..FlownEphemeris::default() };
    for target in arguments.targets() {
        let asked = Asked {
            target,
            span_s: [start_s, stop_s],
            segment_s: arguments.segment,
            degree: arguments.degree.map(usize::from),
            tolerance_m: arguments.tolerance,
            is_quiet: arguments.quiet,
        };
        made.precise.push(fit::precise(&mut source, &asked)?);
        if interrupt::raised() {
            return Ok(ExitCode::from(interrupt::INTERRUPTED));
        }
    }
    if arguments.coarse {
        let span_s = [start_s, arguments.coarse_until_s(stop_s)?];
        made.coarse = fit::coarse(&mut source, &arguments.targets(), span_s, arguments.quiet)?;
    }
    let text = to_toml(&made);
    // What a spacecraft will read is what was made.
    if FlownEphemeris::from_toml(FILE, &text).map_err(|error| error.to_string())? != made {
        return Err("the file does not read back as it was made".into());
    }
    let is_stdout = destination.is_stdout();
    destination.fill(|file| file.write_all(text.as_bytes()))?;
    let told = format!("{}: {}", output.display(), report::table(&made, text.len()));
    if is_stdout || arguments.quiet {
        if !arguments.quiet {
            terminal::note(&told);
        }
    } else {
        terminal::print(&told)?;
    }
    Ok(ExitCode::SUCCESS)
}
