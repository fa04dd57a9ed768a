//! Plans of missions through their FMU: momentum, flyby, leg, refit; and the files that they write.

pub mod files;
mod flights;
pub mod leg;
mod mission_text;
pub mod momentum;
pub mod options;
mod picture;
pub mod refit;

use std::path::Path;

use inputs::kind::FileKind;
use physics::spacecraft::Spacecraft;

/// Refuses a file that is no spacecraft, and a spacecraft that does not spin.
///
/// # Errors
/// What was found.
pub fn check_spinner(path: &Path) -> Result<(), String> {
    let (file, text) = (path.display().to_string(), FileKind::Spacecraft.read(path)?);
    if Spacecraft::from_toml(&file, &text).is_err() {
        return Ok(());
    }
    Err(format!("{file}: found a three-axis spacecraft, allowed: a spinner: see `heliotorque new spinner`"))
}
