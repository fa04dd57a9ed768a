//! `heliotorque map`: torque of sunlight over the Sun's azimuth and elevation, as picture, table and CSV.

mod bands;
mod colours;
mod found;
pub mod options;
mod outputs;
mod picture;
mod spacecraft;
mod table;
mod verdict;

use files::outcome::{Answer, Outcome};
use inputs::variables;

use crate::momentum::Mission;
use found::Found;
pub use options::Map;
use outputs::Outputs;
use spacecraft::MappedSpacecraft;

/// Maps a spacecraft.
pub fn run(arguments: &Map) -> Outcome {
    variables::warn_of_repeated("--set", &arguments.set);
    let outputs = Outputs::open(arguments)?;
    let mission = arguments.recording.as_deref().map(Mission::read).transpose()?;
    let spacecraft = MappedSpacecraft::open(arguments)?;
    let found = Found::new(&spacecraft, arguments.step, mission)?;
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
    Ok(Answer::Yes)
}
