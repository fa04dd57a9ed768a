//! `heliotorque new`: a commented file that works unchanged, to start from.

use std::{
    path::{Path, PathBuf},
    process::ExitCode,
};

use clap::{Args, ValueEnum};
use files::Destination;

use crate::outcome::Outcome;

/// `heliotorque new`.
#[derive(Debug, Args)]
pub(crate) struct New {
    /// Of which kind
    #[arg(value_enum)]
    pub kind: NewKind,
    /// The file to write; otherwise the kind's name with .toml, in this folder; - is the standard output
    pub file: Option<PathBuf>,
    /// Write over files that are there
    #[arg(long)]
    pub force: bool,
}

/// A kind of file that people write.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum NewKind {
    /// A spacecraft, for `check`, `draw`, `pack`
    Spacecraft,
    /// A spin-stabilised spacecraft, for `check`, `pack`, `plan spin`
    Spinner,
    /// What is simulated, when, with which values, and what is recorded; for `run`, `check`, `pack --mission`
    Mission,
    /// Commands, positions of panels and events over time, for `pack --timeline`
    Timeline,
    /// How far arrays and attitude may go to hold a mission's momentum, for `plan momentum`; with plan-mission.toml, the mission
    Plan,
    /// The place and date at which a leg begins, and the encounter that it leads to, for `plan leg`; with leg-mission.toml, the mission
    Leg,
    /// What varies over many runs, and what is kept of each, for `sweep`; with mission.toml, the mission
    Campaign,
}

impl NewKind {
    /// Name and text of the mission that it names.
    fn mission(self) -> Option<(&'static str, &'static str)> {
        match self {
            Self::Plan => Some(("plan-mission.toml", include_str!("plan-mission.toml"))),
            Self::Leg => Some(("leg-mission.toml", include_str!("leg-mission.toml"))),
            Self::Campaign => Some(Self::Mission.content()),
            _ => None,
        }
    }

    /// The file's name and text.
    fn content(self) -> (&'static str, &'static str) {
        match self {
            Self::Spacecraft => ("spacecraft.toml", include_str!("spacecraft.toml")),
            Self::Spinner => ("spinner.toml", include_str!("spinner.toml")),
            Self::Mission => ("mission.toml", include_str!("mission.toml")),
            Self::Timeline => ("timeline.toml", include_str!("timeline.toml")),
            Self::Plan => ("plan.toml", include_str!("plan.toml")),
            Self::Leg => ("leg.toml", include_str!("leg.toml")),
            Self::Campaign => ("campaign.toml", include_str!("campaign.toml")),
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

/// Writes the mission that a file names beside it; one that is there stays unless `force` is given.
fn write_mission(kind: NewKind, path: &Path, force: bool) -> Result<(), String> {
    let Some((name, text)) = kind.mission() else { return Ok(()) };
    let beside = path.with_file_name(name);
    let shown = beside.display();
    if std::fs::symlink_metadata(&beside).is_ok() && !force {
        terminal::note(&format!("{shown}: there already, kept: see --force"));
        return Ok(());
    }
    Destination::open(&beside, "FILE", &[path])?.fill(|file| file.write_all(text.as_bytes()))?;
    terminal::note(&format!("{shown}: written, the mission that {} names", path.display()));
    Ok(())
}

/// Writes the file, and the mission that it names.
pub(crate) fn run(arguments: &New) -> Outcome {
    let (name, text) = arguments.kind.content();
    let path = arguments.file.as_deref().unwrap_or(Path::new(name));
    let is_there = path != Path::new("-") && std::fs::symlink_metadata(path).is_ok();
    if is_there && !arguments.force {
        let path = path.display();
        return Err(format!("{path}: found a file, allowed: a name that is free: see --force").into());
    }
    let destination = Destination::open(path, "FILE", &[])?;
    let is_stdout = destination.is_stdout();
    let own =
        path.file_name().filter(|_| !is_stdout).map_or_else(|| name.into(), |own| own.to_string_lossy());
    let text = with_commands_of(text, name, &own);
    destination.fill(|file| file.write_all(text.as_bytes()))?;
    if !is_stdout {
        write_mission(arguments.kind, path, arguments.force)?;
        let next = match arguments.kind {
            NewKind::Mission => "run",
            _ => "check",
        };
        terminal::print(&format!("{0}: written; next: heliotorque {next} {0}", path.display()))?;
    }
    Ok(ExitCode::SUCCESS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_commands_in_a_file_name_it() {
        for kind in NewKind::value_variants() {
            let (name, text) = kind.content();
            assert_eq!(with_commands_of(text, name, name), text);
            let own = with_commands_of(text, name, "mine.toml");
            assert!(own.contains("#   heliotorque check mine.toml"), "{own}");
            assert_eq!(
                own.lines().filter(|line| !line.starts_with('#')).collect::<Vec<_>>(),
                text.lines().filter(|line| !line.starts_with('#')).collect::<Vec<_>>()
            );
        }
    }
}
