//! What each output and calculated parameter depends on.

mod dynamics;
mod flexibility;
mod groups;
mod propulsion;
mod table;

pub use table::table;
