//! Identity of a file, independent of its path.

/// Identity of a file and its number of hard links.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Identity {
    /// Device and inode; volume serial number and file index on Windows.
    pub device_and_inode: (u64, u64),
    /// Number of hard links.
    pub hard_links: u64,
}
