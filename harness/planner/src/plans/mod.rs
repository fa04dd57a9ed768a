//! Plans of missions through their FMU: momentum, flyby, leg, spin, refit; and the files that they write.

mod files;
mod flights;
pub mod leg;
mod mission_text;
pub mod momentum;
pub mod options;
mod progress;
pub mod refit;
pub mod spin;
