//! Gas-surface interaction: drag coefficient, accommodation and wall temperature of a face in free molecular flow.

use serde::Serialize;

/// Parameters of a face in free molecular flow; each law of [`crate::aerodynamics`] reads its own part.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GasSurface {
    /// Force along the flow over dynamic pressure and projected area.
    pub drag_coefficient: f64,
    /// Energy accommodation: share of the way from the incident energy to that of the wall, 0 to 1.
    pub energy_accommodation: f64,
    /// Accommodation of normal momentum, 0 (specular) to 1 (diffuse).
    pub normal_accommodation: f64,
    /// Accommodation of tangential momentum, 0 (specular) to 1 (diffuse).
    pub tangential_accommodation: f64,
    /// Temperature of the face where no heat balance gives it, in K.
    pub wall_temperature_k: f64,
}

impl GasSurface {
    /// Assumed default: usual values in low Earth orbit, of no particular material.
    pub const ASSUMED: Self = Self {
        drag_coefficient: 2.2,
        energy_accommodation: 0.93,
        normal_accommodation: 0.9,
        tangential_accommodation: 0.9,
        wall_temperature_k: 300.0,
    };
}
