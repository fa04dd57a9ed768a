//! Processes by operating system: groups, orphans, limits, exit statuses, pipes that are read without blocking.

#[cfg(unix)]
pub(crate) mod unix;
#[cfg(windows)]
pub(crate) mod windows;

#[cfg(unix)]
use unix as own;
#[cfg(windows)]
use windows as own;

pub use own::end_all;
pub(super) use own::{
    Pipe, available_bytes, committed_bytes, describe_exit, end, end_with_parent, has_ended, is_from_outside,
    restrict, spawn, take_stdin, wait_for,
};
