//! Resource limits of a child process.

/// Resource limits of a child process.
#[derive(Clone, Copy, Debug, Default, serde::Serialize, serde::Deserialize)]
pub struct ResourceLimits {
    /// Memory, in bytes.
    pub memory: Option<u64>,
    /// Number of open files.
    pub files: Option<u64>,
}

/// For inspecting an FMU and short simulations.
pub const SMALL: ResourceLimits = ResourceLimits { memory: Some(4 << 30), files: Some(1024) };
/// Memory that simulations of any length may take, in bytes: unbounded allocation is stopped before the host runs out.
const MAX_BYTES: u64 = 16 << 30;
/// Memory that they always may, in bytes: less holds no FMU.
const MIN_BYTES: u64 = 256 << 20;

/// Limits of each of `processes` simulations at a time, of any length and of systems too: the smaller of [`MAX_BYTES`] and half of the
/// available memory, over the processes.
pub(super) fn large(processes: u64, available_bytes: Option<u64>) -> ResourceLimits {
    let memory = available_bytes.map_or(MAX_BYTES, |bytes| MAX_BYTES.min(bytes / 2)) / processes.max(1);
    ResourceLimits { memory: Some(memory.max(MIN_BYTES)), files: None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn processes_share_half_of_the_available_memory_up_to_a_bound() {
        let gib = |limits: ResourceLimits| limits.memory.unwrap() as f64 / (1_u64 << 30) as f64;
        assert_eq!(gib(large(1, Some(24 << 30))), 12.0);
        assert_eq!(gib(large(4, Some(24 << 30))), 3.0);
        assert_eq!(gib(large(4, Some(256 << 30))), 4.0);
        assert_eq!(gib(large(4, None)), 4.0);
        assert_eq!(gib(large(1000, Some(24 << 30))), 0.25);
    }
}
