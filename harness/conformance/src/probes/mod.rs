//! The probes by subject.

pub mod calls;
pub mod host;
pub mod library;
pub mod reference;
pub mod state;
pub mod stepping;
pub mod times;
pub mod values;
