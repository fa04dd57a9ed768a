//! `heliotorque ephemeris`: Chebyshev fits and coarse elements of what an FMU simulates or SPICE kernels hold, as an ephemeris
//! file that others carry.

mod kernel_options;
mod options;

use std::path::{Path, PathBuf};

use files::{
    Destination,
    outcome::{self, Answer, Outcome},
};
use inputs::ending::check_ending;
pub(crate) use options::Ephemeris;
use packing::carried::ephemeris::FILE;
use planner::ephemeris::fit;

/// Makes the file.
pub(crate) fn run(arguments: &Ephemeris) -> Outcome {
    let request = arguments.request()?;
    let output = arguments.output.clone().unwrap_or_else(|| PathBuf::from(FILE));
    check_ending(&output, "toml")?;
    let inputs = arguments.inputs();
    let inputs: Vec<&Path> = inputs.iter().map(PathBuf::as_path).collect();
    let destination = Destination::open(&output, "--output", &inputs)?;
    let Some((text, table)) = fit(&request)? else { return Ok(Answer::Interrupted) };
    if arguments.quiet {
        destination.fill(|file| file.write_all(text.as_bytes()))?;
        return Ok(Answer::Yes);
    }
    outcome::written(destination, text.as_bytes(), &format!("{}: {table}", output.display()))
}
