//! The model's options.

use fmi_export::Enumeration;
use physics::environment::surface;

/// How the day side's temperature is distributed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum DayTemperature {
    /// One temperature for the whole day side (paper 004, eq 32).
    Uniform = 1,
    /// Local balance: the fourth power of temperature goes with the cosine of the Sun's zenith angle.
    Cosine = 2,
}

impl From<DayTemperature> for surface::DayTemperature {
    fn from(choice: DayTemperature) -> Self {
        match choice {
            DayTemperature::Uniform => Self::Uniform,
            DayTemperature::Cosine => Self::Cosine,
        }
    }
}
