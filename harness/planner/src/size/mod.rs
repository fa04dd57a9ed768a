//! `heliotorque size`: momentum, dumps, propellant, wheels, slews and thrusters of a spacecraft or mission, by flights through
//! its FMU.

mod answer;
mod flights;
mod json;
mod momentum;
mod needs;
pub mod options;
mod picture;
mod sized;
mod table;
mod unloading;

use std::path::Path;

use files::{
    Destination, OutputFolder,
    outcome::{self, Answer, Outcome},
};
use isolation::interrupt;
use packing::instance::vector;
use physics::constants::DAY_S;

use crate::Failure;
use momentum::Histories;
use needs::Demands;
pub use options::Size;
pub use physics::spacecraft::SlewDemand;
use sized::SizedSpacecraft;
use table::Found;
use unloading::Unloadings;

/// Sizes a spacecraft.
pub fn run(arguments: &Size) -> Outcome {
    let ([picture, table_file], _folder) = destinations(arguments)?;
    let sized = SizedSpacecraft::open(arguments)?;
    let found = found(&sized, arguments);
    if interrupt::raised() {
        return Ok(Answer::Interrupted);
    }
    let found = found?;
    let svg = picture::svg(&sized, &found.sweep)?;
    let csv = table::csv(&sized, &found.sweep);
    if arguments.json {
        terminal::print(&serde_json::to_string_pretty(&json::object(&sized, &found))?)?;
    } else if !arguments.quiet {
        let parts =
            [answer::text(&sized, &found), answer::assumed(&sized, &found), table::text(&sized, &found)];
        terminal::print(&parts.join("\n\n"))?;
    }
    let picture = svg.map(|svg| (picture, svg));
    let written: Vec<_> = picture.into_iter().chain([(table_file, csv)]).collect();
    outcome::write_all(written, arguments.quiet)?;
    Ok(Answer::Yes)
}

/// Simulates the flights and returns their results.
fn found(sized: &SizedSpacecraft, arguments: &Size) -> Result<Found, Failure> {
    let slews = needs::slews(sized)?;
    let mut flights = Vec::new();
    let last_year = arguments.years.filter(|years| *years > 1.0 || !arguments.end.is_empty());
    let last_year = last_year.map(|years| sized.last_year(years, &arguments.end)).transpose()?;
    for others in [Some(Vec::new()), last_year].into_iter().flatten() {
        let simulated = flights::undumped(sized, &others, arguments.quiet)?;
        flights.push(Histories::new(&simulated, sized.is_body_integral, sized.bias_n_m_s)?);
    }
    let dumping = needs::dumping(sized);
    let demands = Demands::new(sized, &slews, arguments.margin)?;
    let every = |every_s: f64| Unloadings::new(&demands, &flights, every_s, dumping.as_ref().ok());
    let others = [sized.period_s, 7.0 * DAY_S].into_iter().filter(|it| *it != sized.every_s);
    let others = others.map(every).filter(|it| !it.years.is_empty()).collect();
    let unloadings = every(sized.every_s);
    let needed_n_m_s = unloadings.wheels.needed_n_m_s.max();
    Ok(Found {
        sources: flights.first().map_or_else(Vec::new, |it| it.by_source(sized.period_s, sized.every_s)),
        others,
        unloadings,
        lasting_s: demands.lasting_s(&flights),
        years: arguments.years,
        threshold_n_m_s: vector(&mut sized.started()?, "dump.threshold")?,
        allocations: dumping.map(|it| needs::allocations(sized, &it)),
        sweep: flights::sweep(sized, (needed_n_m_s, arguments.budget), arguments.quiet)?,
        margin: arguments.margin,
        slews,
    })
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
