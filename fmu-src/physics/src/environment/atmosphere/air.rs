//! Air at one place and time, and the activity that it follows.

use serde::{Deserialize, Serialize};

/// Air at one place and time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Air {
    /// Density, in kg/m3.
    pub density_kg_m3: f64,
    /// Temperature, in K.
    pub temperature_k: f64,
    /// Mean molar mass, in kg/mol.
    pub molar_mass_kg_mol: f64,
}

/// Activity of the Sun and of the Earth's magnetic field.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpaceWeather {
    /// Flux at 10.7 cm on the day before, in 1e-22 W/(m2 Hz).
    pub f107: f64,
    /// Its mean over 81 days.
    pub f107_average: f64,
    /// Daily Ap.
    pub ap: f64,
}
