//! `heliotorque refit`: centre of mass and `solar.scale` from a history of momentum, by flights of the mission's FMU.

mod flights;
pub mod options;
mod picture;
mod table;

use std::path::Path;

use files::{
    Destination,
    outcome::{self, Answer, Outcome},
};
use isolation::interrupt;

use crate::refit::{Requested, Telemetry, fit};
use flights::RefitMission;
pub use options::Refit;
use table::Found;

/// Fits.
pub fn run(arguments: &Refit) -> Outcome {
    let telemetry = Telemetry::read(&arguments.telemetry)?;
    let (mut mission, simulated) = RefitMission::open(arguments)?;
    let destinations = destinations(arguments, &simulated.reads())?;
    let telemetry_file = arguments.telemetry.display().to_string();
    mission.check_times(&telemetry_file, &telemetry)?;
    let requested =
        Requested { telemetry: &telemetry, prior: mission.prior()?, deviations: arguments.deviations };
    let spacecraft = mission.spacecraft_name()?;
    let span_s = mission.span_s(&telemetry);
    mission.bar = terminal::progress(span_s as u64, "s of flights", arguments.quiet);
    let bar = mission.bar.clone();
    let fitted =
        fit(&mission, &requested, &mut |_, expected| bar.set_length((expected as f64 * span_s) as u64));
    bar.finish_and_clear();
    if interrupt::raised() {
        return Ok(Answer::Interrupted);
    }
    let fitted = fitted.map_err(|error| format!("{}: {error}", arguments.mission.display()))?;
    let found = Found {
        mission: arguments.mission.display().to_string(),
        telemetry: telemetry_file,
        requested: &requested,
        fitted: &fitted,
    };
    let contents = [found.toml(), fitted.to_json(&spacecraft)?, picture::svg(&found)?];
    if !arguments.quiet {
        terminal::print(&found.text())?;
    }
    if let Some(warning) = found.warning() {
        terminal::note(&warning);
    }
    outcome::write_all(destinations.into_iter().zip(contents), arguments.quiet)?;
    Ok(Answer::Yes)
}

/// TOML, JSON and picture, looked at before anything is simulated.
fn destinations(arguments: &Refit, reads: &[&Path]) -> Result<[Destination; 3], String> {
    let output = &arguments.output;
    if output.extension().is_none_or(|it| !it.eq_ignore_ascii_case("toml")) {
        return Err(format!("{}: found another ending, allowed: .toml: see --output", output.display()));
    }
    let inputs = [reads, &[arguments.telemetry.as_path()]].concat();
    let open = |path: &Path| Destination::open(path, "--output", &inputs);
    Ok([open(output)?, open(&output.with_extension("json"))?, open(&output.with_extension("svg"))?])
}
