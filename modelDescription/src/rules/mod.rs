//! The standard's tables as data: which `initial` a variable may have, when it needs a start value, when it
//! may be set and read, and what the model structure must list.
//!
//! The derive, the exporter's state machine, the validator and the harness all read these.

mod access;
mod initial;
mod structure;

pub use access::{Phase, gettable, settable};
pub use initial::{
    INITIAL_TABLE, InitialRow, InitialRule, StartRule, effective, effective_initial, has_start, initial,
    legal_variabilities, start, start_required,
};
pub use structure::{initial_unknowns, outputs, structure};
