//! `heliotorque map`: torque of sunlight over the Sun's azimuth and elevation, as picture, table and CSV.

mod balance;
mod bands;
mod colours;
mod contour;
mod found;
mod grid;
pub mod options;
mod outputs;
mod panels;
mod picture;
mod spacecraft;
mod sunlight;
mod table;
mod verdict;
mod worth;
mod zero_lines;

use std::process::ExitCode;

use planner::momentum::Mission;

use crate::outcome::Outcome;
use found::Found;
use options::Map;
use outputs::Outputs;
use spacecraft::MappedSpacecraft;

/// Maps a spacecraft.
pub fn run(arguments: &Map) -> Outcome {
    let outputs = Outputs::open(arguments)?;
    let mission = arguments.mission.as_deref().map(Mission::read).transpose()?;
    let spacecraft = MappedSpacecraft::open(arguments)?;
    let found = Found::new(&spacecraft, (arguments.source, arguments.step), mission)?;
    let written = outputs.write(&spacecraft, &found)?;
    if !arguments.quiet {
        let text = table::text(&spacecraft, &found, arguments.source);
        if written.takes_stdout {
            terminal::note(&text);
        } else {
            terminal::print(&text)?;
        }
        for file in written.files {
            terminal::note(&format!("wrote {file}"));
        }
    }
    Ok(ExitCode::SUCCESS)
}
