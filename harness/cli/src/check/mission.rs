//! `heliotorque check mission.toml`: whether a mission can fly; nothing is flown.

use std::process::ExitCode;

use crate::{
    args::{Check, Run},
    epoch,
    outcome::Outcome,
    run::{flown::Flown, settings::Settings},
};

/// Reads the file, packs what it names and finds every name and value in it.
pub fn run(arguments: &Check) -> Outcome {
    let file = arguments.subject.display().to_string();
    match summary(arguments) {
        Ok(summary) => {
            terminal::print(&format!("{file}: ok: {summary}"))?;
            Ok(ExitCode::SUCCESS)
        }
        Err(error) => {
            let problems = loader::Error::chain(error.as_ref());
            terminal::print(&problems)?;
            let count = super::problem_count(&problems, &file);
            terminal::note(&format!("{file}: {count}, judged as a mission"));
            Ok(ExitCode::FAILURE)
        }
    }
}

fn summary(arguments: &Check) -> Result<String, Box<dyn std::error::Error>> {
    let run = Run::of(arguments.subject.clone(), arguments.template.clone());
    let flown = Flown::of(&run)?;
    let (subject, _packed) = flown.open()?;
    let Settings { times, columns, plots, limits, .. } = Settings::of(&subject, &flown, None)?;
    let short = terminal::short;
    let begin = flown.mission.as_ref().and_then(|mission| epoch::date(mission.epoch_s.as_ref()?.it));
    let begin = begin.unwrap_or_else(|| format!("{} s", short(times.start_s)));
    let count = |count: usize, of: &str| format!("{count} {of}{}", if count == 1 { "" } else { "s" });
    Ok(format!(
        "{} flies from {begin} for {} in {} steps of {} s; {} recorded, {}, {}",
        subject.name(),
        span(times.stop_s - times.start_s),
        times.steps(),
        short(times.step_s),
        count(columns, "variable"),
        count(plots.len(), "picture"),
        count(limits.len(), "limit"),
    ))
}

/// A duration in the largest unit that it has more than one of.
fn span(span_s: f64) -> String {
    const UNITS: [(f64, &str); 3] = [(86_400.0, "d"), (3600.0, "h"), (60.0, "min")];
    let unit = UNITS.into_iter().find(|(unit_s, _)| span_s >= 2.0 * unit_s);
    let (unit_s, unit) = unit.unwrap_or((1.0, "s"));
    format!("{} {unit}", terminal::short(span_s / unit_s))
}
