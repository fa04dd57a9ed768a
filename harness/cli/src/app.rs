//! From arguments to a command and its exit status: 0 done, 1 failed or found wanting, 2 wrong usage.

use std::{
    ffi::OsString,
    path::{Path, PathBuf},
};

use clap::{Args, CommandFactory, Parser, Subcommand};
use files::outcome::Outcome;
use inputs::home;
use isolation::{Bounds, Relayed, SMALL, interrupt, large};
use terminal::Screen;

use crate::{
    check, compare, completions, draw, ephemeris, info, manual, map, new, pack, plan, plot, refit,
    run as simulation, schema, size, study, sweep, wire,
};

/// Spacecraft disturbance torque and momentum as FMUs: show, check and simulate them, pack your own.
#[derive(Debug, Parser)]
#[command(version, max_term_width = 100)]
struct Arguments {
    /// What to do.
    #[command(subcommand)]
    command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
enum Command {
    /// Show what an FMU is, what it takes and gives, and what its sunshade and wheels come to; or what a system joins
    Info(info::Info),
    /// Check an FMU, a system, or a spacecraft before it is packed: what is wrong, what it comes to, what looks odd
    Check(check::Check),
    /// Run an FMU, a system of FMUs (SSP) or a mission from start to stop
    Run(simulation::Run),
    /// Connect FMUs by the names and units of their variables: a system (SSP) that any tool for SSP runs
    Wire(wire::Wire),
    /// Write a commented file that works unchanged: spacecraft, spinner, mission, campaign, timeline, plan or leg
    New(new::New),
    /// Draw a spacecraft's file: front, side, top and perspective, with axes, Sun, names, centre of mass, panel axes
    Draw(draw::Draw),
    /// Map the torque of sunlight over the Sun's azimuth and elevation: where it vanishes, what a degree is worth, what
    /// downlinks can undo
    Map(map::Map),
    /// Size wheels and propellant of a spacecraft or a mission: momentum by source, dumps over capacity, slews, thrusters
    Size(size::Size),
    /// Make an FMU of your own spacecraft; nothing is compiled
    Pack(pack::Pack),
    /// Fit the positions of an FMU's flight: an ephemeris that spacecraft carry, with its error
    Ephemeris(ephemeris::Ephemeris),
    /// Print the JSON Schema of a file, for editors that complete and check TOML
    Schema(schema::Schema),
    /// Simulate many runs of a mission or an FMU whose values vary, and keep what is needed of each
    Sweep(sweep::Sweep),
    /// Run a study of the papers, or list them
    Study(study::Study),
    /// Find an optimal plan
    #[command(subcommand)]
    Plan(plan::Plan),
    /// Fit centre of mass and solar.scale of a mission to a history of momentum, with their covariance
    Refit(refit::Refit),
    /// Compare two tables, as `run` and campaigns write them: the largest difference of every variable, and when
    Compare(compare::Compare),
    /// Draw tables, as `run` and campaigns write them: over time, overlaid, percentiles, histogram, scatter, heat, tornado
    Plot(plot::Plot),
    /// Print what a shell needs to complete commands and options
    Completions(completions::Completions),
    /// Print the manual's page of the program or of a command
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

/// Parses the arguments and runs the command.
pub(crate) fn run() -> Outcome {
    let command = Arguments::parse().command;
    match &command {
        // A child is ended by its parent.
        Command::Probe(_) | Command::RunInChild(_) | Command::SweepInChild(_) => {}
        Command::InChild(InChild { output_columns, note_columns, arguments }) => {
            let screen = Screen { output_columns: *output_columns, note_columns: *note_columns };
            let given = [OsString::from(env!("CARGO_BIN_NAME"))].into_iter().chain(arguments.iter().cloned());
            return isolation::serve(screen, || carry_out(Arguments::parse_from(given).command));
        }
        // What was recorded until then is written.
        command => {
            interrupt::listen(matches!(command, Command::Run(_) | Command::Sweep(_)), isolation::end_all)?
        }
    }
    match loading(&command) {
        Some(relayed) => relayed.run(std::env::args_os().skip(1)),
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
        Command::Pack(it) => (of_template(it.library.first().or(it.template.as_ref())), it.patience, SMALL),
        Command::Map(it) => (shown(it.template.as_ref().unwrap_or(&it.spacecraft)), it.patience, SMALL),
        Command::Size(it) => (of_template(it.template.as_ref()), it.patience, large(1)),
        Command::Ephemeris(it) => (shown(&it.simulated()), it.patience, large(1)),
        Command::Plan(plan::Plan::Momentum(it) | plan::Plan::Flyby(it)) => {
            (of_template(it.template.as_ref()), it.patience, large(1))
        }
        Command::Plan(plan::Plan::Leg(it)) => (of_template(it.template.as_ref()), it.patience, large(1)),
        Command::Refit(it) => (of_template(it.template.as_ref()), it.patience, large(1)),
        Command::Plan(plan::Plan::Spin(it)) => (of_template(it.options.fmu.as_ref()), it.patience, large(1)),
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
        Command::Man(arguments) => manual::run(&arguments, Arguments::command()),
        Command::Draw(arguments) => draw::run(&arguments),
        Command::Map(arguments) => map::run(&arguments),
        Command::Size(arguments) => size::run(&arguments),
        Command::Pack(arguments) => pack::run(&arguments),
        Command::Schema(arguments) => schema::run(&arguments),
        Command::Ephemeris(arguments) => ephemeris::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Plot(arguments) => plot::run(&arguments),
        Command::Completions(arguments) => completions::run(&arguments, &Arguments::command()),
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
        Arguments::command().debug_assert();
    }
}
