//! Visits of a flight by a timeline: made during the run, and as a table.

mod table;
mod visit;
mod watcher;

pub use table::{HEADER, VisitTable};
pub use visit::Visit;
pub use watcher::Visits;
