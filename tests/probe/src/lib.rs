//! Models that probe the export tooling from all sides; none of them is about anything.
//!
//! [`Empty`] has the least a model can have, [`AllTypes`] has everything, and [`Panicking`] panics or fails in
//! the callback that is set.

pub mod all_types;
pub mod empty;
pub mod panicking;

pub use all_types::AllTypes;
pub use empty::Empty;
pub use panicking::Panicking;

fmi_export::export!(Empty, AllTypes, Panicking);
