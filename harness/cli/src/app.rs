//! From arguments to a command.

use std::{
    ffi::OsString,
    path::{Path, PathBuf},
};

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use files::outcome::Outcome;
use inputs::home;
use isolation::{Bounds, Relayed, Request, SMALL, interrupt, large};

use crate::{
    check, compare, completions, draw, ephemeris, info, manual, map, new, pack, plan, plot, refit,
    run as simulation, size, sweep, usage, wire,
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
    /// Print what a shell needs to complete commands and options
    #[command(hide = true)]
    Completions(completions::Completions),
    /// Print the manual's page of the program or of a command
    #[command(hide = true)]
    Man(manual::Manual),
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
    if arguments == [isolation::CHILD] {
        return run_in_child();
    }
    let command = parsed(&arguments).unwrap_or_else(|error| usage::end(&program(), &arguments, error));
    // What was recorded until then is written.
    interrupt::listen(matches!(command, Command::Run(_) | Command::Sweep(_)), isolation::end_all)?;
    match loading(&command) {
        Some(relayed) => relayed.run(Request::Command(arguments)),
        None => carry_out(command),
    }
}

/// Does what a parent requests, which ends this process.
fn run_in_child() -> Outcome {
    let (link, request) = isolation::attach()?;
    match request {
        Request::Command(arguments) => link.relay(|| carry_out(parsed(&arguments)?)),
        Request::Assemble { mission, file, template, into } => link.relay(|| {
            campaign::run::assemble_into(
                [Path::new(&mission), Path::new(&file)],
                template.as_ref().map(Path::new),
                Path::new(&into),
            )
        }),
        Request::Probe { folder, name } => isolation::probes::run_in_child(link, Path::new(&folder), &name),
        Request::Run { arguments, folder, input_copy } => {
            let Command::Run(run) = parsed(&arguments)? else { return Err("a run's request is none".into()) };
            let input_copy = input_copy.as_ref().map(Path::new);
            campaign::run::run_in_child(link, Path::new(&folder), input_copy, &run.request())
        }
        Request::Sweep(runs) => campaign::sweep::run_in_child(link, &runs),
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
            (of_template(it.template.as_ref()), it.patience, large(1))
        }
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
        Command::Run(arguments) => simulation::run(&arguments),
        Command::Wire(arguments) => wire::run(&arguments),
        Command::Sweep(arguments) => sweep::run(&arguments),
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
