//! Options of `heliotorque sweep`.

use std::{ops::Range, path::PathBuf};

use campaign::sweep::options::OUTPUT;
use clap::Args;
use inputs::values::span;

const EXAMPLE: &str = "\
Example:
  heliotorque new campaign campaign.toml && heliotorque sweep campaign.toml --output runs.csv
  heliotorque sweep campaign.toml --dry-run
  heliotorque sweep campaign.toml --runs 0..500 --output first.csv";

/// `heliotorque sweep`.
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Sweep {
    /// The campaign, a .toml file (see `heliotorque new campaign`)
    pub campaign: PathBuf,
    /// Runs from A to before B; otherwise all. Runs are numbered from 0 and do not depend on this option
    #[arg(long, value_name = "A..B", value_parser = range)]
    pub runs: Option<Range<u64>>,
    /// Processes that simulate; otherwise one a core
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub workers: Option<u16>,
    /// The CSV file of runs, with a row a run; - is the standard output. Until it is complete it is <CSV>.part. Beside it stands
    /// <CSV>.toml: units, seed, versions, digests
    #[arg(long, short, value_name = "CSV", default_value = OUTPUT)]
    pub output: PathBuf,
    /// Go on where an earlier sweep of the same campaign was interrupted: with what <CSV>.part holds
    #[arg(long)]
    pub resume: bool,
    /// Begin anew although <CSV>.part holds runs of this campaign, which go
    #[arg(long, conflicts_with = "resume")]
    pub fresh: bool,
    /// Simulate nothing: write the table of the runs' values, to the standard output unless --output is given, then with its
    /// <CSV>.toml
    #[arg(long, conflicts_with = "resume")]
    pub dry_run: bool,
    /// For a mission with a spacecraft only: the FMU whose library shall simulate it, as for `run`
    #[arg(long, value_name = "FMU")]
    pub template: Option<PathBuf>,
    /// Longest time an FMI call may take, in s or with a unit; its run is a failed one then, and another process goes on.
    /// Otherwise without bound
    #[arg(long, value_name = "TIME", value_parser = span, allow_hyphen_values = true)]
    pub timeout: Option<f64>,
    /// Show no progress bar and no summary
    #[arg(long, short)]
    pub quiet: bool,
}

impl Sweep {
    /// The request without the command line.
    pub(crate) fn request(&self) -> campaign::sweep::Sweep {
        let it = self.clone();
        campaign::sweep::Sweep {
            campaign: it.campaign,
            runs: it.runs,
            workers: it.workers,
            output: it.output,
            resume: it.resume,
            fresh: it.fresh,
            dry_run: it.dry_run,
            template: it.template,
            timeout: it.timeout,
            quiet: it.quiet,
        }
    }
}

/// A range of runs.
fn range(text: &str) -> Result<Range<u64>, String> {
    let ends = text.split_once("..").and_then(|(from, to)| {
        let [from, to] = [from, to].map(|it| it.trim().parse::<u64>().ok());
        Some(from?..to?)
    });
    ends.filter(|range| range.start < range.end)
        .ok_or_else(|| "runs are given as A..B, from A to before B: 0..500".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_have_a_run() {
        assert_eq!(range("0..500"), Ok(0..500));
        for bad in ["5", "5..5", "7..5", "a..b", "0..=3", "-1..3"] {
            assert!(range(bad).is_err(), "{bad}");
        }
    }
}
