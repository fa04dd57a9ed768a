//! Options of `heliotorque ephemeris` that take kernels.

use std::path::PathBuf;

use clap::Args;
use planner::ephemeris::spk::{self, Center};

/// What kernels take the place of a flight.
#[derive(Debug, Args)]
pub(crate) struct KernelOptions {
    /// Fit what this SPK kernel of SPICE places, instead of a flight: planets (de440s.bsp) or a spacecraft; repeatable, where
    /// two place a body the later one counts
    #[arg(long, value_name = "BSP", conflicts_with_all = ["template", "set"])]
    pub kernel: Vec<PathBuf>,
    /// With --kernel: from where positions count, sun, mercury, venus, earth, mars, jupiter or a NAIF id, where 1, 2, 4 and 5
    /// are the barycentres of planets with their moons; otherwise mercury
    #[arg(long, value_name = "BODY", value_parser = spk::center, requires = "kernel")]
    pub center: Option<Center>,
    /// With --kernel: what spacecraft stands for in --bodies, a NAIF id: -236; otherwise messenger
    #[arg(long, value_name = "ID", value_parser = spk::spacecraft, allow_hyphen_values = true, requires = "kernel")]
    pub spacecraft: Option<i32>,
}

impl KernelOptions {
    /// Whether there are kernels.
    pub(crate) fn is_given(&self) -> bool {
        !self.kernel.is_empty()
    }
}
