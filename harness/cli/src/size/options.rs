//! Options of `heliotorque size`.

use std::path::PathBuf;

use clap::Args;
use inputs::values::{duration, number, span};
use planner::size::SlewDemand;

use crate::patience::Reader;

/// Shown with the help.
const EXAMPLE: &str = "\
The first line is the answer: wheels, time without unloading, propellant a year; then what the file does not say and is assumed, with
the key that sets it. Momentum is that of MomentumPlant, simulated without dumps for momentum by source, then at several thresholds, by
strategy. A window gathers H(t) - H(its beginning), inertial, turned into the body at t: secular is that of an orbit, cyclic the largest
distance from the line through its ends. Wheels are sized for the most gathered between unloadings, a slew about every axis, and the margin.

Example:
  heliotorque size my.toml                                   writes my-size.svg and my-size.csv, prints the tables
  heliotorque size mission.toml --every 2d --slew \"90 deg in 10 min\" --output sizing
  heliotorque size my.toml --years 15 --end solar.scale=1.2  the last year under another value";

/// `heliotorque size`.
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Size {
    /// A spacecraft, as for `pack`, or a mission, as for `run`, whose start, values and inputs count
    pub file: PathBuf,
    /// The folder for picture and table, in which it makes NAME-size.svg and NAME-size.csv; otherwise this one
    #[arg(long, short, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// What wheels are larger by than the momentum and torque that they have to take
    #[arg(long, value_name = "SHARE", value_parser = margin, allow_hyphen_values = true, default_value = "0.3")]
    pub margin: f64,
    /// Time between unloadings; otherwise the file's [momentum] unload_every, else a day
    #[arg(long, value_name = "TIME", value_parser = span, allow_hyphen_values = true)]
    pub every: Option<f64>,
    /// Slew about every axis, from rest to rest, for which wheels have room and torque; otherwise the file's [momentum] slew, else none
    #[arg(long, value_name = "ANGLE in TIME", value_parser = slew, allow_hyphen_values = true)]
    pub slew: Option<SlewDemand>,
    /// Years of the mission: its first and its last are simulated, those between lie in proportion
    #[arg(long, value_name = "COUNT", value_parser = years, allow_hyphen_values = true)]
    pub years: Option<f64>,
    /// Set a parameter in the last of --years; repeatable, written as --set
    #[arg(long, value_name = "NAME=VALUE", requires = "years")]
    pub end: Vec<String>,
    /// How long each flight is; otherwise a year, with a mission that has inputs, timeline or ephemeris its own time. What is
    /// reported per year is scaled
    #[arg(long, value_name = "TIME", value_parser = span, allow_hyphen_values = true)]
    pub duration: Option<f64>,
    /// Time for which thresholds beyond the first three are simulated; those that it does not come to are left out, and it says so
    #[arg(long, value_name = "TIME", value_parser = duration, allow_hyphen_values = true, default_value = "45s")]
    pub budget: f64,
    /// Set a parameter of MomentumPlant; repeatable, written as for `run`
    #[arg(long, value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// Print one JSON object instead of the tables
    #[arg(long)]
    pub json: bool,
    /// Print no table
    #[arg(long, short)]
    pub quiet: bool,
    /// The library that reads the file
    #[command(flatten)]
    pub reader: Reader,
}

impl Size {
    /// The request without the command line.
    pub(crate) fn request(&self) -> planner::size::Size {
        let it = self.clone();
        planner::size::Size {
            file: it.file,
            output: it.output,
            margin: it.margin,
            every: it.every,
            slew: it.slew,
            years: it.years,
            end: it.end,
            duration: it.duration,
            budget: it.budget,
            template: it.reader.template,
            set: it.set,
            json: it.json,
            quiet: it.quiet,
        }
    }
}

fn slew(text: &str) -> Result<SlewDemand, String> {
    SlewDemand::read(text).ok_or_else(|| format!("allowed is {}", SlewDemand::ALLOWED))
}

fn years(text: &str) -> Result<f64, String> {
    number(text, |years| (1.0..=100.0).contains(&years), "a number of years from 1 to 100: 15")
}

fn margin(text: &str) -> Result<f64, String> {
    number(text, |margin| (0.0..=10.0).contains(&margin), "a share from 0 to 10: 0.3")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_margin_is_a_share() {
        assert_eq!(margin("0.3"), Ok(0.3));
        for bad in ["-0.1", "11", "30%", "nan", ""] {
            assert!(margin(bad).is_err(), "{bad}");
        }
    }
}
