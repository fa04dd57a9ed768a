//! Why a call is refused: the status by which it answers and the text for the log.

use core::fmt;

use model_description::Status;
use model_description::call_table::{Access, Function, State, allowed};

use crate::model::Failure;

/// Why a call was not carried out.
#[derive(Debug)]
pub(crate) struct Problem {
    /// The answer of the call.
    pub(crate) status: Status,
    /// The reason, with variables by name.
    pub(crate) text: String,
}

impl Problem {
    /// The call cannot be carried out; the instance is in the error state.
    #[cold]
    pub(crate) fn error(text: impl fmt::Display) -> Self {
        Self { status: Status::Error, text: text.to_string() }
    }

    /// A value or a step is not accepted; the instance stays usable.
    #[cold]
    pub(crate) fn discard(text: impl fmt::Display) -> Self {
        Self { status: Status::Discard, text: text.to_string() }
    }

    /// The call was carried out, with something to tell.
    #[cold]
    pub(crate) fn warning(text: impl fmt::Display) -> Self {
        Self { status: Status::Warning, text: text.to_string() }
    }

    /// An argument breaks the C contract: null pointer, bad flag, wrong size.
    #[cold]
    pub(crate) fn argument(name: &str, problem: impl fmt::Display) -> Self {
        Self::error(format_args!("argument {name} {problem}"))
    }

    /// The table forbids the call.
    #[cold]
    pub(crate) fn illegal(function: Function, state: State) -> Self {
        let admitting = State::ALL.into_iter().filter(|it| allowed(function, *it) != Access::Forbidden);
        let states = admitting.map(State::name).collect::<Vec<_>>().join(", ");
        Self::error(format_args!("not allowed in the state {}, only in: {states}", state.name()))
    }

    /// A status that only a pending step has.
    #[cold]
    pub(crate) fn no_status(kind: i32) -> Self {
        Self::discard(format_args!("status kind {kind} has no value here: no step is ever pending"))
    }
}

impl From<Failure> for Problem {
    fn from(failure: Failure) -> Self {
        Self::error(failure)
    }
}
