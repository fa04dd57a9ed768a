//! Options of `heliotorque check`.

use std::{
    path::PathBuf,
    time::{Duration, Instant},
};

use clap::Args;
use inputs::values::span;

/// `heliotorque check`.
#[derive(Debug, Args)]
pub(crate) struct Check {
    /// The FMU, an .fmu file or the folder it was unpacked into; a system, an .ssp file; a spacecraft, a mission, a timeline, an
    /// ephemeris, a plan, a leg or a campaign, a .toml file
    pub subject: PathBuf,
    /// For a spacecraft, and a mission or what names one: the FMU whose library shall read it, as for `pack`; otherwise the
    /// installed program's own, or dist/MomentumPlant.fmu
    #[arg(long, value_name = "FMU")]
    pub template: Option<PathBuf>,
    /// For an FMU only: check what can be read, without running it
    #[arg(long = "static")]
    pub is_static: bool,
    /// For an FMU only: run the probes whose name contains this text
    #[arg(long, value_name = "TEXT", conflicts_with = "is_static")]
    pub probe: Option<String>,
    /// Longest time that the whole of it may take, in s or with a unit; what it does not come to then is skipped
    #[arg(long, value_name = "TIME", value_parser = span, allow_hyphen_values = true, default_value = "2min")]
    pub timeout: f64,
    /// Print one JSON object: counts and findings
    #[arg(long)]
    pub json: bool,
    /// Show every check, not only the findings
    #[arg(long, short)]
    pub verbose: bool,
}

/// Longest time in s that is counted: beyond it no clock may go.
const LONGEST_S: f64 = 1e9;

impl Check {
    /// Whether it is about a file that a library reads, which this process then loads.
    pub(crate) fn is_file(&self) -> bool {
        self.subject.extension().is_some_and(|extension| extension == "toml")
    }

    /// When all of it has to be over, and the time until then in s.
    pub(crate) fn deadline(&self) -> (Instant, f64) {
        (Instant::now() + Duration::from_secs_f64(self.timeout.min(LONGEST_S)), self.timeout)
    }
}
