//! The immutable setup: the spinner.

use fmi_export::SetupError;
use physics::spin::spinner::Spinner;

/// From TOML text.
pub fn parse(file: &str, text: &str) -> Result<Spinner, SetupError> {
    Spinner::parse(file, text).map_err(|error| SetupError(error.to_string()))
}
