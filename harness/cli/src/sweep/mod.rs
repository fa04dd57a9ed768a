//! `heliotorque sweep`: many runs of a mission or an FMU whose values vary, and what is kept of each.

mod options;

use std::path::PathBuf;

use clap::Args;
use files::outcome::Outcome;
use inputs::ending::check_ending;
pub(crate) use options::Sweep;

/// `heliotorque sweep-in-child`.
#[derive(Debug, Args)]
pub(crate) struct SweepInChild {
    /// The campaign
    #[arg(long)]
    pub campaign: PathBuf,
    /// The folder that the FMU was unpacked into
    #[arg(long)]
    pub unpacked_in: PathBuf,
    /// The first run
    #[arg(long)]
    pub first: u64,
    /// Distance of the runs
    #[arg(long)]
    pub stride: u64,
    /// The first run that is not simulated
    #[arg(long)]
    pub end: u64,
    /// A new instance a run
    #[arg(long)]
    pub fresh: bool,
}

/// Simulates a campaign.
pub(crate) fn run(arguments: &Sweep) -> Outcome {
    check_ending(&arguments.output, "csv")?;
    campaign::sweep::run(&arguments.request())
}

/// Simulates and sends the parent what is kept.
pub(crate) fn run_in_child(arguments: SweepInChild) -> Outcome {
    let SweepInChild { campaign, unpacked_in, first, stride, end, fresh } = arguments;
    campaign::sweep::run_in_child(&campaign::sweep::SweepInChild {
        campaign,
        unpacked_in,
        first,
        stride,
        end,
        fresh,
    })
}
