//! The papers' tables and figures, simulated with real FMUs.
//!
//! A study loads FMUs from a folder, runs them through their C interface, and leaves text, CSV files and
//! pictures. It knows nothing of the models but what their descriptions say.

mod attitude;
mod case;
pub mod chart;
mod control;
mod momentum;
mod options;
mod pointing;
mod report;
mod settings;
mod spin;
mod thermal;

pub use options::{Extra, Options, StudyError};
pub use report::Report;

/// One study.
pub struct Study {
    /// Subject and what it reproduces.
    pub name: &'static str,
    /// Which paper.
    pub paper: &'static str,
    /// One line.
    pub title: &'static str,
    /// Options that not every study takes.
    pub takes: &'static [Extra],
    /// Runs it.
    pub run: fn(&Options) -> Result<Report, StudyError>,
}

/// Every study.
pub const STUDIES: &[Study] = &[
    Study {
        name: "control/slew",
        paper: "001",
        title: "large slews of the controlled plant, with full wheels and with a wheel that fails",
        takes: &[Extra::Angle, Extra::Step],
        run: control::slew,
    },
    Study {
        name: "control/safe-mode",
        paper: "001",
        title: "safe modes reached in a loop of Guidance and the controlled plant",
        takes: &[Extra::Step],
        run: control::safe_mode,
    },
    Study {
        name: "control/transition",
        paper: "001",
        title: "from downlink to the camera at nadir under control: the estimated curves of Figures 7 and 8",
        takes: &[Extra::Step],
        run: control::transition,
    },
    Study {
        name: "control/dump",
        paper: "000",
        title: "momentum dumps by pulses of thrusters beside the same dumps at once",
        takes: &[],
        run: control::dump,
    },
    Study {
        name: "control/jitter",
        paper: "000",
        title: "attitude jitter of a flexible structure by a wheel out of balance, with its spectrum",
        takes: &[],
        run: control::jitter,
    },
    Study {
        name: "momentum/tables",
        paper: "000",
        title: "Tables 2 to 5 from one set of simulations",
        takes: &[],
        run: momentum::tables,
    },
    Study {
        name: "momentum/table2",
        paper: "000",
        title: "number of thruster dumps in 90 days by strategy, cylinder, with a picture like Figure 4",
        takes: &[],
        run: momentum::table2,
    },
    Study {
        name: "momentum/table3",
        paper: "000",
        title: "time between thruster dumps by strategy, cylinder",
        takes: &[],
        run: momentum::table3,
    },
    Study {
        name: "momentum/table4",
        paper: "000",
        title: "number of thruster dumps by strategy, plates and panels, centre of mass off in X, Y and Z",
        takes: &[],
        run: momentum::table4,
    },
    Study {
        name: "momentum/table5",
        paper: "000",
        title: "time between those dumps",
        takes: &[],
        run: momentum::table5,
    },
    Study {
        name: "momentum/figure4",
        paper: "000",
        title: "X momentum over 90 days with thruster dumps only",
        takes: &[],
        run: momentum::figure4,
    },
    Study {
        name: "momentum/figure5",
        paper: "000",
        title: "X momentum over 90 days with reactive and predictive targets",
        takes: &[],
        run: momentum::figure5,
    },
    Study {
        name: "momentum/assumptions",
        paper: "000",
        title: "how Table 2 moves with start date, orbit frame and panel tilts, which the paper leaves open",
        takes: &[],
        run: momentum::assumptions,
    },
    Study {
        name: "momentum/dump-targets",
        paper: "000",
        title: "dumps to zero and to one side of X, and the plates alone, by strategy",
        takes: &[],
        run: momentum::dump_targets,
    },
    Study {
        name: "momentum/wheels",
        paper: "000",
        title: "storage and mass of the wheels against dumps, by strategy",
        takes: &[],
        run: momentum::wheels,
    },
    Study {
        name: "momentum/sensitivity",
        paper: "000",
        title: "dumps and momentum a day with misaligned, unequal and slowly turning parts, the paper's open questions",
        takes: &[],
        run: momentum::sensitivity,
    },
    Study {
        name: "momentum/off-sun",
        paper: "000, 003",
        title: "sunlight on the whole MESSENGER over the sphere, and its momentum against shade and panels alone",
        takes: &[],
        run: momentum::off_sun,
    },
    Study {
        name: "pointing/burn",
        paper: "001",
        title: "a burn with each correction of its direction over seeds: Figures 10 and 11",
        takes: &[Extra::Step],
        run: control::burn,
    },
    Study {
        name: "pointing/limb",
        paper: "001",
        title: "limb points at azimuths and on the terminator, and a scan of the limb's height",
        takes: &[],
        run: pointing::limb,
    },
    Study {
        name: "pointing/mosaic",
        paper: "001",
        title: "footprints of inertial, body and planet-fixed scans on the planet's disc",
        takes: &[],
        run: pointing::mosaic,
    },
    Study {
        name: "pointing/transition",
        paper: "001",
        title: "from downlink to the camera at nadir: the commanded curves of Figures 7 and 8",
        takes: &[],
        run: pointing::transition,
    },
    Study {
        name: "spin/figure2",
        paper: "002",
        title: "nutation left by a 2 deg manoeuvre in n pulses, twice a turn",
        takes: &[],
        run: spin::figure2,
    },
    Study {
        name: "spin/figure3",
        paper: "002",
        title: "nutation left by a 2 deg manoeuvre in n pulses, once a turn",
        takes: &[],
        run: spin::figure3,
    },
    Study {
        name: "spin/figure4",
        paper: "002",
        title: "nutation during the manoeuvre, axisymmetric and triaxial",
        takes: &[],
        run: spin::figure4,
    },
    Study {
        name: "spin/figure6",
        paper: "002",
        title: "nutation in the star tracker's samples",
        takes: &[],
        run: spin::figure6,
    },
    Study {
        name: "spin/figure7",
        paper: "002",
        title: "how long nutation takes to show, over spin rate and inertia ratio",
        takes: &[],
        run: spin::figure7,
    },
    Study {
        name: "spin/numbers",
        paper: "002",
        title: "every number of the paper beside ours",
        takes: &[],
        run: spin::numbers,
    },
    Study {
        name: "thermal/table7",
        paper: "004",
        title: "albedo, infrared and recoil as shares of solar pressure, planet standing still",
        takes: &[],
        run: thermal::table7,
    },
    Study {
        name: "thermal/table8",
        paper: "004",
        title: "the same with the planet moving",
        takes: &[],
        run: thermal::table8,
    },
    Study {
        name: "thermal/figure12",
        paper: "004",
        title: "accelerations around one orbit, four positions of Mercury",
        takes: &[],
        run: thermal::figure12,
    },
    Study {
        name: "thermal/figure13",
        paper: "004",
        title: "accelerations over a Mercury year, least, mean and greatest of every orbit",
        takes: &[],
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
    options.check(study.name, study.takes)?;
    (study.run)(options)
}
