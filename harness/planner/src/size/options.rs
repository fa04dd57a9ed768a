//! Request of a sizing.

use std::path::PathBuf;

use physics::spacecraft::SlewDemand;

/// Request of `heliotorque size`.
#[derive(Clone, Debug)]
pub struct Size {
    /// Spacecraft or mission.
    pub file: PathBuf,
    /// File or folder to write.
    pub output: Option<PathBuf>,
    /// Margin of wheels, as a fraction.
    pub margin: f64,
    /// Time between unloadings, in s.
    pub every: Option<f64>,
    /// Slew that wheels have to carry out.
    pub slew: Option<SlewDemand>,
    /// Number of years of the mission.
    pub years: Option<f64>,
    /// Values of the last year.
    pub end: Vec<String>,
    /// Length of the flights, in s.
    pub duration: Option<f64>,
    /// Longest time of a search, in s.
    pub budget: f64,
    /// FMU whose library reads the files.
    pub template: Option<PathBuf>,
    /// Start values, written `name=value`.
    pub set: Vec<String>,
    /// Whether one JSON object is printed.
    pub json: bool,
    /// Whether nothing is printed.
    pub quiet: bool,
}
