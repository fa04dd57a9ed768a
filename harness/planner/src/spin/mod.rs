//! Attitude manoeuvres of a spinner: which train of pulses turns it by an angle with the least nutation, and how often
//! to turn during months of antenna pointing (paper 002 and beyond).

mod campaign;
mod task;
mod text;
mod trade;
mod verification;

#[cfg(test)]
mod tests;
#[cfg(test)]
mod verification_tests;

use std::path::PathBuf;

use clap::{Args, ValueEnum};

pub use campaign::{Cadence, campaign, longest_interval_s, windows};
pub use task::{Firing, MOST_ANGLE_DEG, Task, TaskLimits};
pub use text::plan;
pub use trade::{Row, best, evaluate, frontier, paper_plan, timing_label, trade};
pub use verification::{Verification, verify};

/// The spacecraft that is planned for unless another is named: the shipped ACE.
const ACE: &str = include_str!("../../../../fmu-src/resources/ace.toml");

/// What pulses are timed by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum TimingOption {
    /// Fixed intervals of the assumed spin period
    Clock,
    /// A delay after each Sun crossing
    Sun,
    /// The exact phase, each turn
    Phase,
}

/// `heliotorque plan spin`: choose the train of pulses that turns a spinner with the least nutation.
#[derive(Clone, Debug, Args)]
pub struct Options {
    /// Angle by which the spin axis shall turn, above 0 to 175 deg
    #[arg(long = "angle", value_name = "DEG", default_value_t = 2.0)]
    pub angle_deg: f64,
    /// Trains that move by whole pulses may miss the angle by this much, in per cent
    #[arg(long = "angle-tolerance", value_name = "PERCENT", default_value_t = 2.0)]
    pub angle_tolerance_percent: f64,
    /// Inertia ratio I3/IT, between 1 and 2; otherwise the spacecraft's at its propellant load
    #[arg(long, value_name = "RATIO")]
    pub ratio: Option<f64>,
    /// The ratio may be off by this much either way
    #[arg(long, value_name = "RATIO", default_value_t = 0.0115)]
    pub ratio_uncertainty: f64,
    /// Spin rate, in rpm
    #[arg(long, value_name = "RPM", default_value_t = 5.0)]
    pub rate_rpm: f64,
    /// The spin rate may be off by this much either way, in rpm
    #[arg(long, value_name = "RPM", default_value_t = 0.0)]
    pub rate_uncertainty_rpm: f64,
    /// Thruster or group, by its name in the spacecraft's file
    #[arg(long, value_name = "NAME", default_value = "IIIR")]
    pub thruster: String,
    /// What pulses are timed by
    #[arg(long, value_enum, default_value_t = TimingOption::Sun)]
    pub timing: TimingOption,
    /// Angle from the spin axis to the Sun, in deg: sets the nutation that science bears
    #[arg(long = "sun-angle", value_name = "DEG", default_value_t = 10.0)]
    pub sun_angle_deg: f64,
    /// Limit on nutation at any time, in deg
    #[arg(long = "max-nutation", value_name = "DEG")]
    pub max_nutation_deg: Option<f64>,
    /// Limit on nutation after the last pulse, in deg
    #[arg(long = "max-final", value_name = "DEG")]
    pub max_final_deg: Option<f64>,
    /// Limit on the time from first to last pulse, in min
    #[arg(long = "max-duration", value_name = "MIN")]
    pub max_duration_min: Option<f64>,
    /// Propellant on board, in kg; otherwise the spacecraft's
    #[arg(long = "propellant", value_name = "KG")]
    pub propellant_kg: Option<f64>,
    /// The spacecraft, a TOML file; otherwise ACE
    #[arg(long, value_name = "TOML")]
    pub spacecraft: Option<PathBuf>,
    /// Run the best plan through this SpinPlant, over the range of ratios; otherwise dist/SpinPlant.fmu where there is
    /// one
    #[arg(long, value_name = "FMU")]
    pub fmu: Option<PathBuf>,
    /// Plan antenna pointing for so many days, up to 3653, instead of one manoeuvre; limits hold for each of its turns
    #[arg(
        long,
        value_name = "DAYS",
        conflicts_with_all = ["angle_deg", "angle_tolerance_percent", "sun_angle_deg", "fmu", "rows"]
    )]
    pub campaign: Option<f64>,
    /// Most rows of the trade table
    #[arg(long, value_name = "COUNT", default_value_t = 20)]
    pub rows: usize,
}

/// Why there is no plan.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// A flag out of its range.
    #[error("{flag} is {found}; allowed is {allowed}")]
    Flag {
        /// The flag.
        flag: &'static str,
        /// What was found.
        found: f64,
        /// What is allowed.
        allowed: String,
    },
    /// A body that does not come to rest about its spin axis, or none.
    #[error(
        "the inertia ratio I3/IT is {least:.4} to {greatest:.4} (--ratio, otherwise the spacecraft's, +- \
         --ratio-uncertainty); allowed is above 1 and below 2: up to 1 nutation does not turn in the body or the damper lets \
         it grow, so that no train ends quietly, and no body has 2 or more"
    )]
    Ratio {
        /// Least of the range.
        least: f64,
        /// Greatest of the range.
        greatest: f64,
    },
    /// No such thruster.
    #[error("--thruster is \"{found}\"; this spacecraft has {known}")]
    Thruster {
        /// What was asked for.
        found: String,
        /// What there is.
        known: String,
    },
    /// A set of thrusters that cannot turn the spin axis.
    #[error("--thruster is \"{found}\", which has no torque across the spin axis")]
    NoTorque {
        /// What was asked for.
        found: String,
    },
    /// The spacecraft's file.
    #[error("{0}")]
    Setup(String),
    /// No train keeps the limits.
    #[error(
        "no plan keeps the limits: over all plans the least peak nutation is {peak_deg:.5} deg, the least final nutation \
         {final_deg:.6} deg, the shortest time {duration_min:.2} min, the least propellant {propellant_kg:.6} kg; widen \
         --max-nutation, --max-final or --max-duration, or see --propellant"
    )]
    NoPlan {
        /// Least peak of all plans.
        peak_deg: f64,
        /// Least final nutation of all plans.
        final_deg: f64,
        /// Shortest of all plans.
        duration_min: f64,
        /// Least of all plans.
        propellant_kg: f64,
    },
    /// The thruster's shortest pulse moves too far.
    #[error(
        "--angle is {angle_deg} deg; no train comes within {tolerance_percent} % of it (--angle-tolerance): the shortest \
         pulse of {thruster}, {pulse_ms} ms, moves {pulse_deg:.6} deg"
    )]
    NoTrain {
        /// What was asked for.
        angle_deg: f64,
        /// How near it had to come.
        tolerance_percent: f64,
        /// Name.
        thruster: String,
        /// Shortest pulse.
        pulse_ms: f64,
        /// What it moves.
        pulse_deg: f64,
    },
    /// The thruster cannot do it at this spin rate.
    #[error("--thruster {thruster} has no train: {why}")]
    Coarse {
        /// Name.
        thruster: String,
        /// Why.
        why: String,
    },
    /// Simulated through the FMU, no plan kept what it promised.
    #[error("no plan keeps its limits when it is simulated through the FMU: {0}")]
    Broken(String),
    /// The FMU did not simulate it.
    #[error("the plan could not be simulated through the FMU: {0}")]
    Verify(String),
}
