//! FMUs put together around a library: spacecraft, start values, schedules, manual, licences; and what an FMU of this project
//! carries.
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "tests make their own files"))]
#![warn(clippy::print_stdout, clippy::print_stderr)]

pub mod assembly;
pub mod carried;
pub mod check;
pub mod coefficients;
pub mod instance;
pub mod manual;
pub mod overview;
pub mod pointing;
pub mod visits;
