//! Resource limits of a child process.

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
/// For simulations of any length, of systems too: unbounded allocation is stopped before the host runs out.
pub(crate) const LARGE: ResourceLimits = ResourceLimits { memory: Some(16 << 30), files: None };
