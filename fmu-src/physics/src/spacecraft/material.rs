//! Surface materials: optics, heat and gas-surface interaction under one name, and the numbers of them that can be set.

use serde::{Deserialize, Serialize};

use super::gas_surface::GasSurface;
use super::optics::Optics;
use super::thermal::{Emission, FaceThermal, LEAST_EMISSIVITY};
use crate::numerics::scalar::Scalar;

/// How far the fractions of light may be off a sum of 1.
pub(crate) const OPTICS_SUM_TOLERANCE: f64 = 1e-9;

/// Properties of a face in sunlight, in the infrared and in the air.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Material<T = f64> {
    /// Optics for sunlight.
    pub optics: Optics<T>,
    /// Infrared optics and emission.
    pub thermal: FaceThermal<T>,
    /// Interaction with air.
    pub gas_surface: GasSurface<T>,
}

impl<T> Material<T> {
    /// Applies `of` to every number, settable or derived.
    pub fn map<U>(self, of: impl Fn(T) -> U) -> Material<U> {
        let FaceThermal { infrared_optics, emission } = self.thermal;
        Material {
            optics: self.optics.map(&of),
            thermal: FaceThermal { infrared_optics: infrared_optics.map(&of), emission: emission.map(&of) },
            gas_surface: self.gas_surface.map(of),
        }
    }
}

/// Number that stands by itself, or is left to the absorptivity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Following<T = f64> {
    /// The number; of one that follows, its change counts, not its value.
    pub value: T,
    /// Whether it follows the absorptivity.
    pub follows: bool,
}

impl<T> Following<T> {
    fn map<U>(self, of: impl Fn(T) -> U) -> Following<U> {
        Following { value: of(self.value), follows: self.follows }
    }
}

impl<T: Scalar> Following<T> {
    /// The number where the absorptivity, or what stands for it, is this.
    fn at(self, absorptivity: T) -> T {
        if self.follows { absorptivity + self.change() } else { self.value }
    }

    /// Derivative part alone of one that follows.
    fn change(self) -> T {
        self.value - T::constant(self.value.value())
    }
}

/// Numbers of a material that can be set; absorptivity is the rest of both reflectivities.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MaterialValues<T = f64> {
    /// Mirrored fraction.
    pub specular: T,
    /// Fraction scattered by Lambert's law.
    pub diffuse: T,
    /// Infrared emissivity at its reference temperature.
    pub emissivity: Following<T>,
    /// Absorbed fraction of the planet's infrared light.
    pub infrared_absorptivity: Following<T>,
    /// Interaction with air.
    pub gas_surface: GasSurface<T>,
}

impl<T> MaterialValues<T> {
    /// Applies `of` to every number.
    pub fn map<U>(self, of: impl Fn(T) -> U) -> MaterialValues<U> {
        MaterialValues {
            specular: of(self.specular),
            diffuse: of(self.diffuse),
            emissivity: self.emissivity.map(&of),
            infrared_absorptivity: self.infrared_absorptivity.map(&of),
            gas_surface: self.gas_surface.map(of),
        }
    }
}

impl MaterialValues {
    /// Numbers that differ where materials do: those that count, and -1 for one that follows.
    pub fn acting(&self) -> [f64; 9] {
        let acting = |it: Following| if it.follows { -1.0 } else { it.value };
        let gas = &self.gas_surface;
        [
            self.specular,
            self.diffuse,
            acting(self.emissivity),
            acting(self.infrared_absorptivity),
            gas.drag_coefficient,
            gas.energy_accommodation,
            gas.normal_accommodation,
            gas.tangential_accommodation,
            gas.wall_temperature_k,
        ]
    }
}

/// Values that no material has, with the parameters that hold them.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MaterialError {
    /// More light reflected than received.
    #[error(
        "optics.{name}.specular + optics.{name}.diffuse: found {found}, allowed: a sum of at most 1; the rest is absorbed"
    )]
    Reflected {
        /// Material.
        name: String,
        /// Sum of both.
        found: f64,
    },
    /// Emission that falls with temperature, so that a heat balance has several answers.
    #[error(
        "optics.{name}.emissivity: found {found} with emissivity_per_k = {slope_per_k} in the file, allowed: one so large that up \
         to 2000 K a hotter face emits more power"
    )]
    Emission {
        /// Material.
        name: String,
        /// Emissivity.
        found: f64,
        /// Its change with temperature, per K.
        slope_per_k: f64,
    },
}

/// Material of a file that some surface is made of.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NamedMaterial {
    /// Name by which its parameters are called.
    pub name: String,
    /// Properties by the file.
    pub material: Material,
    /// Whether the file leaves the emissivity to the absorptivity.
    pub emissivity_follows: bool,
    /// Whether the file leaves the absorbed fraction of infrared light to the absorptivity.
    pub infrared_follows: bool,
    /// Whether the file says how it interacts with air.
    pub has_air: bool,
}

impl NamedMaterial {
    /// The values by the file.
    pub fn values(&self) -> MaterialValues {
        let Material { optics, thermal: FaceThermal { infrared_optics, emission }, gas_surface } =
            self.material;
        MaterialValues {
            specular: optics.specular,
            diffuse: optics.diffuse,
            emissivity: Following { value: emission.emissivity, follows: self.emissivity_follows },
            infrared_absorptivity: Following {
                value: infrared_optics.absorptivity,
                follows: self.infrared_follows,
            },
            gas_surface,
        }
    }

    /// The material with these values in place of the file's; the file's own to the bit where they are equal.
    ///
    /// # Errors
    /// More reflected than received, an emission that falls with temperature.
    pub fn with<T: Scalar>(&self, values: &MaterialValues<T>) -> Result<Material<T>, MaterialError> {
        let own = &self.material;
        let MaterialValues { specular, diffuse, .. } = *values;
        let reflects_as_own =
            [specular.value(), diffuse.value()] == [own.optics.specular, own.optics.diffuse];
        let reflected = specular + diffuse;
        if reflected.value() > 1.0 + OPTICS_SUM_TOLERANCE {
            let (name, found) = (self.name.clone(), reflected.value());
            return Err(MaterialError::Reflected { name, found });
        }
        let rest = T::constant(1.0) - reflected;
        let rest_value = if reflects_as_own { own.optics.absorptivity } else { rest.value().max(0.0) };
        let optics = Optics { absorptivity: with_value(rest_value, rest), specular, diffuse };
        let infrared = values.infrared_absorptivity;
        let infrared_optics = if infrared.follows && infrared.change().same(T::constant(0.0)) {
            optics
        } else {
            optics.with_absorptivity(infrared.at(optics.absorptivity))
        };
        let like_sunlight =
            if rest_value > LEAST_EMISSIVITY { optics.absorptivity } else { T::constant(LEAST_EMISSIVITY) };
        let emissivity = values.emissivity.at(like_sunlight);
        let emission = Emission { emissivity, ..own.thermal.emission.map(T::constant) };
        if !emission.grows() {
            let (name, slope_per_k) = (self.name.clone(), emission.slope_per_k);
            return Err(MaterialError::Emission { name, found: emissivity.value(), slope_per_k });
        }
        let thermal = FaceThermal { infrared_optics, emission };
        Ok(Material { optics, thermal, gas_surface: values.gas_surface })
    }
}

/// A number of this value that changes as `changing` does.
fn with_value<T: Scalar>(value: f64, changing: T) -> T {
    changing - T::constant(changing.value()) + T::constant(value)
}

#[cfg(test)]
mod tests;
