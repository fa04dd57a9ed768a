//! An FMU in a process of its own: this program again, supervised from outside.
//!
//! Parent and child share one memory without a name. From it the child reads its request, in it the child records the FMI call in
//! progress and sends frames: rows of a recording, findings of a probe, what a whole command shows, its end. What stands there after
//! a crash is still read. Whatever the FMU prints goes through pipes of its own and is never taken for a frame.
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "tests make their own files"))]
#![warn(clippy::print_stdout, clippy::print_stderr)]

mod channel;
mod frame;
pub mod interrupt;
mod limits;
mod printed;
pub mod probes;
mod relayed;
mod supervisor;
mod system;

pub use channel::{Link, attach};
pub use frame::{CHILD, Frame, NOT_REQUESTED, Request, Runs};
pub use limits::{ResourceLimits, SMALL};
pub use printed::Shown;
pub use relayed::Relayed;
pub use supervisor::{Bounds, ChildProcess, EndReason, Supervised};
pub use system::end_all;

/// Limits of each of `processes` simulations at a time, by the memory that is available now.
pub fn large(processes: u64) -> ResourceLimits {
    limits::large(processes, system::available_bytes())
}
