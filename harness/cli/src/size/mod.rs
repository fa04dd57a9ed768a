//! `heliotorque size`: momentum, dumps, propellant, wheels, slews and thrusters of a spacecraft or mission, by flights through
//! its FMU.

mod flights;
mod momentum;
mod needs;
mod options;
mod picture;
mod sized;
mod table;

use std::{path::Path, process::ExitCode};

use files::{Destination, OutputFolder};

use crate::{
    interrupt,
    outcome::{self, Outcome},
};
use momentum::Histories;
use needs::{SlewLimits, Wheels};
pub(crate) use options::Size;
use sized::SizedSpacecraft;
use table::Found;

/// Sizes a spacecraft.
pub(crate) fn run(arguments: &Size) -> Outcome {
    let ([picture, table_file], _folder) = destinations(arguments)?;
    let sized = SizedSpacecraft::open(arguments)?;
    let slews = SlewLimits::of(&sized)?.slews();
    let simulated = flights::undumped(&sized, arguments.quiet)?;
    let histories = Histories::new(&simulated, sized.is_body_integral)?;
    let wheels = Wheels::needed(&sized, &histories, &slews, arguments.margin)?;
    let found = Found {
        sources: histories.by_source(sized.period_s, sized.spacing_s),
        wheels,
        slews,
        allocations: needs::allocations(&sized),
        sweep: flights::sweep(&sized, arguments.budget, arguments.quiet)?,
        margin: arguments.margin,
    };
    if interrupt::raised() {
        return Ok(ExitCode::from(interrupt::INTERRUPTED));
    }
    let svg = picture::svg(&sized, &found.sweep)?;
    let csv = table::csv(&sized, &found.sweep);
    if !arguments.quiet {
        terminal::print(&table::text(&sized, &found))?;
    }
    outcome::write_all([(picture, svg), (table_file, csv)], arguments.quiet)?;
    Ok(ExitCode::SUCCESS)
}

/// Picture and table, looked at before anything is simulated.
fn destinations(arguments: &Size) -> Result<([Destination; 2], Option<OutputFolder>), String> {
    let stem = arguments.file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let folder = arguments.output.as_deref().unwrap_or(Path::new(""));
    let inputs = [arguments.file.as_path()];
    let open =
        |ending: &str| Destination::open(&folder.join(format!("{stem}-size.{ending}")), "--output", &inputs);
    let made =
        arguments.output.as_deref().map(|folder| OutputFolder::create(folder, "--output")).transpose()?;
    Ok(([open("svg")?, open("csv")?], made))
}
