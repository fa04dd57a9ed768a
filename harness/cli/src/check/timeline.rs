//! `heliotorque check timeline.toml`: whether Guidance can carry out its commands.

use std::process::ExitCode;

use physics::{
    guidance::timeline::Timeline,
    spacecraft::{MESSENGER_TOML, Spacecraft},
};

use crate::{args::Check, outcome::Outcome, timeline};

/// Reads the file with the instruments of Guidance's own spacecraft.
pub fn run(arguments: &Check, text: &str) -> Outcome {
    let file = arguments.subject.display().to_string();
    let instruments =
        Spacecraft::from_toml("", MESSENGER_TOML).map_or_else(|_| Vec::new(), |it| it.instruments);
    match Timeline::from_toml(&file, text, &instruments) {
        Ok(read) => {
            let names: Vec<&str> = instruments.iter().map(|instrument| instrument.name.as_str()).collect();
            let names = names.join(", ");
            terminal::print(&format!(
                "{file}: ok: {}; with the instruments of Guidance's own spacecraft, {names}; `pack --timeline` judges it for yours",
                timeline::summary(&read)
            ))?;
            Ok(ExitCode::SUCCESS)
        }
        Err(problems) => {
            let problems = problems.to_string();
            terminal::print(&problems)?;
            let count = super::problems::problem_count(&problems, &file);
            terminal::note(&format!("{file}: {count}, judged as a timeline"));
            Ok(ExitCode::FAILURE)
        }
    }
}
