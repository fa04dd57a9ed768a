//! `heliotorque completions`: what a shell needs to complete commands and options.

use clap::{Args, Command};
use clap_complete::Shell;
use files::outcome::{self, Outcome};

/// The program's name.
const NAME: &str = env!("CARGO_PKG_NAME");

/// Shown with the help.
const EXAMPLE: &str = "\
Example:
  heliotorque completions bash > ~/.local/share/bash-completion/completions/heliotorque
  heliotorque completions zsh > ~/.zfunc/_heliotorque        with fpath+=~/.zfunc before compinit in ~/.zshrc
  heliotorque completions fish > ~/.config/fish/completions/heliotorque.fish";

/// `heliotorque completions`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Completions {
    /// The shell
    #[arg(value_enum)]
    pub shell: Shell,
}

/// Prints the shell's script for a program.
pub(crate) fn run(arguments: &Completions, program: &Command) -> Outcome {
    // Hidden commands would be completed too.
    let shown = program.get_subcommands().filter(|command| !command.is_hide_set()).cloned();
    let mut command = Command::new(NAME).version(env!("CARGO_PKG_VERSION")).subcommands(shown);
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, NAME, &mut script);
    outcome::printed(String::from_utf8_lossy(&script).trim_end())
}
