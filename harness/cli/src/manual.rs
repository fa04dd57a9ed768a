//! `heliotorque man`: the manual's pages, one for the program and one for each command.

use std::{fs, path::PathBuf, process::ExitCode};

use clap::{Args, CommandFactory};
use clap_mangen::Man;

use crate::{args::Arguments, outcome::Outcome};

/// `heliotorque man`.
#[derive(Debug, Args)]
pub struct Manual {
    /// The command whose page it is; otherwise the program's
    pub command: Option<String>,
    /// Write every page into this folder instead: heliotorque.1, heliotorque-run.1, ...
    #[arg(long, value_name = "FOLDER", conflicts_with = "command")]
    pub output: Option<PathBuf>,
}

/// Prints a page, or writes all of them.
pub fn run(arguments: &Manual) -> Outcome {
    let pages = pages()?;
    if let Some(folder) = &arguments.output {
        for (name, page) in &pages {
            let path = folder.join(format!("{name}.1"));
            fs::write(&path, page).map_err(|error| format!("{}: {error}: see --output", path.display()))?;
        }
        return Ok(ExitCode::SUCCESS);
    }
    let program = env!("CARGO_PKG_NAME");
    let wanted = match &arguments.command {
        Some(command) => format!("{program}-{command}"),
        None => program.to_owned(),
    };
    let Some((_, page)) = pages.iter().find(|(name, _)| *name == wanted) else {
        let prefix = format!("{program}-");
        let names: Vec<&str> = pages.iter().filter_map(|(name, _)| name.strip_prefix(&prefix)).collect();
        let command = arguments.command.as_deref().unwrap_or_default();
        return Err(format!("found no command {command:?}, allowed: {}", names.join(", ")).into());
    };
    terminal::print(String::from_utf8_lossy(page).trim_end())?;
    Ok(ExitCode::SUCCESS)
}

/// The pages by name.
fn pages() -> std::io::Result<Vec<(String, Vec<u8>)>> {
    let program = Arguments::command().disable_help_subcommand(true);
    let name = program.get_name().to_owned();
    let shown = program.get_subcommands().filter(|command| !command.is_hide_set());
    let mut commands = vec![(name.clone(), program.clone())];
    for command in shown {
        let full = format!("{name}-{}", command.get_name());
        let usage = format!("{name} {}", command.get_name());
        let page = command.clone().version(env!("CARGO_PKG_VERSION")).display_name(full.clone()).bin_name(usage);
        commands.push((full, page));
    }
    let mut pages = Vec::new();
    for (name, command) in commands {
        let mut page = Vec::new();
        Man::new(command).render(&mut page)?;
        pages.push((name, page));
    }
    Ok(pages)
}
