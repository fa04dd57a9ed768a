//! From arguments to a command and its exit status: 0 done, 1 failed or found wanting, 2 wrong usage.

use std::{
    ffi::OsString,
    path::{Path, PathBuf},
    process::ExitCode,
};

use clap::Parser;
use terminal::Screen;

use crate::{
    args::{Arguments, Command, InChild, Plan, SchemaKind},
    check,
    child::{self, Bounds, LARGE, Relayed, SMALL},
    completions, draw, ephemeris, home, info, interrupt, manual, map, new,
    outcome::Outcome,
    pack, plan, run as simulation, study, wire,
};

// JSON Schemas, kept in step with their readers by tests of `physics` and of the mission.
const SPACECRAFT_SCHEMA: &str = include_str!("../../../fmu-src/resources/spacecraft.schema.json");
const SPINNER_SCHEMA: &str = include_str!("../../../fmu-src/resources/spinner.schema.json");
const MISSION_SCHEMA: &str = include_str!("../../../fmu-src/resources/mission.schema.json");
const TIMELINE_SCHEMA: &str = include_str!("../../../fmu-src/resources/timeline.schema.json");
const EPHEMERIS_SCHEMA: &str = include_str!("../../../fmu-src/resources/ephemeris.schema.json");

/// Parses the arguments and runs the command.
pub fn run() -> Outcome {
    let command = Arguments::parse().command;
    match &command {
        // A child is ended by its parent.
        Command::Probe(_) | Command::RunInChild(_) => {}
        Command::InChild(InChild { output_columns, note_columns, arguments }) => {
            let screen = Screen { output_columns: *output_columns, note_columns: *note_columns };
            let given = [OsString::from(env!("CARGO_BIN_NAME"))].into_iter().chain(arguments.iter().cloned());
            return child::serve(screen, || carry_out(Arguments::parse_from(given).command));
        }
        // What was recorded until then is written.
        Command::Run(_) => interrupt::listen(true)?,
        _ => interrupt::listen(false)?,
    }
    match loading(&command) {
        Some(relayed) => relayed.run(std::env::args_os().skip(1)),
        None => carry_out(command),
    }
}

/// What a command that loads a library in its own process may take; no FMU's code runs in the program's own.
fn loading(command: &Command) -> Option<Relayed> {
    let shown = |path: &Path| path.display().to_string();
    let of_call = |timeout_s: f64| Bounds { call_s: Some(timeout_s), ..Bounds::default() };
    let of_template =
        |template: Option<&PathBuf>| template.map_or_else(|| "the library".to_owned(), |it| shown(it));
    let (name, bounds, limits) = match command {
        Command::Info(it) if it.coefficients => (shown(&it.fmu), of_call(it.patience.timeout), SMALL),
        Command::Check(it) if check::is_file(it) => {
            // One time for all of it.
            let bounds = Bounds { deadline: Some(check::deadline(it)), ..Bounds::default() };
            (of_template(it.template.as_ref()), bounds, SMALL)
        }
        Command::Pack(it) => {
            (of_template(it.library.as_ref().or(it.template.as_ref())), of_call(it.patience.timeout), SMALL)
        }
        Command::Map(it) => {
            (shown(it.template.as_ref().unwrap_or(&it.spacecraft)), of_call(it.patience.timeout), SMALL)
        }
        Command::Ephemeris(it) => (shown(&it.simulated()), of_call(it.patience.timeout), LARGE),
        Command::Plan(Plan::Spin(it)) => {
            (of_template(it.options.fmu.as_ref()), of_call(it.patience.timeout), LARGE)
        }
        Command::Study(it) => (it.name.clone(), of_call(it.patience.timeout), LARGE),
        _ => return None,
    };
    Some(Relayed { name, bounds, limits })
}

fn carry_out(mut command: Command) -> Outcome {
    let read = match &mut command {
        Command::Info(arguments) => Some(&mut arguments.fmu),
        Command::Check(arguments) => Some(&mut arguments.subject),
        Command::Run(arguments) => Some(&mut arguments.fmu),
        Command::Map(arguments) => Some(&mut arguments.spacecraft),
        _ => None,
    };
    if let Some(file) = read {
        *file = home::found(std::mem::take(file));
    }
    match command {
        Command::Info(arguments) => info::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Probe(arguments) => check::run_probe(&arguments),
        Command::Run(arguments) => simulation::run(&arguments),
        Command::Wire(arguments) => wire::run(&arguments),
        Command::RunInChild(arguments) => simulation::run_in_child(&arguments),
        Command::New(arguments) => new::run(&arguments),
        Command::Man(arguments) => manual::run(&arguments),
        Command::Draw(arguments) => draw::run(&arguments),
        Command::Map(arguments) => map::run(&arguments),
        Command::Pack(arguments) => pack::run(&arguments),
        Command::Schema(arguments) => {
            let schema = match arguments.kind {
                SchemaKind::Spacecraft => SPACECRAFT_SCHEMA,
                SchemaKind::Spinner => SPINNER_SCHEMA,
                SchemaKind::Mission => MISSION_SCHEMA,
                SchemaKind::Timeline => TIMELINE_SCHEMA,
                SchemaKind::Ephemeris => EPHEMERIS_SCHEMA,
            };
            terminal::print(schema.trim_end())?;
            Ok(ExitCode::SUCCESS)
        }
        Command::Ephemeris(arguments) => ephemeris::run(&arguments),
        Command::Completions(arguments) => completions::run(&arguments),
        Command::Plan(arguments) => plan::run(&arguments),
        Command::Study(arguments) => study::run(&arguments),
        Command::Assemble(arguments) => simulation::simulated::assemble_into(&arguments),
        Command::InChild(_) => Err("in-child: found another one in it, allowed: a command".into()),
    }
}
