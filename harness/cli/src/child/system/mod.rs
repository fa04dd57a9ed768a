//! What only the operating system does: groups of processes, orphans, limits, ends of processes, pipes that are read without waiting.

#[cfg(unix)]
mod unix;
#[cfg(windows)]
mod windows;

#[cfg(unix)]
pub(crate) use unix::end_all;
#[cfg(unix)]
pub(super) use unix::{
    Pipe, committed_bytes, end, end_with_parent, has_ended, how, restrict, spawn, take_stdin, wait_for,
};
#[cfg(windows)]
pub(crate) use windows::end_all;
#[cfg(windows)]
pub(super) use windows::{
    Pipe, committed_bytes, end, end_with_parent, has_ended, how, restrict, spawn, take_stdin, wait_for,
};
