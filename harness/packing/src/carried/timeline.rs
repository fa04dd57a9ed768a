//! Summary of a timeline file, for `info`, `check` and `pack`.

use std::path::{Path, PathBuf};

use files::outcome::Refusal;
use fmi::{Fmu, Value};
use inputs::{reading::refusal, variables::item};
use model_description::Description;
use physics::{
    environment::dates,
    guidance::timeline::{Timeline, TimelineClock},
    spacecraft::{MESSENGER_TOML, Spacecraft},
    toml::Problem,
};

/// Its name in the resources.
pub const FILE: &str = "timeline.toml";

/// A variable that the models with modes and steered burns have.
const OF_MODES: &str = "mode.request";

/// Reads the timeline in an FMU's resources, as its model does, or its fault.
pub fn read(fmu: &Fmu, resources: &Path) -> Result<String, Refusal> {
    let text = |file: &str| files::read_text(&resources.join(file));
    let spacecraft = Spacecraft::from_toml("spacecraft.toml", &text("spacecraft.toml")?).map_err(refusal)?;
    let has_modes = fmu.description().variables.iter().any(|it| it.name == OF_MODES);
    let read = if has_modes { Timeline::from_toml } else { Timeline::of_plant };
    read(FILE, &text(FILE)?, &spacecraft).map(|it| summary(&it)).map_err(refusal)
}

/// Names of the commands in the timeline of an FMU that is unpacked there; `None` without one.
pub fn names(folder: &Path) -> Option<Vec<String>> {
    let text = |file: &str| files::read_text(&folder.join("resources").join(file)).ok();
    let spacecraft = Spacecraft::from_toml("", &text("spacecraft.toml")?).ok()?;
    Some(Timeline::of_plant(FILE, &text(FILE)?, &spacecraft).ok()?.names.to_vec())
}

/// How many commands, positions of panels and events, from when to when.
pub fn summary(timeline: &Timeline) -> String {
    let shown = |time_s: f64| match timeline.clock {
        TimelineClock::Epoch => dates::utc(time_s),
        TimelineClock::FmiTime => format!("{} s", terminal::short(time_s)),
    };
    let (entries, panels, events) = (&timeline.entries, &timeline.panels, &timeline.events);
    let until = entries.last().and_then(|entry| entry.until_s);
    // Begin of the first and end of the last, where that has one.
    let commands =
        entries.first().map(|entry| (entry.at_s, until.map_or_else(|| "the end".to_owned(), shown)));
    let positions = panels.first().map(|it| (it.at_s, "the end".to_owned()));
    let last_event = events.last().map_or_else(String::new, |it| shown(it.at_s));
    let happen = events.first().map(|it| (it.at_s, last_event));
    let counted = [
        (entries.len(), "command", commands),
        (panels.len(), "position of the panels", positions),
        (events.len(), "event", happen),
    ];
    let parts = counted.into_iter().filter_map(|(count, what, span)| {
        let (begin_s, end) = span?;
        let begin = shown(begin_s);
        let counted = numbered(count, what);
        Some(match begin == end {
            true => format!("{counted} at {begin}"),
            false => format!("{counted} from {begin} to {end}"),
        })
    });
    parts.collect::<Vec<_>>().join(", ")
}

/// Report of a timeline that Guidance and MomentumPlant can carry out, read with instruments, sets of thrusters and panels of their own
/// spacecraft.
///
/// # Errors
/// Everything wrong in the file.
pub fn checked(file: &str, text: &str) -> Result<String, Refusal> {
    let spacecraft = Spacecraft::from_toml("messenger.toml", MESSENGER_TOML).map_err(refusal)?;
    let instruments: Vec<&str> = spacecraft.instruments.iter().map(|it| it.name.as_str()).collect();
    let read = Timeline::from_toml(file, text, &spacecraft).map_err(refusal)?;
    let of_one = of_one_model(file, text, &spacecraft, &read);
    Ok(format!(
        "{}; with the models' own spacecraft, its instruments {}, its sets of thrusters {} and its {} panels; \
         `pack --timeline` judges it for yours{}",
        summary(&read),
        instruments.join(", "),
        spacecraft.thruster_sets.join(", "),
        spacecraft.panels.len(),
        of_one.iter().map(|line| format!("\n{line}")).collect::<String>()
    ))
}

/// Names the parts of a timeline that one of both models alone carries out, a line each.
pub fn of_one_model(file: &str, text: &str, spacecraft: &Spacecraft, timeline: &Timeline) -> Vec<String> {
    let refused = Timeline::of_plant(file, text, spacecraft).err();
    let problems = refused.map_or_else(Vec::new, |error| error.problems);
    let place = |line: Option<usize>| line.map_or_else(String::new, |line| format!(":{line}"));
    let guidance = problems.into_iter().map(|Problem { line, key, found, .. }| {
        format!("Guidance only: {file}{}: {key}: {found}; MomentumPlant refuses it", place(line))
    });
    let events = &timeline.events;
    let counted = [
        (timeline.panels.len(), "position of the panels"),
        (events.iter().filter(|it| it.maneuver.is_some()).count(), "maneuver"),
        (events.iter().filter(|it| it.center_of_mass_body_m.is_some()).count(), "centre of mass"),
    ];
    let plant: Vec<String> = counted
        .into_iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, what)| numbered(count, what))
        .collect();
    let plant = (!plant.is_empty())
        .then(|| format!("MomentumPlant only: {}; Guidance leaves them out", plant.join(", ")));
    guidance.chain(plant).collect()
}

/// A count of what the first word names.
fn numbered(count: usize, what: &str) -> String {
    let (word, rest) = what.split_at(what.find(' ').unwrap_or(what.len()));
    format!("{count} {word}{}{rest}", if count == 1 { "" } else { "s" })
}

/// A warning for each FMU whose timeline places panels that it turns by another rule; `parts` are what the variables of each
/// begin with, and the folder that it is unpacked in.
pub fn warnings(
    description: &Description,
    sets: &[(String, Value)],
    parts: &[(String, PathBuf)],
) -> Vec<String> {
    let read = |folder: &Path| files::read_text(&folder.join("resources").join(FILE)).ok();
    let warning = |(prefix, folder): &(String, PathBuf)| {
        panels_without_effect(&read(folder)?, description, sets, prefix)
    };
    parts.iter().filter_map(warning).collect()
}

/// A warning where a timeline places panels that are turned by another rule.
pub fn panels_without_effect(
    text: &str,
    description: &Description,
    sets: &[(String, Value)],
    prefix: &str,
) -> Option<String> {
    text.parse::<toml::Table>().ok()?.get("panels")?;
    let control = |number: usize| item(description, sets, &format!("{prefix}panel[{number}].control"));
    let controls: Vec<&str> = (1..).map_while(control).collect();
    (!controls.is_empty() && !controls.contains(&"timeline")).then(|| {
        format!(
            "[[panels]] of the timeline are without effect: found {prefix}panel[k].control = {}, allowed: timeline",
            controls.join(", ")
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_there_is_counted_with_its_span() {
        let spacecraft = Spacecraft::from_toml("messenger.toml", MESSENGER_TOML).unwrap();
        let printed = |text: &str| {
            let timeline = Timeline::from_toml("t.toml", text, &spacecraft).unwrap();
            (summary(&timeline), of_one_model("t.toml", text, &spacecraft, &timeline))
        };
        let (all, of_one) = printed(
            "[[command]]\nat = 0\nscenario = \"burn\"\n[[panels]]\nat = 0\nsunOffset = 1\n[[panels]]\nat = 9\nsunOffset = 1\n\
             [[event]]\nat = 5\ncenterOfMass = [0, 0, 0]\nmaneuver = { deltaV = [1, 0, 0] }",
        );
        assert_eq!(
            all,
            "1 command from 0 s to the end, 2 positions of the panels from 0 s to the end, 1 event at 5 s"
        );
        let expected = [
            "Guidance only: t.toml:3: command[1].scenario: the scenario burn; MomentumPlant refuses it",
            "MomentumPlant only: 2 positions of the panels, 1 maneuver, 1 centre of mass; Guidance leaves them out",
        ];
        assert_eq!(of_one, expected);
        let (events, of_one) =
            printed("[[event]]\nat = 5\ndump = true\n[[event]]\nat = \"1 h\"\ndump = [0, 0, 1]");
        assert_eq!((events.as_str(), of_one.len()), ("2 events from 5 s to 3600 s", 0));
    }
}
