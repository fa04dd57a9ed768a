//! From arguments to a command and its exit status: 0 done, 1 failed or found wanting, 2 wrong usage.

use std::process::ExitCode;

use clap::Parser;

use crate::{
    args::{Arguments, Command, SchemaKind},
    check, completions, draw, ephemeris, home, info, interrupt, manual, map, new,
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
    let mut command = Arguments::parse().command;
    match command {
        // A child is ended by its parent.
        Command::Probe(_) | Command::RunInChild(_) => {}
        // What was recorded until then is written.
        Command::Run(_) => interrupt::listen(true)?,
        _ => interrupt::listen(false)?,
    }
    let read = match &mut command {
        Command::Info(arguments) => Some(&mut arguments.fmu),
        Command::Check(arguments) => Some(&mut arguments.subject),
        Command::Run(arguments) => Some(&mut arguments.fmu),
        Command::Map(arguments) => Some(&mut arguments.craft),
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
    }
}
