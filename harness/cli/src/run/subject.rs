//! What is run: an FMU, or a system of FMUs. Both have a description, times, and rows to record.

use std::{
    error::Error,
    path::{Path, PathBuf},
    sync::atomic::AtomicBool,
};

use loader::{Ended, Fmu, InstanceOptions, LogMessage, Options, Rows, Times};
use model_description::Description;
use systems::System;

use crate::args::{FirstExchangeKind, MasterKind, Run};

/// What is run.
pub enum Subject {
    /// An FMU.
    Fmu(Fmu),
    /// A system.
    System(Box<System>),
}

/// What a run is given beside its arguments.
pub struct Given<'a> {
    /// Values set before the run.
    pub sets: Vec<(String, loader::Value)>,
    /// Inputs over time.
    pub inputs: Option<&'a loader::InputTable>,
    /// What is recorded.
    pub positions: Vec<usize>,
    /// Told the time in s after every step.
    pub progress: &'a mut dyn FnMut(f64),
    /// Once true, the run ends.
    pub cancel: &'a AtomicBool,
}

impl Subject {
    /// Opens an FMU or a system.
    pub fn open(path: &Path) -> Result<Self, Box<dyn Error>> {
        Ok(if systems::is_system(path) {
            Self::System(Box::new(System::open(path)?))
        } else {
            Self::Fmu(Fmu::open(path)?)
        })
    }

    /// Refuses options that only the other kind takes.
    pub fn check_options(&self, arguments: &Run) -> Result<(), String> {
        let of_systems = [
            (arguments.master.is_some(), "--master"),
            (arguments.first_exchange.is_some(), "--first-exchange"),
        ];
        match self {
            Self::Fmu(_) => match of_systems.iter().find(|(is_given, _)| *is_given) {
                Some((_, option)) => {
                    Err(format!("{option} is for a system (.ssp): an FMU alone exchanges nothing"))
                }
                None => Ok(()),
            },
            Self::System(_) if arguments.slopes => {
                Err("--slopes is for an FMU: open inputs of a system are held over a step".to_owned())
            }
            Self::System(_) => Ok(()),
        }
    }

    /// Refuses what this computer has no library for.
    pub fn check_libraries(&self) -> Result<(), Box<dyn Error>> {
        match self {
            Self::Fmu(fmu) => {
                fmu.binary_path()?;
            }
            Self::System(system) => {
                for part in system.parts() {
                    part.fmu.binary_path().map_err(|error| format!("component {}: {error}", part.name))?;
                }
            }
        }
        Ok(())
    }

    /// What the variables of each FMU begin with, and the folder it is unpacked in.
    pub fn parts(&self) -> Vec<(String, PathBuf)> {
        match self {
            Self::Fmu(fmu) => vec![(String::new(), fmu.folder().to_owned())],
            Self::System(system) => {
                let parts = system.parts().iter();
                parts.map(|part| (format!("{}.", part.name), part.fmu.folder().to_owned())).collect()
            }
        }
    }

    /// Its variables.
    pub fn description(&self) -> &Description {
        match self {
            Self::Fmu(fmu) => fmu.description(),
            Self::System(system) => system.description(),
        }
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.description().model_name
    }

    /// Its name, with the component's of this number.
    pub fn named(&self, number: usize) -> String {
        let name = self.name();
        match self {
            // What the child writes is not trusted.
            Self::System(system) => system
                .parts()
                .get(number)
                .map_or_else(|| name.to_owned(), |part| format!("{name}, component {}", part.name)),
            Self::Fmu(_) => name.to_owned(),
        }
    }

    /// The folder that it is unpacked in.
    pub fn folder(&self) -> PathBuf {
        match self {
            Self::Fmu(fmu) => fmu.folder().to_owned(),
            Self::System(system) => system.folder().to_owned(),
        }
    }

    /// The times of a run.
    pub fn times(&self, arguments: &Run) -> Result<Times, loader::Error> {
        let Run { start, stop, step, .. } = *arguments;
        match self {
            Self::Fmu(fmu) => Times::of(fmu, start, stop, step),
            Self::System(system) => system.times(start, stop, step),
        }
    }

    /// Runs it in this process.
    pub fn simulate_into(
        &self,
        arguments: &Run,
        given: Given<'_>,
        rows: &mut dyn Rows,
    ) -> Result<(Ended, Vec<LogMessage>), loader::Error> {
        let Given { sets, inputs, positions, progress, cancel } = given;
        let options = Options {
            start_s: arguments.start,
            stop_s: arguments.stop,
            step_s: arguments.step,
            record_every_s: arguments.every,
            sets,
            inputs,
            input_derivatives: arguments.slopes,
            record: Some(positions),
            apart: None,
            instance: InstanceOptions { logging: arguments.log, ..InstanceOptions::default() },
            progress: Some(progress),
            cancel: Some(cancel),
        };
        let master = arguments.master.map(systems::Master::from).unwrap_or_default();
        let first = arguments.first_exchange.map(systems::FirstExchange::from).unwrap_or_default();
        match self {
            Self::Fmu(fmu) => loader::simulate_into(fmu, options, rows),
            Self::System(system) => systems::simulate_into(system, (master, first), options, rows),
        }
    }
}

impl From<MasterKind> for systems::Master {
    fn from(kind: MasterKind) -> Self {
        match kind {
            MasterKind::Jacobi => Self::Jacobi,
            MasterKind::GaussSeidel => Self::GaussSeidel,
        }
    }
}

impl From<FirstExchangeKind> for systems::FirstExchange {
    fn from(kind: FirstExchangeKind) -> Self {
        match kind {
            FirstExchangeKind::Initial => Self::Initial,
            FirstExchangeKind::Zeros => Self::Zeros,
        }
    }
}
