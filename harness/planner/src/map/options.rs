//! Request of a map.

use std::path::PathBuf;

use inputs::home;

/// Request of `heliotorque map`.
#[derive(Clone, Debug)]
pub struct Map {
    /// Spacecraft file or FMU.
    pub spacecraft: PathBuf,
    /// FMU whose library reads the files.
    pub template: Option<PathBuf>,
    /// Distance from the Sun, in AU.
    pub distance: Option<f64>,
    /// Angle between cells and Sun, in rad.
    pub panel_offset: Option<f64>,
    /// Greatest azimuth and elevation of the Sun in its zone, in rad.
    pub zone: Option<[f64; 2]>,
    /// Azimuth and elevation of the Sun at which a degree is weighed, in rad.
    pub sun: Option<[f64; 2]>,
    /// Communication step, in s.
    pub step: Steps,
    /// Source that is mapped.
    pub source: SourceKind,
    /// Start values, written `name=value`.
    pub set: Vec<String>,
    /// Recording of a mission.
    pub recording: Option<PathBuf>,
    /// Table and picture to write, by their endings.
    pub output: Vec<PathBuf>,
    /// Table of the lines of zero torque to write.
    pub lines: Option<PathBuf>,
    /// Whether no picture is written.
    pub no_picture: bool,
    /// Whether nothing is printed.
    pub quiet: bool,
}

impl Map {
    /// The FMU whose library reads a TOML file.
    pub fn template(&self) -> PathBuf {
        self.template.clone().unwrap_or_else(|| home::fmu(home::DEFAULT_MODEL))
    }
}

/// Source of torque that is mapped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SourceKind {
    /// Sunlight.
    Solar,
    /// Sunlight and recoil.
    Total,
}

impl SourceKind {
    /// The last part of the variables' names.
    pub fn name(self) -> &'static str {
        match self {
            Self::Solar => "solar",
            Self::Total => "total",
        }
    }
}

/// Number of steps in 90 deg.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Steps(pub u32);
