//! The planet's surface: how much light leaves each square metre of it, reflected and infrared.
//!
//! Exitance is power per area leaving the surface into the half space above it, by Lambert's law, in W/m2. All
//! models here depend on the place only through the Sun's zenith angle z there: lit where cos z > 0.

use serde::{Deserialize, Serialize};

use crate::constants::{RADIUS_MERCURY_M, STEFAN_BOLTZMANN_W_M2_K4};
use crate::enumeration::enumeration;
use crate::numerics::scalar::Scalar;
use crate::refusal::Refusal;

enumeration! {
    /// How the day side's temperature is distributed.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    pub enum DayTemperature {
        /// One temperature for the whole day side (paper 004, eq 32).
        // The hemisphere 2 pi R2 radiates what the disc pi R2 absorbs.
        1 => Uniform,
        /// Local balance: the fourth power of temperature goes with the cosine of the Sun's zenith angle.
        // From the night's at the terminator to that of local equilibrium below the Sun.
        2 => Cosine,
        /// The night's temperature everywhere, as under an atmosphere.
        // An atmosphere carries the heat around.
        3 => Isothermal,
    }
}

/// Optical and thermal properties of a spherical planet whose surface is everywhere of one kind.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanetSurface<T = f64> {
    /// Radius of the sphere in m.
    pub radius_m: T,
    /// Absorbed fraction of sunlight (alpha_pl).
    pub absorptivity: T,
    /// Diffusely reflected fraction of sunlight (gamma_D,pl).
    pub diffuse_reflectivity: T,
    /// Infrared emissivity.
    pub emissivity: T,
    /// Temperature of the night side in K.
    pub night_temperature_k: T,
    /// Distribution of the day side's temperature.
    pub day_temperature: DayTemperature,
}

/// Mercury as it fits paper 004, which prints none of this.
pub const MERCURY: PlanetSurface = PlanetSurface {
    radius_m: RADIUS_MERCURY_M,
    absorptivity: 0.88,
    diffuse_reflectivity: 0.12,
    emissivity: 0.9,
    night_temperature_k: 100.0,
    day_temperature: DayTemperature::Uniform,
};

/// Exitance of the surface in W/m2, as a function of c = cos z: reflected light
/// `reflected_cosine * c` where lit; infrared `day_constant + day_cosine * c` where lit, `night` elsewhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceExitance<T: Scalar> {
    /// Reflected sunlight below the Sun.
    pub reflected_cosine_w_m2: T,
    /// Infrared at the day side's edge.
    pub day_constant_w_m2: T,
    /// Infrared below the Sun beyond that at the edge.
    pub day_cosine_w_m2: T,
    /// Infrared at night.
    pub night_w_m2: T,
}

impl PlanetSurface {
    /// Checks every property.
    ///
    /// # Errors
    /// Names the first property outside its range, or a sum of absorptivity and reflectivity above 1.
    pub fn validate(&self) -> Result<(), Refusal> {
        let fraction = |quantity, found| in_range(quantity, found, 0.0, 1.0, "a number from 0 to 1");
        in_range("radius", self.radius_m, 1.0, 1e9, "1 to 1e9 m")?;
        fraction("absorptivity", self.absorptivity)?;
        fraction("diffuseReflectivity", self.diffuse_reflectivity)?;
        fraction("emissivity", self.emissivity)?;
        in_range("nightTemperature", self.night_temperature_k, 0.0, 1e4, "0 to 10000 K")?;
        let sum = self.absorptivity + self.diffuse_reflectivity;
        in_range("absorptivity + diffuseReflectivity", sum, 0.0, 1.0 + 1e-9, "at most 1")?;
        if self.emissivity == 0.0 && self.absorptivity > 0.0 {
            return Err(refused("emissivity", 0.0, "above 0 where light is absorbed"));
        }
        Ok(())
    }

    /// Returns the same properties without derivatives.
    #[inline]
    pub fn constant<T: Scalar>(&self) -> PlanetSurface<T> {
        PlanetSurface {
            radius_m: T::constant(self.radius_m),
            absorptivity: T::constant(self.absorptivity),
            diffuse_reflectivity: T::constant(self.diffuse_reflectivity),
            emissivity: T::constant(self.emissivity),
            night_temperature_k: T::constant(self.night_temperature_k),
            day_temperature: self.day_temperature,
        }
    }
}

impl<T: Scalar> PlanetSurface<T> {
    /// Infrared exitance of the night side in W/m2.
    #[inline]
    pub fn night_exitance_w_m2(&self) -> T {
        let squared_k2 = self.night_temperature_k * self.night_temperature_k;
        self.emissivity * STEFAN_BOLTZMANN_W_M2_K4 * (squared_k2 * squared_k2)
    }

    /// Exitance of the surface while `solar_flux_w_m2` arrives at the planet.
    #[inline]
    pub fn exitance(&self, solar_flux_w_m2: T) -> SurfaceExitance<T> {
        let night_w_m2 = self.night_exitance_w_m2();
        let absorbed_w_m2 = solar_flux_w_m2 * self.absorptivity;
        let (day_constant_w_m2, day_cosine_w_m2) = match self.day_temperature {
            DayTemperature::Uniform => (absorbed_w_m2 * 0.5, T::constant(0.0)),
            DayTemperature::Cosine => (night_w_m2, absorbed_w_m2 - night_w_m2),
            DayTemperature::Isothermal => (night_w_m2, T::constant(0.0)),
        };
        SurfaceExitance {
            reflected_cosine_w_m2: solar_flux_w_m2 * self.diffuse_reflectivity,
            day_constant_w_m2,
            day_cosine_w_m2,
            night_w_m2,
        }
    }
}

impl<T: Scalar> SurfaceExitance<T> {
    /// Infrared exitance in W/m2 at a place whose Sun stands at `cos_zenith`.
    #[inline]
    pub fn infrared_w_m2(&self, cos_zenith: T) -> T {
        if cos_zenith.value() > 0.0 {
            self.day_constant_w_m2 + self.day_cosine_w_m2 * cos_zenith
        } else {
            self.night_w_m2
        }
    }

    /// Reflected exitance in W/m2 at a place whose Sun stands at `cos_zenith`.
    #[inline]
    pub fn reflected_w_m2(&self, cos_zenith: T) -> T {
        if cos_zenith.value() > 0.0 { self.reflected_cosine_w_m2 * cos_zenith } else { T::constant(0.0) }
    }
}

fn refused(quantity: &str, found: f64, allowed: &str) -> Refusal {
    Refusal::new(format_args!("planet surface: `{quantity}` is {found}"), allowed)
}

fn in_range(quantity: &str, found: f64, low: f64, high: f64, allowed: &str) -> Result<(), Refusal> {
    if (low..=high).contains(&found) { Ok(()) } else { Err(refused(quantity, found, allowed)) }
}

#[cfg(test)]
mod tests;
