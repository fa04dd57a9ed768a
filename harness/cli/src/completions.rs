//! `heliotorque completions`: what a shell needs to complete commands and options.

use std::process::ExitCode;

use clap::{Command, CommandFactory};

use crate::{
    args::{Arguments, Completions},
    outcome::Outcome,
};

/// The program's name.
const NAME: &str = env!("CARGO_PKG_NAME");

/// Prints the shell's script.
pub fn run(arguments: &Completions) -> Outcome {
    // Hidden commands would be completed too.
    let all = Arguments::command();
    let shown = all.get_subcommands().filter(|command| !command.is_hide_set()).cloned();
    let mut command = Command::new(NAME).version(env!("CARGO_PKG_VERSION")).subcommands(shown);
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, NAME, &mut script);
    terminal::print(String::from_utf8_lossy(&script).trim_end())?;
    Ok(ExitCode::SUCCESS)
}
