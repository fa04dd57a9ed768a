//! Options of commands that load an FMU's library: which one, and how long its calls may take.

use std::path::{Path, PathBuf};

use clap::Args;
use inputs::{home, values::span};

/// Longest time of a call.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct Patience {
    /// Longest time that a call of the FMU's library may take, in s or with a unit; it runs in a process of its own, which is
    /// ended then
    #[arg(long, value_name = "TIME", value_parser = span, allow_hyphen_values = true, default_value = "60s")]
    pub timeout: f64,
}

/// The FMU whose library reads a file.
#[derive(Clone, Debug, Args)]
pub(crate) struct Reader {
    /// The FMU whose library reads the file, and simulates what it describes; otherwise the installed program's own, or
    /// dist/MomentumPlant.fmu
    #[arg(long, value_name = "FMU")]
    pub template: Option<PathBuf>,
    /// Time for its calls
    #[command(flatten)]
    pub patience: Patience,
}

impl Reader {
    /// The option.
    pub(crate) fn template(&self) -> Option<&Path> {
        self.template.as_deref()
    }

    /// The option, otherwise the shipped plant.
    pub(crate) fn or_shipped(&self) -> PathBuf {
        self.template.clone().unwrap_or_else(|| home::fmu(home::DEFAULT_MODEL))
    }
}
