//! Verdicts on the outcome of a call.

use crate::{Status, Value};

use crate::conformance::Finding;

/// Good if it was done.
pub(crate) fn verdict(what: &str, outcome: Result<(), crate::Error>) -> Finding {
    match outcome {
        Ok(()) => Finding::good(what),
        Err(error) => Finding::bad(format!("not so: {what}\n{error}")),
    }
}

/// Good if it was refused with a status; a note if it was let through.
pub(crate) fn refused(what: &str, outcome: Result<(), crate::Error>) -> Finding {
    match outcome {
        Err(error) if matches!(error.status(), Some(Status::Error | Status::Discard)) => {
            Finding::good(format!("refuses {what}"))
        }
        Err(error) if error.status() == Some(Status::Fatal) => {
            Finding::bad(format!("condemns all its instances by fmi2Fatal for {what}"))
        }
        Err(error) => Finding::note(format!("{what}: {error}")),
        Ok(()) => Finding::note(format!("lets through {what}")),
    }
}

/// A value as bits, for comparing.
pub(crate) fn same(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Real(a), Value::Real(b)) => a.to_bits() == b.to_bits() || a == b,
        (a, b) => a == b,
    }
}
