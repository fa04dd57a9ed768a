//! The papers' tables and figures, simulated with real FMUs.
//!
//! A study loads FMUs from a folder, runs them through their C interface, and leaves text, CSV files and
//! pictures. It knows nothing of the models but what their descriptions say.

mod attitude;
mod case;
mod cells;
mod control;
mod earth;
mod flight;
mod flyby;
mod momentum;
mod options;
mod pointing;
mod report;
mod settings;
mod spin;
mod thermal;
mod verdict;

pub use options::{Extra, Options, StudyError};
pub use report::Report;
use report::{Outcome, Run};

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
    run: fn(&mut Run<'_>) -> Outcome,
}

/// A row: name, papers, function, further options, title.
macro_rules! studies {
    ($($name:literal of $paper:literal by $run:path $(, takes $($extra:ident)+)?: $title:literal;)+) => {
        /// Every study.
        pub const STUDIES: &[Study] = &[$(Study {
            name: $name,
            paper: $paper,
            title: $title,
            takes: &[$($(Extra::$extra),+)?],
            run: $run,
        }),+];
    };
}

studies! {
    "control/slew" of "001" by control::slew, takes Angle Step:
        "large slews of the controlled plant, with full wheels and with a wheel that fails";
    "control/safe-mode" of "001" by control::safe_mode, takes Step:
        "safe modes reached in a loop of Guidance and the controlled plant";
    "control/transition" of "001" by control::transition, takes Step:
        "from downlink to the camera at nadir under control: the estimated curves of Figures 7 and 8";
    "control/dump" of "000" by control::dump:
        "momentum dumps by pulses of thrusters beside the same dumps at once";
    "control/jitter" of "000" by control::jitter:
        "attitude jitter of a flexible structure by a wheel out of balance, with its spectrum";
    "earth/torques" of "-" by earth::torques:
        "every torque on a CubeSat about the Earth against height, 180 to 36,000 km";
    "earth/day" of "-" by earth::day:
        "a day of a CubeSat at 500 km: torque and momentum by effect, air";
    "flyby/table1" of "003" by flyby::table1:
        "velocity change by each flyby of Mercury";
    "flyby/table2" of "003" by flyby::table2:
        "what manoeuvres before and behind a flyby of Mercury cost with errors of execution, and what they leave";
    "flyby/table3" of "003" by flyby::table3:
        "misses, altitudes and costs of flybys corrected by sunlight, without a manoeuvre";
    "flyby/figure3" of "003" by flyby::figure3:
        "B-plane of the first flyby of Mercury, arrays turned three days early";
    "flyby/figure4" of "003" by flyby::figure4:
        "corridor of the arrays by distance, and the offsets of baseline and plan in it";
    "flyby/figure5" of "003" by flyby::figure5:
        "velocity change that leads to the second flyby's aim, by its time";
    "flyby/figure6" of "003" by flyby::figure6:
        "B-plane of the second flyby behind the departure, missed by 170 km";
    "flyby/figure7" of "003" by flyby::figure7:
        "the same 111 days before it, planned anew by sunlight";
    "flyby/figure8" of "003" by flyby::figure8:
        "the same 18 days before it, where orbit determination found a drift";
    "flyby/figure9" of "003" by flyby::figure9:
        "the same seven days before it";
    "momentum/tables" of "000" by momentum::tables:
        "Tables 2 to 5 from one set of simulations";
    "momentum/table2" of "000" by momentum::table2:
        "number of thruster dumps in 90 days by strategy and at the optimum, cylinder, with a picture like Figure 4";
    "momentum/table3" of "000" by momentum::table3:
        "time between thruster dumps by strategy, cylinder";
    "momentum/table4" of "000" by momentum::table4:
        "number of thruster dumps by strategy and at the optimum, plates and panels, centre of mass off in X, Y and Z";
    "momentum/table5" of "000" by momentum::table5:
        "time between those dumps";
    "momentum/figure4" of "000" by momentum::figure4:
        "X momentum over 90 days with thruster dumps only";
    "momentum/figure5" of "000" by momentum::figure5:
        "X momentum over 90 days with reactive and predictive targets";
    "momentum/assumptions" of "000" by momentum::assumptions:
        "how Table 2 moves with start date, orbit frame and panel tilts, which the paper leaves open";
    "momentum/dump-targets" of "000" by momentum::dump_targets:
        "dumps to zero and to one side of X, and the plates alone, by strategy";
    "momentum/wheels" of "000" by momentum::wheels:
        "storage and mass of the wheels against dumps, by strategy";
    "momentum/sensitivity" of "000" by momentum::sensitivity:
        "dumps and momentum a day with misaligned, unequal and slowly turning parts, the paper's open questions";
    "momentum/off-sun" of "000, 003" by momentum::off_sun:
        "sunlight on the whole MESSENGER over the sphere, and its momentum against shade and panels alone";
    "momentum/authority" of "000, 003" by momentum::authority, takes Spacecraft Set:
        "what a degree of windmilling, offset, azimuth and elevation, a centimetre of centre of mass and an alternation are worth";
    "pointing/burn" of "001" by control::burn, takes Step:
        "a burn with each correction of its direction over seeds: Figures 10 and 11";
    "pointing/limb" of "001" by pointing::limb:
        "limb points at azimuths and on the terminator, and a scan of the limb's height";
    "pointing/mosaic" of "001" by pointing::mosaic:
        "footprints of inertial, body and planet-fixed scans on the planet's disc";
    "pointing/transition" of "001" by pointing::transition:
        "from downlink to the camera at nadir: the commanded curves of Figures 7 and 8";
    "spin/figure2" of "002" by spin::figure2:
        "nutation left by a 2 deg manoeuvre in n pulses, twice a turn";
    "spin/figure3" of "002" by spin::figure3:
        "nutation left by a 2 deg manoeuvre in n pulses, once a turn";
    "spin/figure4" of "002" by spin::figure4:
        "nutation during the manoeuvre, axisymmetric and triaxial";
    "spin/figure6" of "002" by spin::figure6:
        "nutation in the star tracker's samples";
    "spin/figure7" of "002" by spin::figure7:
        "how long nutation, takes to show, over spin rate and inertia ratio";
    "spin/numbers" of "002" by spin::numbers:
        "every number of the paper beside ours";
    "thermal/table7" of "004" by thermal::table7:
        "albedo, infrared and recoil as shares of solar pressure, planet standing still";
    "thermal/table8" of "004" by thermal::table8:
        "the same with the planet moving";
    "thermal/figure12" of "004" by thermal::figure12:
        "accelerations around one orbit, four positions of Mercury";
    "thermal/figure13" of "004" by thermal::figure13:
        "accelerations over a Mercury year, least, mean and greatest of every orbit";
}

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
    let mut run = Run { study: study.name, options, report: Report::default() };
    (study.run)(&mut run)?;
    Ok(run.report)
}
