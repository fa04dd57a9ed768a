//! From flight to output variables.

mod write;

pub(super) use write::{derivative, failure, flyable, log_event, write, write_faces, write_guaranteed};
