//! The timeline in an FMU of this project, for `info` and `check`.

use loader::Fmu;
use physics::{
    environment::dates,
    guidance::timeline::{Timeline, TimelineClock},
    spacecraft::Spacecraft,
};

use crate::home;

/// Its name in the resources.
pub const FILE: &str = "timeline.toml";

/// The timeline of an FMU, or what is wrong with it, a line for each problem; `None` where there is none.
pub fn of(fmu: &Fmu) -> Option<Result<Timeline, String>> {
    // Other exporters' files of this name mean something else.
    let resources = fmu.folder().join("resources");
    if !home::is_ours(fmu.description()) || !resources.join(FILE).exists() {
        return None;
    }
    let text = |file: &str| files::read_text(&resources.join(file));
    let read = || {
        let spacecraft = Spacecraft::from_toml("spacecraft.toml", &text("spacecraft.toml")?)
            .map_err(|error| error.to_string())?;
        Timeline::from_toml(FILE, &text(FILE)?, &spacecraft.instruments).map_err(|error| error.to_string())
    };
    Some(read())
}

/// How many commands from when to when.
pub fn summary(timeline: &Timeline) -> String {
    let entries = timeline.entries();
    let shown = |time_s: f64| match timeline.clock() {
        TimelineClock::Epoch => dates::utc(time_s),
        TimelineClock::FmiTime => format!("{} s", terminal::short(time_s)),
    };
    let begin = entries.first().map_or_else(String::new, |entry| shown(entry.at_s));
    let end = entries.last().and_then(|entry| entry.until_s).map_or_else(|| "the end".to_owned(), shown);
    let plural = if entries.len() == 1 { "command" } else { "commands" };
    format!("{} {plural} from {begin} to {end}", entries.len())
}
