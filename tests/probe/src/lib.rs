//! Models that probe the export tooling from all sides; none of them is about anything but [`RigidBody`], which closes a
//! loop with another FMU.
//!
//! [`Empty`] has the least a model can have, [`AllTypes`] has everything, [`Panicking`] panics or fails in
//! the callback that is set, and [`Functions`] has statistics of many runs in closed form.

pub mod all_types;
pub mod empty;
pub mod functions;
pub mod panicking;
pub mod rigid_body;

pub use all_types::AllTypes;
pub use empty::Empty;
pub use functions::Functions;
pub use panicking::Panicking;
pub use rigid_body::RigidBody;

fmi_export::export!(Empty, AllTypes, Panicking, RigidBody, Functions);
