//! `heliotorque check FILE.toml`: a spacecraft, a mission, a timeline, an ephemeris, a plan, a leg or a campaign, by what it is meant as.

use std::error::Error;

use inputs::{
    kind::{FileKind, is_blank},
    library::Library,
};
use packing::carried::{ephemeris, timeline};
use physics::{
    environment::onboard::OnboardEphemeris,
    guidance::timeline::Timeline,
    spacecraft::{MESSENGER_TOML, Spacecraft},
};

use super::{mission, options::Check, spacecraft};
use crate::{
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
    let kind = FileKind::of(&text).unwrap_or(FileKind::Spacecraft);
    let library = Library::new(arguments.template.as_deref());
    let chain = |error: Box<dyn Error>| fmi::Error::chain(error.as_ref());
    let read = match kind {
        FileKind::Spacecraft => return spacecraft::run(arguments, &file, &text),
        FileKind::Mission => mission::checked(arguments),
        FileKind::Timeline => of_timeline(&file, &text),
        FileKind::Plan => momentum::checked(&arguments.subject, library).map_err(chain),
        FileKind::Leg => leg::checked(&arguments.subject, library).map_err(chain),
        FileKind::Campaign => sweep::checked(&arguments.subject, library).map_err(chain),
        FileKind::Ephemeris => OnboardEphemeris::from_toml(&file, &text)
            .map(|read| ephemeris::table(&read, text.len()))
            .map_err(|problems| problems.to_string()),
    };
    match read {
        Ok(summary) => outcome::printed(&format!("{file}: ok: {summary}")),
        Err(problems) => outcome::refused(&file, &problems, &kind.to_string()),
    }
}

/// Whether Guidance and MomentumPlant can carry it out, read with instruments, sets of thrusters and panels of their own spacecraft.
fn of_timeline(file: &str, text: &str) -> Result<String, String> {
    let spacecraft =
        Spacecraft::from_toml("messenger.toml", MESSENGER_TOML).map_err(|error| error.to_string())?;
    let instruments: Vec<&str> = spacecraft.instruments.iter().map(|it| it.name.as_str()).collect();
    let read = Timeline::from_toml(file, text, &spacecraft).map_err(|problems| problems.to_string())?;
    let of_one = timeline::of_one_model(file, text, &spacecraft, &read);
    Ok(format!(
        "{}; with the models' own spacecraft, its instruments {}, its sets of thrusters {} and its {} panels; \
         `pack --timeline` judges it for yours{}",
        timeline::summary(&read),
        instruments.join(", "),
        spacecraft.thruster_sets.join(", "),
        spacecraft.panels.len(),
        of_one.iter().map(|line| format!("\n{line}")).collect::<String>()
    ))
}
