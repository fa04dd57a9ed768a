//! The papers' tables and figures, simulated with real FMUs.
//!
//! A study loads FMUs from a folder, runs them through their C interface, and leaves text, CSV files and
//! pictures. It knows nothing of the models but what their descriptions say.

mod case;
pub mod chart;
mod momentum;
mod report;
mod spin;
mod thermal;

use std::path::PathBuf;

use loader::Fmu;

pub use report::Report;

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
}

impl Options {
    /// Opens an FMU of the folder.
    fn fmu(&self, file: &str) -> Result<Fmu, StudyError> {
        Fmu::open(self.dist.join(file)).map_err(|error| StudyError::Fmu(Box::new(error)))
    }
}

/// Why a study did not finish.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// No study of that name.
    #[error("there is no study `{found}`; the studies are {known}")]
    Unknown {
        /// What was asked for.
        found: String,
        /// The names there are.
        known: String,
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
    /// An FMU could not be loaded; the error names its file.
    #[error("{0}: see --dist")]
    Fmu(Box<loader::Error>),
    /// An FMU could not be simulated.
    #[error("{case}: {source}")]
    Simulation {
        /// Which case.
        case: String,
        /// Why.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// A result file could not be written.
    #[error("cannot write {0}")]
    Write(String),
}

/// One study.
pub struct Study {
    /// Subject and what it reproduces.
    pub name: &'static str,
    /// Which paper.
    pub paper: &'static str,
    /// One line.
    pub title: &'static str,
    /// Runs it.
    pub run: fn(&Options) -> Result<Report, StudyError>,
}

/// Every study.
pub const STUDIES: &[Study] = &[
    Study {
        name: "momentum/table2",
        paper: "000",
        title: "number of thruster dumps in 90 days, with a picture like Figure 4",
        run: momentum::table2,
    },
    Study {
        name: "momentum/table3",
        paper: "000",
        title: "time between thruster dumps",
        run: momentum::table3,
    },
    Study {
        name: "momentum/figure4",
        paper: "000",
        title: "X momentum over 90 days with thruster dumps only",
        run: momentum::figure4,
    },
    Study {
        name: "momentum/assumptions",
        paper: "000",
        title: "how Table 2 moves with start date, orbit frame and panel tilts, which the paper leaves open",
        run: momentum::assumptions,
    },
    Study {
        name: "spin/figure2",
        paper: "002",
        title: "nutation left by a 2 deg manoeuvre in n pulses, twice a turn",
        run: spin::figure2,
    },
    Study {
        name: "spin/figure3",
        paper: "002",
        title: "nutation left by a 2 deg manoeuvre in n pulses, once a turn",
        run: spin::figure3,
    },
    Study {
        name: "spin/figure4",
        paper: "002",
        title: "nutation during the manoeuvre, axisymmetric and triaxial",
        run: spin::figure4,
    },
    Study {
        name: "spin/figure6",
        paper: "002",
        title: "nutation in the star tracker's samples",
        run: spin::figure6,
    },
    Study {
        name: "spin/figure7",
        paper: "002",
        title: "how long nutation takes to show, over spin rate and inertia ratio",
        run: spin::figure7,
    },
    Study {
        name: "spin/numbers",
        paper: "002",
        title: "every number of the paper beside ours",
        run: spin::numbers,
    },
    Study {
        name: "thermal/table7",
        paper: "004",
        title: "albedo, infrared and recoil as shares of solar pressure, planet standing still",
        run: thermal::table7,
    },
    Study {
        name: "thermal/table8",
        paper: "004",
        title: "the same with the planet moving",
        run: thermal::table8,
    },
    Study {
        name: "thermal/figure12",
        paper: "004",
        title: "accelerations around one orbit, four positions of Mercury",
        run: thermal::figure12,
    },
    Study {
        name: "thermal/figure13",
        paper: "004",
        title: "accelerations over a Mercury year, least, mean and greatest of every orbit",
        run: thermal::figure13,
    },
];

/// Runs the study called `name`.
///
/// # Errors
/// An unknown name, an FMU that cannot be simulated, a file that cannot be written.
pub fn run(name: &str, options: &Options) -> Result<Report, StudyError> {
    let study = STUDIES.iter().find(|study| study.name == name).ok_or_else(|| StudyError::Unknown {
        found: name.to_owned(),
        known: STUDIES.iter().map(|study| study.name).collect::<Vec<_>>().join(", "),
    })?;
    (study.run)(options)
}
