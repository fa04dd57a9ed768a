//! DisturbanceTorque through the functions a master calls.

mod driver;
mod laws;
mod slopes;

pub(crate) use driver::{Disturbance, instance};
