//! Resource limits of a child process.

use super::system;

/// Resource limits of a child process.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ResourceLimits {
    /// Memory, in bytes.
    pub memory: Option<u64>,
    /// Number of open files.
    pub files: Option<u64>,
}

/// For inspecting an FMU and short simulations.
pub(crate) const SMALL: ResourceLimits = ResourceLimits { memory: Some(4 << 30), files: Some(1024) };
/// Memory that simulations of any length may take, in bytes: unbounded allocation is stopped before the host runs out.
const MOST: u64 = 16 << 30;
/// Memory that they always may, in bytes: less holds no FMU.
const LEAST: u64 = 256 << 20;

/// For simulations of any length, of systems too, in so many processes at a time: half of what is available, over the processes.
pub(crate) fn large(processes: u64) -> ResourceLimits {
    let share = |bytes: u64| (bytes / 2 / processes.max(1)).max(LEAST);
    let memory = system::available_bytes().map_or(MOST, |bytes| share(bytes).min(MOST));
    ResourceLimits { memory: Some(memory), files: None }
}
