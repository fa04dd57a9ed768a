//! Which file it is.

/// A file, under whatever name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Identity {
    /// The disk and the number on it.
    pub place: (u64, u64),
    /// How many names it has.
    pub names: u64,
}
