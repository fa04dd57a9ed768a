//! Gas-surface interaction: drag coefficient, accommodation and wall temperature of a face in free molecular flow.

use serde::{Deserialize, Serialize};

/// Parameters of a face in free molecular flow; each law of [`crate::aerodynamics`] reads its own part.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GasSurface<T = f64> {
    /// Force along the flow over dynamic pressure and projected area.
    pub drag_coefficient: T,
    /// Energy accommodation: fraction of the difference between incident energy and wall energy that is given up, 0 to 1.
    pub energy_accommodation: T,
    /// Accommodation of normal momentum, 0 (specular) to 1 (diffuse).
    pub normal_accommodation: T,
    /// Accommodation of tangential momentum, 0 (specular) to 1 (diffuse).
    pub tangential_accommodation: T,
    /// Temperature of the face where no heat balance gives it, in K.
    pub wall_temperature_k: T,
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

impl<T> GasSurface<T> {
    /// Applies `of` to every parameter.
    pub fn map<U>(self, of: impl Fn(T) -> U) -> GasSurface<U> {
        GasSurface {
            drag_coefficient: of(self.drag_coefficient),
            energy_accommodation: of(self.energy_accommodation),
            normal_accommodation: of(self.normal_accommodation),
            tangential_accommodation: of(self.tangential_accommodation),
            wall_temperature_k: of(self.wall_temperature_k),
        }
    }
}
