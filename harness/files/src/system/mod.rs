//! What only the operating system says of files: which file it is, who has it open, how it takes another's name.

#[cfg(unix)]
mod unix;
#[cfg(windows)]
mod windows;

#[cfg(unix)]
pub use unix::canonical;
#[cfg(unix)]
pub(crate) use unix::{
    explained, identity, identity_of_link, identity_of_open, lock_folder, open_alone, rename,
};
#[cfg(windows)]
pub use windows::canonical;
#[cfg(windows)]
pub(crate) use windows::{
    explained, identity, identity_of_link, identity_of_open, lock_folder, open_alone, rename,
};

/// A file, under whatever name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Identity {
    /// The disk and the number on it.
    pub place: (u64, u64),
    /// How many names it has.
    pub names: u64,
}
