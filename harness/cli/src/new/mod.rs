//! `heliotorque new`: a commented file that works unchanged, to start from.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use files::{
    Destination, is_stdout,
    outcome::{self, Answer, Outcome},
};
use inputs::ending::check_ending;

use crate::schema::SchemaKind;

/// `heliotorque new`.
#[derive(Debug, Args)]
pub(crate) struct New {
    /// Kind of the file
    #[arg(value_enum, required_unless_present = "schema")]
    pub kind: Option<NewKind>,
    /// The file to write, here or by --output; otherwise the kind's name with .toml, in this folder; - is the standard output
    pub file: Option<PathBuf>,
    /// The file to write
    #[arg(long, short, value_name = "FILE", conflicts_with = "file")]
    pub output: Option<PathBuf>,
    /// Write the JSON Schema of a kind of file, for editors that complete and check TOML, to the standard output or --output
    #[arg(long, value_name = "KIND", value_enum, conflicts_with_all = ["kind", "file"])]
    pub schema: Option<SchemaKind>,
    /// Write over files that are there
    #[arg(long)]
    pub force: bool,
}

/// A kind of file that people write.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum NewKind {
    /// A spacecraft, for `check`, `draw`, `pack`
    Spacecraft,
    /// A spin-stabilised spacecraft, for `check`, `pack`, `plan spin`; with spinner-mission.toml, a mission of it
    Spinner,
    /// A communications satellite in geostationary orbit; with comsat-mission.toml, a mission of it
    Comsat,
    /// A `CubeSat` in low Earth orbit; with cubesat-mission.toml, a mission of it
    Cubesat,
    /// An orbiter of a small asteroid; with asteroid-mission.toml, a mission of it
    Asteroid,
    /// A telescope behind a sunshield near the Sun-Earth point L2; with telescope-mission.toml, a mission of it
    Telescope,
    /// Simulation of an FMU: its times, values and recorded variables; for `run`, `check`, `pack`
    Mission,
    /// Commands, positions of panels and events over time, for `pack --timeline`
    Timeline,
    /// Ranges of arrays and attitude that hold a mission's momentum, for `plan`; with plan-mission.toml, the mission
    Plan,
    /// The place and date at which a leg begins, and the encounter that it leads to, for `plan` of a leg; with leg-mission.toml, the mission
    Leg,
    /// Variables that vary over many runs, and the values recorded of each, for `sweep`; with mission.toml, the mission
    Campaign,
}

/// Text of the example file of this name.
macro_rules! example {
    ($name:literal) => {
        include_str!(concat!("../../../../fmu-src/resources/examples/", $name))
    };
}

/// A file to write.
struct Content {
    /// Its usual name.
    file: &'static str,
    /// The name that its text has for itself.
    named: &'static str,
    text: &'static str,
    /// Name and text of a mission beside it.
    mission: Option<(&'static str, &'static str)>,
}

impl NewKind {
    fn content(self) -> Content {
        let alone = |file, text| Content { file, named: file, text, mission: None };
        let mission = alone("mission.toml", include_str!("mission.toml"));
        match self {
            Self::Spacecraft => alone("spacecraft.toml", include_str!("spacecraft.toml")),
            Self::Spinner => Content {
                mission: Some(("spinner-mission.toml", include_str!("spinner-mission.toml"))),
                ..alone("spinner.toml", include_str!("spinner.toml"))
            },
            Self::Comsat => Content {
                mission: Some(("comsat-mission.toml", example!("missions/comsat.toml"))),
                ..alone("comsat.toml", example!("comsat.toml"))
            },
            Self::Cubesat => Content {
                file: "cubesat.toml",
                mission: Some(("cubesat-mission.toml", example!("missions/cubesat-12u.toml"))),
                ..alone("cubesat-12u.toml", example!("cubesat-12u.toml"))
            },
            Self::Asteroid => Content {
                file: "asteroid.toml",
                mission: Some(("asteroid-mission.toml", example!("missions/asteroid-orbiter.toml"))),
                ..alone("asteroid-orbiter.toml", example!("asteroid-orbiter.toml"))
            },
            Self::Telescope => Content {
                file: "telescope.toml",
                mission: Some(("telescope-mission.toml", example!("missions/sunshield-telescope.toml"))),
                ..alone("sunshield-telescope.toml", example!("sunshield-telescope.toml"))
            },
            Self::Mission => mission,
            Self::Timeline => alone("timeline.toml", include_str!("timeline.toml")),
            Self::Plan => Content {
                mission: Some(("plan-mission.toml", include_str!("plan-mission.toml"))),
                ..alone("plan.toml", include_str!("plan.toml"))
            },
            Self::Leg => Content {
                mission: Some(("leg-mission.toml", include_str!("leg-mission.toml"))),
                ..alone("leg.toml", include_str!("leg.toml"))
            },
            Self::Campaign => Content {
                mission: Some((mission.file, mission.text)),
                ..alone("campaign.toml", include_str!("campaign.toml"))
            },
        }
    }
}

/// The text with the commands in its head for the file's own name.
fn with_commands_of(text: &str, name: &str, own: &str) -> String {
    const COMMAND: &str = "#   heliotorque ";
    let line = |line: &str| match line.strip_prefix(COMMAND) {
        Some(rest) => format!("{COMMAND}{}\n", rest.replacen(name, own, 1)),
        None => format!("{line}\n"),
    };
    text.lines().map(line).collect()
}

/// The text of a mission; one that flies a spacecraft gets this one's name, and the command in its head the mission's own.
fn mission_of(text: &str, craft: &str, own: &str) -> String {
    if !text.lines().any(|line| line.starts_with("spacecraft = ")) {
        return text.to_owned();
    }
    let line = |line: &str| match line {
        line if line.starts_with("#   heliotorque run ") => format!("#   heliotorque run {own}\n"),
        line if line.starts_with("spacecraft = ") => format!("spacecraft = \"{craft}\"\n"),
        line => format!("{line}\n"),
    };
    text.lines().map(line).collect()
}

/// Writes the mission beside a file; one that is there stays unless `force` is given.
fn write_mission(content: &Content, path: &Path, force: bool) -> Result<(), String> {
    let Some((name, text)) = content.mission else { return Ok(()) };
    let beside = path.with_file_name(name);
    let shown = beside.display();
    if std::fs::symlink_metadata(&beside).is_ok() && !force {
        terminal::note(&format!("{shown}: there already, kept: see --force"));
        return Ok(());
    }
    let craft = path.file_name().unwrap_or_default().to_string_lossy();
    let text = mission_of(text, &craft, name);
    Destination::open(&beside, "FILE", &[path])?.fill(|file| file.write_all(text.as_bytes()))?;
    terminal::note(&format!("{shown}: written, the mission of {}", path.display()));
    Ok(())
}

/// Writes the file, and the mission that it names.
pub(crate) fn run(arguments: &New) -> Outcome {
    let given = arguments.output.as_deref().or(arguments.file.as_deref());
    let open = |path: &Path| {
        let is_there = path != Path::new("-") && std::fs::symlink_metadata(path).is_ok();
        if is_there && !arguments.force {
            let path = path.display();
            return Err(format!("{path}: found a file, allowed: a name that is free: see --force"));
        }
        check_ending(path, if arguments.schema.is_some() { "json" } else { "toml" })?;
        Destination::open(path, "FILE", &[])
    };
    if let Some(kind) = arguments.schema {
        let text = format!("{}\n", kind.text().trim_end());
        let Some(path) = given.filter(|path| !is_stdout(path)) else {
            return outcome::printed(text.trim_end());
        };
        return outcome::written(open(path)?, text.as_bytes(), &format!("{}: written", path.display()));
    }
    let Some(kind) = arguments.kind else { return Err("allowed: a kind of file: see --help".into()) };
    let content = kind.content();
    let path = given.unwrap_or(Path::new(content.file));
    let destination = open(path)?;
    let is_stdout = destination.is_stdout();
    let own =
        path.file_name().filter(|_| !is_stdout).map_or(content.file.into(), |own| own.to_string_lossy());
    let text = with_commands_of(content.text, content.named, &own);
    destination.fill(|file| file.write_all(text.as_bytes()))?;
    if !is_stdout {
        write_mission(&content, path, arguments.force)?;
        let next = match kind {
            NewKind::Mission => "run",
            _ => "check",
        };
        terminal::print(&format!("{0}: written; next: heliotorque {next} {0}", path.display()))?;
    }
    Ok(Answer::Yes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_commands_in_a_file_name_it() {
        for kind in NewKind::value_variants() {
            let Content { named, text, .. } = kind.content();
            assert_eq!(with_commands_of(text, named, named), text);
            let own = with_commands_of(text, named, "mine.toml");
            assert!(own.contains("#   heliotorque check mine.toml"), "{own}");
            assert_eq!(
                own.lines().filter(|line| !line.starts_with('#')).collect::<Vec<_>>(),
                text.lines().filter(|line| !line.starts_with('#')).collect::<Vec<_>>()
            );
        }
    }
}
