//! Plan files: a mission, how far arrays and attitude may go, and the momentum that they hold.

pub mod description;
pub mod file;
pub mod schema;
