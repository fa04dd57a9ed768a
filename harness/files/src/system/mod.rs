//! Files by operating system: identity, exclusive access, renaming.

#[cfg(unix)]
mod unix;
#[cfg(windows)]
mod windows;

#[cfg(unix)]
use unix as own;
#[cfg(windows)]
use windows as own;

pub use own::canonical;
pub(crate) use own::{
    identity, identity_of_link, identity_of_open, lock_folder, open_exclusively, rename, sync_folder_of,
    with_advice,
};
