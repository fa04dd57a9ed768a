//! The probes by subject.

pub(crate) mod calls;
pub(crate) mod host;
pub(crate) mod library;
pub(crate) mod reference;
pub(crate) mod state;
pub(crate) mod stepping;
pub(crate) mod times;
pub(crate) mod values;
