//! The option that bounds the calls of an FMU's library.

use clap::Args;
use inputs::values::span;

/// How long an FMU is waited for.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct Patience {
    /// Longest time that a call of the FMU's library may take, in s or with a unit; it runs in a process of its own, which is
    /// ended then
    #[arg(long, value_name = "TIME", value_parser = span, allow_hyphen_values = true, default_value = "60s")]
    pub timeout: f64,
}
