//! The model and its immutable setup: the spinner.

use fmi_export::{Context, SetupError};
use physics::spin::spinner::Spinner;

/// The spinner.
pub struct SpinPlant;

/// What every call of the model is given.
pub type Plan<'a> = Context<'a, SpinPlant>;

/// From TOML text.
pub fn parse(file: &str, text: &str) -> Result<Spinner, SetupError> {
    Spinner::parse(file, text).map_err(|error| SetupError(error.to_string()))
}
