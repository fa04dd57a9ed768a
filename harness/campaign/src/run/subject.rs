//! Subject of a run: an FMU, or a system of FMUs. Both have a description, times, and rows to record.

use std::{
    error::Error,
    path::{Path, PathBuf},
};

use fmi::{Fmu, Times, Value};
use inputs::{epoch::Dates, values::Instant};
use model_description::Description;
use systems::System;

use super::options::Run;

/// FMU or system that is run.
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

    /// Returns the prefix of each FMU's variables, and the folder it is unpacked in.
    pub fn parts(&self) -> Vec<(String, PathBuf)> {
        self.fmus().into_iter().map(|(prefix, fmu)| (prefix, fmu.folder().to_owned())).collect()
    }

    /// Returns the prefix of each FMU's variables.
    pub fn fmus(&self) -> Vec<(String, &Fmu)> {
        match self {
            Self::Fmu(fmu) => vec![(String::new(), fmu)],
            Self::System(system) => {
                system.parts().iter().map(|part| (format!("{}.", part.name), &part.fmu)).collect()
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

    /// Returns the inputs that are connected and not read, a line for each option.
    pub fn unread(&self, sets: &[(String, Value)]) -> Vec<String> {
        match self {
            Self::Fmu(_) => Vec::new(),
            Self::System(system) => system.unread(sets).iter().map(ToString::to_string).collect(),
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
    pub fn times(&self, arguments: &Run, dates: &Dates<'_>) -> Result<Times, Box<dyn Error>> {
        let Run { start, stop, step, .. } = *arguments;
        let stop_s = match stop {
            Some(Instant::Epoch(epoch_s)) => {
                Some(dates.simulation_s(epoch_s).map_err(|why| format!("--stop: found a date, {why}"))?)
            }
            Some(Instant::Time(time_s)) => Some(time_s),
            None => None,
        };
        Ok(match self {
            Self::Fmu(fmu) => Times::from_fmu(fmu, start, stop_s, step)?,
            Self::System(system) => system.times(start, stop_s, step)?,
        })
    }
}
