//! The standard's tables as data: which `initial` a variable may have, when it needs a start value, and what
//! the model structure must list. When a variable may be set and read says [`call_table`](crate::call_table).
//!
//! The derive, the exporter's state machine, the validator and the harness all read these.

mod initial;
mod structure;

pub use initial::{
    INITIAL_TABLE, InitialRow, InitialRule, RoleFault, StartRule, check_role, effective, effective_initial,
    has_start, initial, legal_variabilities, listed, start, start_required,
};
pub use structure::{initial_unknowns, outputs, structure};
