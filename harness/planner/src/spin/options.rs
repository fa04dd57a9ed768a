//! The flags of `heliotorque plan spin`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use model_description::quantity;
use physics::{constants::TIME_UNITS, environment::dates};

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

/// A direction in EME2000.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct RightAscensionDeclination {
    /// In deg.
    pub right_ascension_deg: f64,
    /// In deg, -90 to 90.
    pub declination_deg: f64,
}

/// An angle with its unit, in deg.
fn angle(text: &str) -> Result<f64, String> {
    quantity::read_shown(text, "rad", "deg")
        .ok_or_else(|| "an angle carries its unit: 2deg, 0.035rad".to_owned())
}

/// Right ascension and declination with their units and a comma between.
fn direction(text: &str) -> Result<RightAscensionDeclination, String> {
    const ALLOWED: &str = "allowed: right ascension (-360 to 360 deg) and declination (-90 to 90 deg), each with its unit: \
                           83.63deg,22.01deg";
    let read = || {
        let (right_ascension, declination) = text.split_once(',')?;
        Some(RightAscensionDeclination {
            right_ascension_deg: angle(right_ascension).ok().filter(|deg| deg.abs() <= 360.0)?,
            declination_deg: angle(declination).ok().filter(|deg| deg.abs() <= 90.0)?,
        })
    };
    read().ok_or_else(|| ALLOWED.to_owned())
}

/// A rate of turn with its unit, in rpm.
fn rate(text: &str) -> Result<f64, String> {
    quantity::read_shown(text, "rad/s", "rpm")
        .ok_or_else(|| "a rate carries its unit: 5rpm, 30deg/s".to_owned())
}

/// A time, in s.
fn time(text: &str) -> Result<f64, String> {
    quantity::read_in(text, TIME_UNITS)
        .ok_or_else(|| "a time is a number of seconds or carries a unit: 600, 10min, 30d".to_owned())
}

/// A date in seconds past J2000 TDB.
fn date(text: &str) -> Result<f64, String> {
    dates::epoch_s(text).map_err(|error| format!("{error}, allowed: {}", dates::ALLOWED_DATE))
}

/// `heliotorque plan spin`: choose the train of pulses that turns a spinner with the least nutation.
#[derive(Clone, Debug, Args)]
pub struct Options {
    /// Angle by which the spin axis shall turn, above 0 to 175 deg; see --direction, --target
    #[arg(long = "angle", value_name = "ANGLE", value_parser = angle, default_value = "2deg")]
    pub angle_deg: f64,
    /// Way of that turn about the spin axis, right-handed from the Sun: 0 toward it, 180deg away, otherwise across
    #[arg(long = "direction", value_name = "ANGLE", value_parser = angle, default_value = "-90deg")]
    pub direction_deg: f64,
    /// Turn to here instead: right ascension and declination (EME2000), 83.63deg,22.01deg; the Sun by --date or --sun
    #[arg(long, value_name = "RA,DEC", value_parser = direction, conflicts_with_all = ["angle_deg", "direction_deg", "sun_angle_deg"])]
    pub target: Option<RightAscensionDeclination>,
    /// Where the spin axis stands at the start; otherwise by start.q in the spacecraft's file
    #[arg(long, value_name = "RA,DEC", value_parser = direction)]
    pub from: Option<RightAscensionDeclination>,
    /// Date of the turn, which gives Sun and Earth as seen from the Sun-Earth L1 point: '2026-11-22T12:00:00 UTC'
    #[arg(long, value_name = "DATE", value_parser = date, conflicts_with = "sun_angle_deg")]
    pub date: Option<f64>,
    /// Where the Sun stands, in place of --date
    #[arg(long, value_name = "RA,DEC", value_parser = direction, conflicts_with = "sun_angle_deg")]
    pub sun: Option<RightAscensionDeclination>,
    /// Where the Earth stands, in place of --date: off L1 it is up to 15 deg elsewhere
    #[arg(long, value_name = "RA,DEC", value_parser = direction)]
    pub earth: Option<RightAscensionDeclination>,
    /// Trains that move by whole pulses may miss the angle by this much, in per cent
    #[arg(long = "angle-tolerance", value_name = "PERCENT", default_value_t = 2.0)]
    pub angle_tolerance_percent: f64,
    /// Inertia ratio I3/IT, between 1 and 2; otherwise the spacecraft's at its propellant load
    #[arg(long, value_name = "RATIO")]
    pub ratio: Option<f64>,
    /// The ratio may be off by this much either way
    #[arg(long, value_name = "RATIO", default_value_t = 0.0115)]
    pub ratio_uncertainty: f64,
    /// Spin rate: 5rpm; otherwise spin.initialRate in the spacecraft's [start], or its nominal rate
    #[arg(long = "rate", value_name = "RATE", value_parser = rate)]
    pub rate_rpm: Option<f64>,
    /// The spin rate may be off by this much either way: 0.1rpm
    #[arg(long = "rate-uncertainty", value_name = "RATE", value_parser = rate, default_value = "0")]
    pub rate_uncertainty_rpm: f64,
    /// Thruster or group, by its name in the spacecraft's file; otherwise the first that tilts the spin axis alone
    #[arg(long, value_name = "NAME")]
    pub thruster: Option<String>,
    /// What pulses are timed by
    #[arg(long, value_enum, default_value_t = TimingOption::Sun)]
    pub timing: TimingOption,
    /// Angle from the spin axis to the Sun: sets the nutation that science bears; otherwise by --date or --sun
    #[arg(long = "sun-angle", value_name = "ANGLE", value_parser = angle, default_value = "10deg")]
    pub sun_angle_deg: f64,
    /// Limit on nutation at any time
    #[arg(long = "max-nutation", value_name = "ANGLE", value_parser = angle)]
    pub max_nutation_deg: Option<f64>,
    /// Limit on nutation after the last pulse
    #[arg(long = "max-final", value_name = "ANGLE", value_parser = angle)]
    pub max_final_deg: Option<f64>,
    /// Limit on the time from first to last pulse, in s or with a unit: 10min
    #[arg(long = "max-duration", value_name = "TIME", value_parser = time)]
    pub max_duration_s: Option<f64>,
    /// Propellant on board, in kg; otherwise the spacecraft's
    #[arg(long = "propellant", value_name = "KG")]
    pub propellant_kg: Option<f64>,
    /// The spacecraft, a TOML file; otherwise ACE
    #[arg(long, value_name = "TOML")]
    pub spacecraft: Option<PathBuf>,
    /// Run the best plan through this SpinPlant, over the range of ratios; otherwise dist/SpinPlant.fmu where there is
    /// one
    #[arg(long, value_name = "FMU")]
    pub template: Option<PathBuf>,
    /// Plan antenna pointing for so long, up to 3653d, instead of one manoeuvre; limits hold for each of its turns
    #[arg(
        long = "campaign",
        value_name = "TIME",
        value_parser = time,
        conflicts_with_all = [
            "angle_deg", "direction_deg", "target", "from", "date", "sun", "earth", "angle_tolerance_percent",
            "sun_angle_deg", "template", "rows", "output"
        ]
    )]
    pub campaign_s: Option<f64>,
    /// Rows of the trade table, the last of them the uniform plan (equal pulses of one step, once a turn); 0 for no table
    #[arg(long, value_name = "COUNT", default_value_t = 12)]
    pub rows: usize,
    /// Write the plan here: burn.csv and burn.json (pulse by pulse), start.toml (start values), burn.svg (axis and nutation)
    #[arg(long, short, value_name = "FOLDER")]
    pub output: Option<PathBuf>,
}
