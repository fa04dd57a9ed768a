//! `heliotorque plan spin`: the train of pulses that turns a spinner with the least nutation, or months of antenna pointing.

mod months;
mod picture;
mod tables;
pub(crate) mod text;

use std::path::{Path, PathBuf};

use files::{
    OutputFolder,
    outcome::{self, Answer, Outcome},
};
use inputs::{home, kind::FileKind};
use physics::spacecraft::Spacecraft;

use super::files::{OPTION, write_all};
use crate::{
    Failure,
    spin::{PlanError, PlannedBurn, TurnRequest, start_values::toml},
};

/// Prints the plan of a turn, and writes its files where a folder is given.
pub fn run(request: &TurnRequest) -> Outcome {
    let mut request = request.clone();
    if let Some(path) = &request.spacecraft {
        check_spinner(path)?;
    }
    if request.spacecraft.is_none() && request.template.is_none() && request.campaign_s.is_none() {
        request.template = home::installed().map(|_| home::fmu("SpinPlant")).filter(|fmu| fmu.is_file());
    }
    let answer = match text::plan(&request) {
        Err(PlanError::Infeasible(why)) => return outcome::no(&why),
        answer => answer?,
    };
    terminal::print(answer.text.trim_end())?;
    if let (Some(folder), Some(burn)) = (&request.output, &answer.burn) {
        for path in write(folder, request.spacecraft.as_deref(), burn)? {
            terminal::note(&path.display().to_string());
        }
    }
    if answer.broken.is_empty() {
        return Ok(Answer::Yes);
    }
    terminal::note(&format!("limits broken: {}", answer.broken.join(", ")));
    Ok(Answer::No)
}

/// Refuses a file that is no spacecraft, and a spacecraft that does not spin.
fn check_spinner(path: &Path) -> Result<(), String> {
    let (file, text) = (path.display().to_string(), FileKind::Spacecraft.read(path)?);
    if Spacecraft::from_toml(&file, &text).is_err() {
        return Ok(());
    }
    Err(format!("{file}: found a three-axis spacecraft, allowed: a spinner: see `heliotorque new spinner`"))
}

/// Writes `burn.csv`, `burn.json`, `start.toml` and `burn.svg` into a folder, which is created if missing; gives their paths.
fn write(folder: &Path, spacecraft: Option<&Path>, burn: &PlannedBurn) -> Result<Vec<PathBuf>, Failure> {
    let contents = [
        ("burn.csv", burn.to_csv()?),
        ("burn.json", burn.to_json()?),
        ("start.toml", toml(&burn.start_values())),
        ("burn.svg", picture::svg(burn)?),
    ];
    let _folder = OutputFolder::create(folder, OPTION)?;
    let inputs: Vec<&Path> = spacecraft.into_iter().collect();
    let contents = contents.map(|(name, text)| (name, terminal::unsigned_zeros(&text).into_owned()));
    write_all(folder, &contents, &inputs)
}
