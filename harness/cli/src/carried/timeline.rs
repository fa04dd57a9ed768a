//! The timeline in an FMU, for `info` and `check`.

use std::path::Path;

use physics::{
    environment::dates,
    guidance::timeline::{Timeline, TimelineClock},
    spacecraft::Spacecraft,
};

/// Its name in the resources.
pub(crate) const FILE: &str = "timeline.toml";

/// Which commands an FMU's resources hold, or what is wrong with them.
pub(crate) fn read(resources: &Path) -> Result<String, String> {
    let text = |file: &str| files::read_text(&resources.join(file));
    let spacecraft = Spacecraft::from_toml("spacecraft.toml", &text("spacecraft.toml")?)
        .map_err(|error| error.to_string())?;
    let timeline = Timeline::from_toml(FILE, &text(FILE)?, &spacecraft);
    timeline.map(|timeline| summary(&timeline)).map_err(|error| error.to_string())
}

/// How many commands from when to when.
pub(crate) fn summary(timeline: &Timeline) -> String {
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
