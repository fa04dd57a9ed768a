//! Options of `heliotorque compare`.

use std::path::PathBuf;

use clap::Args;
use inputs::values;

/// Shown with the help.
const EXAMPLE: &str = "\
Rows belong together by their first column: time of a recording, run of a campaign, or any number that does not fall; of several rows at
one time, as at an event, the first to the first. A difference is given in the variable's unit, and as a fraction of the largest
magnitude that the first table has of the variable's vector. What is no number is the same or not. Times and columns that only one table
has are named and change nothing.

The exit status is 0 where every variable differs by the tolerance at most, and 1 beyond it.

Example:
  heliotorque compare today.csv yesterday.csv
  heliotorque compare runs.csv dask.csv --tolerance 0
  heliotorque compare 60s.csv 600s.csv --tolerance 1e-6 --output difference.svg";

/// `heliotorque compare`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Compare {
    /// The table that the other is held against, a CSV
    pub first: PathBuf,
    /// The other, a CSV
    pub second: PathBuf,
    /// Greatest difference allowed, as a fraction of the largest magnitude that the first table has of a vector or scalar
    #[arg(
        long,
        value_name = "FRACTION",
        value_parser = tolerance,
        allow_hyphen_values = true,
        default_value = "1e-9"
    )]
    pub tolerance: f64,
    /// Print one JSON object instead of the table
    #[arg(long)]
    pub json: bool,
    /// Draw what differs, the second table less the first, as SVG; - is the standard output
    #[arg(long, short, value_name = "SVG")]
    pub output: Option<PathBuf>,
}

fn tolerance(text: &str) -> Result<f64, String> {
    values::number(text, |value| value >= 0.0, "a number from 0 up")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tolerance_is_not_negative() {
        assert_eq!((tolerance("0"), tolerance(" 1e-9")), (Ok(0.0), Ok(1e-9)));
        for bad in ["-1e-9", "nan", "inf", "1 %", ""] {
            assert!(tolerance(bad).is_err(), "{bad}");
        }
    }
}
