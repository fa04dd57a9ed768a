//! Options of a study, and why it did not finish.

use std::path::PathBuf;

use loader::Fmu;
use model_description::Description;
use systems::System;

use crate::settings::Settings;

/// Where a study finds its FMUs and leaves its files.
#[derive(Clone, Debug)]
pub struct Options {
    /// Folder with the `.fmu` files.
    pub dist: PathBuf,
    /// Folder for CSV files and pictures; created if missing.
    pub output: PathBuf,
    /// Runs only the cases whose label contains this text.
    pub only: Option<String>,
    /// Whether to show progress.
    pub progress: bool,
    /// Angle of slews, in rad, for studies that take one.
    pub angle_rad: Option<f64>,
    /// Communication step, in s, for studies that take one.
    pub step_s: Option<f64>,
    /// A spacecraft file in place of the FMU's, for studies that take one.
    pub spacecraft: Option<PathBuf>,
    /// Start values, `name=value`, for studies that take them.
    pub sets: Vec<String>,
}

/// Options that some studies take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extra {
    /// [`Options::angle_rad`].
    Angle,
    /// [`Options::step_s`].
    Step,
    /// [`Options::spacecraft`].
    Spacecraft,
    /// [`Options::sets`].
    Set,
}

impl Options {
    /// Refuses what the study does not take.
    pub(crate) fn check(&self, study: &'static str, takes: &[Extra]) -> Result<(), StudyError> {
        let given = [
            ("--angle", Extra::Angle, self.angle_rad.is_some()),
            ("--step", Extra::Step, self.step_s.is_some()),
            ("--spacecraft", Extra::Spacecraft, self.spacecraft.is_some()),
            ("--set", Extra::Set, !self.sets.is_empty()),
        ];
        match given.iter().find(|(_, extra, is_given)| *is_given && !takes.contains(extra)) {
            Some((option, ..)) => Err(StudyError::Option { study, option }),
            None => Ok(()),
        }
    }

    /// Opens an FMU of the folder.
    pub(crate) fn fmu(&self, file: &str) -> Result<Fmu, StudyError> {
        Fmu::open(self.dist.join(file)).map_err(|error| StudyError::Dist(Box::new(error)))
    }

    /// The start values by a model's description.
    pub(crate) fn assigned(&self, description: &Description) -> Result<Settings, StudyError> {
        let read = self.sets.iter().map(|set| {
            loader::parse_assignment(description, set)
                .map_err(|error| StudyError::Set { set: set.clone(), source: Box::new(error) })
        });
        Ok(read.collect::<Result<Vec<_>, _>>()?.concat())
    }

    /// Opens a system of the folder.
    pub(crate) fn system(&self, file: &str) -> Result<System, StudyError> {
        System::open(self.dist.join(file)).map_err(|error| StudyError::Dist(Box::new(error)))
    }
}

/// Cause of a failed step of a study.
pub(crate) type Cause = Box<dyn std::error::Error + Send + Sync>;

/// Why a study did not finish.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// No study of that name.
    #[error("there is no study `{found}`; the studies are {known}")]
    Unknown {
        /// What was requested.
        found: String,
        /// The names there are.
        known: String,
    },
    /// An option of other studies.
    #[error("{study} does not take {option}: see `heliotorque study list`")]
    Option {
        /// The study.
        study: &'static str,
        /// What it does not take.
        option: &'static str,
    },
    /// A step that a study cannot be simulated in.
    #[error("--step: found {found_s} s, allowed: {allowed}")]
    Step {
        /// What was given, in s.
        found_s: f64,
        /// What may be given.
        allowed: &'static str,
    },
    /// A start value that the FMU does not take.
    #[error("--set {set}: {source}")]
    Set {
        /// What was given.
        set: String,
        /// Why.
        source: Box<loader::Error>,
    },
    /// A start value that the study itself sets.
    #[error("--set: found {name}, which {study} sets itself, allowed: the others")]
    OwnSetting {
        /// The study.
        study: &'static str,
        /// The variable.
        name: String,
    },
    /// `only` left nothing.
    #[error("no case of {study} contains `{only}`; the cases are\n  {known}")]
    NothingLeft {
        /// The study.
        study: &'static str,
        /// The filter.
        only: String,
        /// The labels there are.
        known: String,
    },
    /// An FMU or a system could not be opened; the error names its file.
    #[error("{0}: see --dist")]
    Dist(Cause),
    /// No plan was found.
    #[error("{case}: {why}")]
    Plan {
        /// The case.
        case: String,
        /// Why.
        why: String,
    },
    /// An FMU could not be simulated.
    #[error("{case}: {source}")]
    Simulation {
        /// Which case.
        case: String,
        /// Why.
        source: Cause,
    },
    /// A result file could not be written.
    #[error("cannot write {0}")]
    Write(String),
}
