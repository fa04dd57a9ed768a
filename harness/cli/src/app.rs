//! From arguments to a command.

use std::{
    ffi::OsString,
    path::{Path, PathBuf},
};

use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand};
use files::outcome::Outcome;
use inputs::home;
use isolation::{Bounds, Relayed, SMALL, interrupt, large};
use terminal::Screen;

use crate::{
    check, compare, completions, draw, ephemeris, info, manual, map, new, pack, plan, plot, refit,
    run as simulation, size, study, sweep, usage, wire,
};

/// Spacecraft disturbance torque and momentum as FMUs: show, check and simulate them, pack your own.
#[derive(Debug, Parser)]
#[command(version, max_term_width = 100)]
struct Arguments {
    /// The command.
    #[command(subcommand)]
    command: Command,
}

/// The commands, in the order of [`GROUPS`].
#[derive(Debug, Subcommand)]
enum Command {
    /// Show what an FMU is, takes, gives and computes; or what a system joins
    Info(info::Info),
    /// Check an FMU, a system or a file before it is used: what is wrong, what looks odd
    Check(check::Check),
    /// Run an FMU, a system of FMUs (SSP) or a mission from start to stop
    Run(simulation::Run),
    /// Connect FMUs by names and units of their variables: a system (SSP)
    Wire(wire::Wire),
    /// Simulate many runs of a mission or an FMU whose values vary
    Sweep(sweep::Sweep),
    /// Compare two tables: the largest difference of every variable, and when
    Compare(compare::Compare),
    /// Draw tables: over time, overlaid, percentiles, histogram, scatter, heat, tornado
    Plot(plot::Plot),
    /// Write a commented file that works unchanged, or the schema of its kind
    New(new::New),
    /// Draw a spacecraft: three views and a perspective, with axes, Sun, centre of mass
    Draw(draw::Draw),
    /// Map the torque of sunlight over azimuth and elevation of the Sun
    Map(map::Map),
    /// Size wheels and propellant of a spacecraft or a mission
    Size(size::Size),
    /// Make an FMU of your own spacecraft or mission; nothing is compiled
    Pack(pack::Pack),
    /// Fit the positions of an FMU's flight: an ephemeris that spacecraft carry
    Ephemeris(ephemeris::Ephemeris),
    /// Find an optimal plan: momentum, flyby or leg by its file, or a spinner's turn
    Plan(plan::Plan),
    /// Fit centre of mass and solar.scale of a mission to a history of momentum
    Refit(refit::Refit),
    /// Run a study of the papers, or list them
    #[command(hide = true)]
    Study(study::Study),
    /// Print what a shell needs to complete commands and options
    #[command(hide = true)]
    Completions(completions::Completions),
    /// Print the manual's page of the program or of a command
    #[command(hide = true)]
    Man(manual::Manual),
    /// Runs one probe of `check` in a process of its own
    #[command(hide = true, name = "probe-in-child")]
    Probe(check::Probe),
    /// Runs an FMU for `run` in a process of its own
    #[command(hide = true)]
    RunInChild(simulation::RunInChild),
    /// Simulates runs for `sweep` in a process of its own
    #[command(hide = true)]
    SweepInChild(sweep::SweepInChild),
    /// Carries out a command that loads a library in a process of its own
    #[command(hide = true)]
    InChild(InChild),
    /// Puts the FMU of a mission's files together for `run`
    #[command(hide = true)]
    Assemble(simulation::Assemble),
}

/// `heliotorque in-child`.
#[derive(Debug, Args)]
struct InChild {
    /// Columns of the terminal that shows the output
    #[arg(long)]
    output_columns: Option<u16>,
    /// Columns of the terminal that shows notes
    #[arg(long)]
    note_columns: Option<u16>,
    /// The command
    #[arg(last = true)]
    arguments: Vec<OsString>,
}

/// The program as clap knows it.
fn program() -> clap::Command {
    usage::with_help(Arguments::command())
}

/// The command of these arguments.
fn parsed(arguments: &[OsString]) -> Result<Command, clap::Error> {
    let name = OsString::from(env!("CARGO_BIN_NAME"));
    let matches = program().try_get_matches_from([name].iter().chain(arguments))?;
    Ok(Arguments::from_arg_matches(&matches)?.command)
}

/// Parses the arguments and runs the command.
pub(crate) fn run() -> Outcome {
    let arguments: Vec<OsString> = std::env::args_os().skip(1).collect();
    let command = parsed(&arguments).unwrap_or_else(|error| usage::end(&program(), &arguments, error));
    match &command {
        // A child is ended by its parent.
        Command::Probe(_) | Command::RunInChild(_) | Command::SweepInChild(_) => {}
        Command::InChild(InChild { output_columns, note_columns, arguments }) => {
            let screen = Screen { output_columns: *output_columns, note_columns: *note_columns };
            return isolation::serve(screen, || carry_out(parsed(arguments)?));
        }
        // What was recorded until then is written.
        command => {
            interrupt::listen(matches!(command, Command::Run(_) | Command::Sweep(_)), isolation::end_all)?
        }
    }
    match loading(&command) {
        Some(relayed) => relayed.run(arguments),
        None => carry_out(command),
    }
}

/// Returns the limits of a command that loads a library in its own process; no FMU's code runs in the program's own.
fn loading(command: &Command) -> Option<Relayed> {
    let shown = |path: &Path| path.display().to_string();
    let of_template =
        |template: Option<&PathBuf>| template.map_or_else(|| "the library".to_owned(), |it| shown(it));
    let (name, patience, limits) = match command {
        Command::Info(it) if it.coefficients => (shown(&it.fmu), it.patience, SMALL),
        Command::Check(it) if it.is_file() => {
            // One time for all of it.
            let bounds = Bounds { deadline: Some(it.deadline()), ..Bounds::default() };
            return Some(Relayed { name: of_template(it.template.as_ref()), bounds, limits: SMALL });
        }
        Command::Pack(it) => {
            let library = it.library.first().or(it.reader.template.as_ref());
            (of_template(library), it.reader.patience, SMALL)
        }
        Command::Map(it) => {
            let read = it.reader.template.as_ref().unwrap_or(&it.spacecraft);
            (shown(read), it.reader.patience, SMALL)
        }
        Command::Ephemeris(it) => (shown(&it.simulated()), it.reader.patience, large(1)),
        Command::Size(size::Size { reader, .. })
        | Command::Refit(refit::Refit { reader, .. })
        | Command::Plan(plan::Plan { by_file: Some(_), reader, .. }) => {
            (of_template(reader.template.as_ref()), reader.patience, large(1))
        }
        Command::Plan(plan::Plan { spin: Some(plan::SpinCommand::Spin(it)), .. }) => {
            (of_template(it.options.template.as_ref()), it.patience, large(1))
        }
        Command::Study(it) => (it.name.clone(), it.patience, large(1)),
        _ => return None,
    };
    Some(Relayed { name, bounds: Bounds::of_calls(patience.timeout), limits })
}

fn carry_out(mut command: Command) -> Outcome {
    if let Command::Info(info::Info { fmu: file, .. })
    | Command::Check(check::Check { subject: file, .. })
    | Command::Run(simulation::Run { fmu: file, .. })
    | Command::Map(map::Map { spacecraft: file, .. }) = &mut command
    {
        *file = home::found(std::mem::take(file));
    }
    match command {
        Command::Info(arguments) => info::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Probe(arguments) => check::run_probe(&arguments),
        Command::Run(arguments) => simulation::run(&arguments),
        Command::Wire(arguments) => wire::run(&arguments),
        Command::RunInChild(arguments) => simulation::run_in_child(arguments),
        Command::Sweep(arguments) => sweep::run(&arguments),
        Command::SweepInChild(arguments) => sweep::run_in_child(arguments),
        Command::New(arguments) => new::run(&arguments),
        Command::Man(arguments) => manual::run(&arguments, program()),
        Command::Draw(arguments) => draw::run(&arguments),
        Command::Map(arguments) => map::run(&arguments),
        Command::Size(arguments) => size::run(&arguments),
        Command::Pack(arguments) => pack::run(&arguments),
        Command::Ephemeris(arguments) => ephemeris::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Plot(arguments) => plot::run(&arguments),
        Command::Completions(arguments) => completions::run(&arguments, &program()),
        Command::Plan(arguments) => plan::run(&arguments),
        Command::Refit(arguments) => refit::run(&arguments),
        Command::Study(arguments) => study::run(&arguments),
        Command::Assemble(arguments) => simulation::assemble_into(&arguments),
        Command::InChild(_) => Err("in-child: found another one in it, allowed: a command".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arguments_are_well_formed() {
        program().debug_assert();
    }
}
