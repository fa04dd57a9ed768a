//! What is run: an FMU, or a system of FMUs. Both have a description, times, and rows to record.

use std::{
    error::Error,
    path::{Path, PathBuf},
};

use loader::{Fmu, Times};
use model_description::Description;
use systems::System;

use super::options::Run;

/// What is run.
pub enum Subject {
    /// An FMU.
    Fmu(Fmu),
    /// A system.
    System(Box<System>),
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
        let option = match self {
            Self::Fmu(_) if arguments.master.is_some() => "--master",
            Self::Fmu(_) if arguments.first_exchange.is_some() => "--first-exchange",
            Self::System(_) if arguments.slopes => {
                return Err("--slopes is for an FMU: open inputs of a system are held over a step".to_owned());
            }
            _ => return Ok(()),
        };
        Err(format!("{option} is for a system (.ssp): an FMU alone exchanges nothing"))
    }

    /// Refuses what this computer has no library for.
    pub fn check_libraries(&self) -> Result<(), Box<dyn Error>> {
        match self {
            Self::Fmu(fmu) => drop(fmu.binary_path()?),
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
            Self::System(system) if number < system.parts().len() => {
                format!("{name}, component {}", system.parts()[number].name)
            }
            _ => name.to_owned(),
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
}
