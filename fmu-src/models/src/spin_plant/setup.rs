//! The model and its immutable setup: the spinner.

use fmi_export::Context;

/// The spinner.
pub struct SpinPlant;

/// What every call of the model is given.
pub(super) type Plan<'a> = Context<'a, SpinPlant>;
