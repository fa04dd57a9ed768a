//! `heliotorque man`: the manual's pages, one for the program and one for each command.

use std::{fs, process::ExitCode};

use clap::{Command, CommandFactory};
use clap_mangen::Man;

use crate::{
    args::{Arguments, Manual},
    outcome::Outcome,
};

/// Name and version.
const VERSION: &str = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));

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
    let requested = match &arguments.command {
        Some(command) => format!("{program}-{command}"),
        None => program.to_owned(),
    };
    let Some((_, page)) = pages.iter().find(|(name, _)| *name == requested) else {
        let prefix = format!("{program}-");
        let names: Vec<&str> = pages.iter().filter_map(|(name, _)| name.strip_prefix(&prefix)).collect();
        let command = arguments.command.as_deref().unwrap_or_default();
        return Err(format!("found no command {command:?}, allowed: {}", names.join(", ")).into());
    };
    terminal::print(String::from_utf8_lossy(page).trim_end())?;
    Ok(ExitCode::SUCCESS)
}

/// The pages by name, of the program and of every command below it.
fn pages() -> std::io::Result<Vec<(String, Vec<u8>)>> {
    let program = Arguments::command().disable_help_subcommand(true);
    let name = program.get_name().to_owned();
    let mut pages = Vec::new();
    add(&mut pages, &program, &name, &name)?;
    Ok(pages)
}

/// Adds a command's page under its name with hyphens; `usage` is what one types.
fn add(
    pages: &mut Vec<(String, Vec<u8>)>,
    command: &Command,
    name: &str,
    usage: &str,
) -> std::io::Result<()> {
    let shown = command.clone().display_name(name.to_owned()).bin_name(usage.to_owned());
    let mut page = Vec::new();
    Man::new(shown).title(name).source(VERSION).render(&mut page)?;
    pages.push((name.to_owned(), page));
    for below in command.get_subcommands().filter(|below| !below.is_hide_set()) {
        let own = below.get_name();
        add(
            pages,
            &below.clone().disable_help_subcommand(true),
            &format!("{name}-{own}"),
            &format!("{usage} {own}"),
        )?;
    }
    Ok(())
}
