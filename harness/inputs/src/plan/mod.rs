//! Plan files: a mission, how far arrays and attitude may go, and the momentum that they hold.

mod command;
pub mod encounter;
pub mod file;
pub mod keys;

pub use file::PlanFile;
