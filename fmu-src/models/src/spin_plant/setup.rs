//! The model and its immutable setup: the spinner.

use fmi_export::Context;

/// The spinner.
pub struct SpinPlant;

/// Context of every call of the model.
pub(super) type Plan<'a> = Context<'a, SpinPlant>;
