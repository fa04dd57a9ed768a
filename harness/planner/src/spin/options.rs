//! The flags of `heliotorque plan spin`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

/// The spacecraft that is planned for unless another is named: the shipped ACE.
pub(super) const ACE: &str = include_str!("../../../../fmu-src/resources/ace.toml");

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
