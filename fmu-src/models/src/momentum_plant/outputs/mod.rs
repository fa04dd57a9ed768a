//! From flight to output variables.

mod write;

pub use write::{
    derivative, failure, flyable, log_dump, write, write_calculated, write_guaranteed, write_plates,
};
