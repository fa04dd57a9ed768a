//! `heliotorque check FILE.toml`: a spacecraft, a mission, a timeline, an ephemeris, a plan, a leg or a campaign, by what it is meant as.

use physics::{
    environment::onboard::OnboardEphemeris,
    guidance::timeline::Timeline,
    spacecraft::{MESSENGER_TOML, Spacecraft},
};

use super::{mission, options::Check, spacecraft};
use crate::{
    carried::{ephemeris, timeline},
    kind::{FileKind, is_blank},
    outcome::{self, Outcome},
    plan::{leg, momentum},
    sweep,
};

/// Judges the file.
pub(super) fn run(arguments: &Check) -> Outcome {
    let (file, text) = (arguments.subject.display().to_string(), files::read_text(&arguments.subject)?);
    if is_blank(&text) {
        let allowed = "a spacecraft, a spinner, a mission, a timeline, an ephemeris, a plan, a leg or a campaign: see `heliotorque new`";
        return Err(format!("{file}: found an empty file, allowed: {allowed}").into());
    }
    match FileKind::of(&text) {
        None | Some(FileKind::Spacecraft) => spacecraft::run(arguments, &file, &text),
        Some(FileKind::Mission) => mission::run(arguments, &file),
        Some(FileKind::Timeline) => of_timeline(&file, &text),
        Some(FileKind::Plan) => match momentum::checked(&arguments.subject) {
            Ok(summary) => outcome::printed(&format!("{file}: ok: {summary}")),
            Err(problems) => outcome::refused(&file, &problems, "a plan"),
        },
        Some(FileKind::Leg) => match leg::checked(&arguments.subject) {
            Ok(summary) => outcome::printed(&format!("{file}: ok: {summary}")),
            Err(problems) => outcome::refused(&file, &problems, "a leg"),
        },
        Some(FileKind::Campaign) => match sweep::checked(&arguments.subject) {
            Ok(summary) => outcome::printed(&format!("{file}: ok: {summary}")),
            Err(problems) => outcome::refused(&file, &problems, "a campaign"),
        },
        Some(FileKind::Ephemeris) => match OnboardEphemeris::from_toml(&file, &text) {
            Ok(read) => outcome::printed(&format!("{file}: ok: {}", ephemeris::table(&read, text.len()))),
            Err(problems) => outcome::refused(&file, &problems.to_string(), "an ephemeris"),
        },
    }
}

/// Whether Guidance and MomentumPlant can carry it out, read with instruments, sets of thrusters and panels of their own spacecraft.
fn of_timeline(file: &str, text: &str) -> Outcome {
    let spacecraft =
        Spacecraft::from_toml("messenger.toml", MESSENGER_TOML).map_err(|error| error.to_string())?;
    let instruments: Vec<&str> = spacecraft.instruments.iter().map(|it| it.name.as_str()).collect();
    match Timeline::from_toml(file, text, &spacecraft) {
        Ok(read) => {
            let of_one = timeline::of_one_model(file, text, &spacecraft, &read);
            outcome::printed(&format!(
                "{file}: ok: {}; with the models' own spacecraft, its instruments {}, its sets of thrusters {} and its {} panels; \
                 `pack --timeline` judges it for yours{}",
                timeline::summary(&read),
                instruments.join(", "),
                spacecraft.thruster_sets.join(", "),
                spacecraft.panels.len(),
                of_one.iter().map(|line| format!("\n{line}")).collect::<String>()
            ))
        }
        Err(problems) => outcome::refused(file, &problems.to_string(), "a timeline"),
    }
}
