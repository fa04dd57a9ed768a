//! Options of `heliotorque refit`.

use std::path::PathBuf;

use clap::Args;
use inputs::values::{number, positive};
use planner::refit::Deviations;

use crate::patience::Reader;

/// Shown with the help.
const EXAMPLE: &str = "\
The mission's own spacecraft.centerOfMass and solar.scale are the prior. Each arc between dumps has a start momentum of its own, which
is fitted with them. A direction of which the history leaves more than half of the prior's deviation is not determined: it stays at the
prior, and the answer names it.

Telemetry has the columns time (s of simulation time, growing from row to row), momentum.inertial[1], [2], [3] (N.m.s, EME2000), and
dump.count where dumps fall; others are not read: a recording of `run` with momentum.inertial and dump.count is such a table.

Example:
  heliotorque refit mission.toml --telemetry momentum.csv --output refit.toml      writes refit.toml, refit.json, refit.svg
  heliotorque refit mission.toml --telemetry momentum.csv --noise 0.02 --prior-center 0.1 --prior-scale 0.1 --output refit.toml";

/// `heliotorque refit`.
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Refit {
    /// The mission that the telemetry is of, as for `run`: MomentumPlant in guided or commanded attitude
    pub mission: PathBuf,
    /// The history of momentum
    #[arg(long, value_name = "CSV")]
    pub telemetry: PathBuf,
    /// Standard deviation of each momentum component of each row, in N.m.s or with a unit
    #[arg(long, value_name = "N.m.s", value_parser = |text: &str| positive(text, "N.m.s"), allow_hyphen_values = true, default_value = "0.01")]
    pub noise: f64,
    /// Standard deviation of each component of the mission's centre of mass, in m or with a unit: 5cm
    #[arg(long, value_name = "M", value_parser = |text: &str| positive(text, "m"), allow_hyphen_values = true, default_value = "0.05")]
    pub prior_center: f64,
    /// Standard deviation of the mission's solar.scale
    #[arg(long, value_name = "S", value_parser = deviation, allow_hyphen_values = true, default_value = "0.05")]
    pub prior_scale: f64,
    /// The TOML file to write, a table [set] that missions take; JSON and picture stand beside it under the same name
    #[arg(long, short, value_name = "FILE.toml")]
    pub output: PathBuf,
    /// Print no table
    #[arg(long, short)]
    pub quiet: bool,
    /// The library that reads the file
    #[command(flatten)]
    pub reader: Reader,
}

impl Refit {
    /// The request without the command line.
    pub(crate) fn request(&self) -> planner::plans::refit::Refit {
        let it = self.clone();
        planner::plans::refit::Refit {
            mission: it.mission,
            telemetry: it.telemetry,
            deviations: Deviations {
                noise_n_m_s: it.noise,
                center_of_mass_m: it.prior_center,
                solar_scale: it.prior_scale,
            },
            output: it.output,
            template: it.reader.template,
            quiet: it.quiet,
        }
    }
}

/// Reads a standard deviation, which is above 0.
fn deviation(text: &str) -> Result<f64, String> {
    number(text, |value| value > 0.0, "a number above 0")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_deviation_is_above_zero() {
        assert_eq!(deviation(" 0.01"), Ok(0.01));
        for bad in ["0", "-0.01", "nan", "inf", "1 cm", ""] {
            assert!(deviation(bad).is_err(), "{bad}");
        }
    }
}
