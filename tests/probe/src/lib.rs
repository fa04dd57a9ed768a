//! Models that probe the export tooling from all sides; none of them is about anything but [`RigidBody`], which closes a
//! loop with another FMU.
//!
//! [`Empty`] has the least a model can have, [`AllTypes`] has everything, and [`Panicking`] panics or fails in
//! the callback that is set.

pub mod all_types;
pub mod empty;
pub mod panicking;
pub mod rigid_body;

pub use all_types::AllTypes;
pub use empty::Empty;
pub use panicking::Panicking;
pub use rigid_body::RigidBody;

fmi_export::export!(Empty, AllTypes, Panicking, RigidBody);
