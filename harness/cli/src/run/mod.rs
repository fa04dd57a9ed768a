//! `heliotorque run`: runs an FMU or a system in a process of its own, records, writes, draws.

mod options;

use std::path::PathBuf;

use clap::Args;
use files::outcome::Outcome;
pub(crate) use options::Run;

/// `heliotorque run-in-child`.
#[derive(Debug, Args)]
pub(crate) struct RunInChild {
    /// The folder that the FMU was unpacked into
    #[arg(long)]
    pub unpacked_in: PathBuf,
    /// What the parent read from the standard input
    #[arg(long)]
    pub input_copy: Option<PathBuf>,
    /// What the parent was given
    #[command(flatten)]
    pub run: Run,
}

/// `heliotorque assemble`.
#[derive(Debug, Args)]
pub(crate) struct Assemble {
    /// The mission
    pub mission: PathBuf,
    /// The FMU whose library reads its files
    #[arg(long)]
    pub template: Option<PathBuf>,
    /// An empty folder, which becomes the FMU's
    #[arg(long)]
    pub into: PathBuf,
}

/// Runs in a child process.
pub(crate) fn run(arguments: &Run) -> Outcome {
    campaign::run::run(&arguments.request())
}

/// Runs in this process and sends the parent what comes of it.
pub(crate) fn run_in_child(RunInChild { unpacked_in, input_copy, run }: RunInChild) -> Outcome {
    let run = run.request();
    campaign::run::run_in_child(&campaign::run::RunInChild { unpacked_in, input_copy, run })
}

/// Puts the FMU of a mission's files together in a folder.
pub(crate) fn assemble_into(arguments: &Assemble) -> Outcome {
    campaign::run::assemble_into(&arguments.mission, arguments.template.as_deref(), &arguments.into)
}
