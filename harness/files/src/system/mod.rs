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
