//! `heliotorque man`: the manual's pages, one for the program and one for each command.

use std::path::PathBuf;

use clap::{Args, Command};
use clap_mangen::Man;
use files::{
    Destination,
    outcome::{self, Answer, Outcome, STATUSES},
};

/// `heliotorque man`.
#[derive(Debug, Args)]
pub(crate) struct Manual {
    /// The command whose page it is, plan-spin for one below another; otherwise the program's
    pub command: Option<String>,
    /// Write every page into this folder instead: heliotorque.1, heliotorque-run.1, ...
    #[arg(long, short, value_name = "FOLDER", conflicts_with = "command")]
    pub output: Option<PathBuf>,
}

/// Name and version.
const VERSION: &str = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));

/// Prints a page, or writes all of them.
pub(crate) fn run(arguments: &Manual, program: Command) -> Outcome {
    let name = program.get_name().to_owned();
    let mut pages = Vec::new();
    add(&mut pages, program, &name, &name)?;
    if let Some(folder) = &arguments.output {
        for (name, page) in &pages {
            let path = folder.join(format!("{name}.1"));
            Destination::open(&path, "--output", &[])?.fill(|file| file.write_all(page))?;
        }
        return Ok(Answer::Yes);
    }
    let requested = match &arguments.command {
        Some(command) => format!("{name}-{command}"),
        None => name.clone(),
    };
    let Some((_, page)) = pages.iter().find(|(page, _)| *page == requested) else {
        let prefix = format!("{name}-");
        let names: Vec<&str> = pages.iter().filter_map(|(name, _)| name.strip_prefix(&prefix)).collect();
        let command = arguments.command.as_deref().unwrap_or_default();
        return Err(format!("found no command {command:?}, allowed: {}", names.join(", ")).into());
    };
    outcome::printed(String::from_utf8_lossy(page).trim_end())
}

/// Adds the page of a command and of every command below it, under their names with hyphens; `usage` is what one types.
fn add(pages: &mut Vec<(String, Vec<u8>)>, command: Command, name: &str, usage: &str) -> std::io::Result<()> {
    let command =
        command.disable_help_subcommand(true).display_name(name.to_owned()).bin_name(usage.to_owned());
    let mut page = Vec::new();
    Man::new(command.clone()).title(name).source(VERSION).render(&mut page)?;
    page.extend(b".SH \"EXIT STATUS\"\n");
    for (status, what) in STATUSES {
        page.extend(format!(".TP\n\\fB{status}\\fR\n{what}\n").bytes());
    }
    pages.push((name.to_owned(), page));
    for below in command.get_subcommands().filter(|below| !below.is_hide_set()) {
        let own = below.get_name();
        add(pages, below.clone(), &format!("{name}-{own}"), &format!("{usage} {own}"))?;
    }
    Ok(())
}
