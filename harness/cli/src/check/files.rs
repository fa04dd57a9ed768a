//! `heliotorque check FILE.toml`: a spacecraft, a mission, a timeline or an ephemeris, by what it is meant as.

use physics::{
    environment::onboard::OnboardEphemeris,
    guidance::timeline::Timeline,
    spacecraft::{MESSENGER_TOML, Spacecraft},
};

use super::{mission, options::Check, spacecraft};
use crate::{
    carried::{ephemeris, timeline},
    kind::FileKind,
    outcome::{self, Outcome},
};

/// Judges the file.
pub fn run(arguments: &Check) -> Outcome {
    let (file, text) = (arguments.subject.display().to_string(), files::read_text(&arguments.subject)?);
    if ephemeris::is_meant(&text) {
        return match OnboardEphemeris::from_toml(&file, &text) {
            Ok(read) => outcome::printed(&format!("{file}: ok: {}", ephemeris::table(&read, text.len()))),
            Err(problems) => outcome::refused(&file, &problems.to_string(), "an ephemeris"),
        };
    }
    match FileKind::of(&text) {
        FileKind::Spacecraft => spacecraft::run(arguments, &file, &text),
        FileKind::Mission => mission::run(arguments, &file),
        FileKind::Timeline => of_timeline(&file, &text),
    }
}

/// Whether Guidance can carry out the commands, read with the instruments of its own spacecraft.
fn of_timeline(file: &str, text: &str) -> Outcome {
    let instruments =
        Spacecraft::from_toml("", MESSENGER_TOML).map_or_else(|_| Vec::new(), |it| it.instruments);
    let names: Vec<&str> = instruments.iter().map(|instrument| instrument.name.as_str()).collect();
    match Timeline::from_toml(file, text, &instruments) {
        Ok(read) => outcome::printed(&format!(
            "{file}: ok: {}; with the instruments of Guidance's own spacecraft, {}; `pack --timeline` judges it for yours",
            timeline::summary(&read),
            names.join(", ")
        )),
        Err(problems) => outcome::refused(file, &problems.to_string(), "a timeline"),
    }
}
