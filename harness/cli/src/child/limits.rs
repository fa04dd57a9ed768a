//! Bounds of a child process that the operating system keeps.

/// What the child's process may take of the computer.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Limits {
    /// Bytes that it may allocate.
    pub memory: Option<u64>,
    /// Files that it may keep open.
    pub files: Option<u64>,
}

/// Enough for every FMU that is looked at and not simulated long: memory in bytes, open files.
pub(crate) const SMALL: Limits = Limits { memory: Some(4 << 30), files: Some(1024) };
/// For flights of any length, of systems too: what allocates without end ends before the computer does.
pub(crate) const LARGE: Limits = Limits { memory: Some(16 << 30), files: None };
