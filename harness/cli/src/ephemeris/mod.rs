//! `heliotorque ephemeris`: Chebyshev fits and coarse elements of what an FMU simulates or SPICE kernels hold, as an ephemeris
//! file that others carry.

mod flight;
mod kernel_options;
mod options;
mod shown;

use std::{
    path::{Path, PathBuf},
    process::ExitCode,
};

use files::Destination;
use isolation::interrupt;
use packing::carried::ephemeris::{FILE, table};
use physics::{
    environment::onboard::{OnboardEphemeris, OnboardTarget, to_toml},
    numerics::Span,
};
use planner::ephemeris::{Failure, Requested, Source, coarse, precise, spk::Kernels};

use crate::outcome::{self, Outcome};
use flight::RepeatableSimulation;
pub(crate) use options::Ephemeris;
use shown::Shown;

/// Makes the file.
pub(crate) fn run(arguments: &Ephemeris) -> Outcome {
    let [start_s, stop_s] = arguments.span_s()?;
    let output = arguments.output.clone().unwrap_or_else(|| PathBuf::from(FILE));
    let inputs = arguments.inputs();
    let inputs: Vec<&Path> = inputs.iter().map(PathBuf::as_path).collect();
    let destination = Destination::open(&output, "--output", &inputs)?;
    let source = Shown { source: source(arguments, [start_s, stop_s])?, is_quiet: arguments.quiet };
    let mut made = OnboardEphemeris { source: Some(source.title()), ..OnboardEphemeris::default() };
    let requested = Requested {
        span: Span::new(start_s, stop_s),
        segment_s: arguments.segment,
        degree: arguments.degree.map(usize::from),
        tolerance_m: arguments.tolerance,
    };
    for target in arguments.targets() {
        made.precise.push(precise(&source, target, &requested)?);
        if interrupt::raised() {
            return Ok(ExitCode::from(interrupt::INTERRUPTED));
        }
    }
    if arguments.coarse {
        let span = Span::new(start_s, arguments.coarse_until_s(stop_s)?);
        made.coarse = coarse(&source, &arguments.targets(), span)?;
    }
    let text = terminal::unsigned_zeros(&to_toml(&made)).into_owned();
    // What a spacecraft will read is what was made.
    if OnboardEphemeris::from_toml(FILE, &text).map_err(|error| error.to_string())? != made {
        return Err("the file does not read back as it was made".into());
    }
    if arguments.quiet {
        destination.fill(|file| file.write_all(text.as_bytes()))?;
        return Ok(ExitCode::SUCCESS);
    }
    let report = format!("{}: {}", output.display(), table(&made, text.len()));
    outcome::written(destination, text.as_bytes(), &report)
}

/// Where the states come from: kernels if there are any, otherwise a flight.
fn source(arguments: &Ephemeris, span_s: [f64; 2]) -> Result<Box<dyn Source>, Failure> {
    if arguments.kernels.is_given() {
        let (mut targets, mut span_s) = (arguments.targets(), span_s);
        if arguments.coarse {
            targets.extend([OnboardTarget::Sun, OnboardTarget::Earth]);
            span_s[1] = arguments.coarse_until_s(span_s[1])?;
        }
        return Ok(Box::new(Kernels::open(
            &arguments.kernels.kernel,
            arguments.kernels.center,
            arguments.kernels.spacecraft,
            &targets,
            span_s,
        )?));
    }
    Ok(Box::new(RepeatableSimulation::open(&arguments.simulated(), &arguments.set, span_s[0])?))
}
