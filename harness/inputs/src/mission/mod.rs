//! Mission files: what is simulated, when, with which values, what is recorded and what it is judged by.

pub mod file;
pub mod inputs;
pub mod keys;
pub mod resolved;

pub use file::Mission;
pub use inputs::Inputs;
pub use keys::Plot;
pub use resolved::{Limit, Resolved, in_file};
