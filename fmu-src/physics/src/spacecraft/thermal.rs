//! How a surface gives off heat: emissivity, conduction between its faces, heat from inside, heat capacity.

use serde::{Deserialize, Serialize};

use super::optics::Optics;
use crate::numerics::scalar::Scalar;
use crate::toml::{Fraction, Positive, tables};

/// Temperature emissivities are stated at unless a file says otherwise, in K.
pub const EMISSIVITY_REFERENCE_TEMPERATURE_K: f64 = 300.0;

/// Up to here the power a face emits must grow with its temperature, in K.
pub(super) const HIGHEST_TEMPERATURE_K: f64 = 2000.0;

/// Least emissivity at any temperature.
pub(super) const LEAST_EMISSIVITY: f64 = 1e-3;

/// Emissivity of a face, linear in temperature and kept from 0.001 to 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Emission<T = f64> {
    /// Emissivity at the reference temperature.
    pub emissivity: T,
    /// Change with temperature per K.
    pub slope_per_k: f64,
    /// Reference temperature in K.
    pub reference_temperature_k: f64,
}

/// Infrared optics and emission of a face.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FaceThermal<T = f64> {
    /// Optics for the planet's infrared light.
    pub infrared_optics: Optics<T>,
    /// Emission of heat.
    pub emission: Emission<T>,
}

/// Heat flow through a thin structure from front to rear (paper 004 eqs 45-47).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Conduction {
    /// Conductance q_SP = k/d r_HC r_C, in W/m2/K.
    pub conductance_w_m2_k: f64,
    /// Factor of sigma (T1^4 - T2^4): eps_int (1 - r_HC) / (2 - eps_int).
    pub radiative_exchange: f64,
}

tables! {
/// A honeycomb between face sheets.
struct HoneycombDescription makes #[derive(Clone, Copy, Debug, PartialEq)] pub struct Honeycomb {
    /// Conductivity of the core's material, in W/m/K.
    conductivity_w_m_k: Positive,
    /// Thickness, in m.
    thickness_m: Positive,
    /// Cross-section of the walls over the panel's area.
    wall_area_ratio: Fraction,
    /// Packing factor of the solar cells.
    packing_factor: Fraction,
    /// Emissivity inside the honeycomb.
    internal_emissivity: Fraction,
}
}

/// Temperature of space unless a file says otherwise, in K: the cosmic microwave background.
pub const BACKGROUND_K: f64 = 2.725;

/// Heat flow from a face to the bus behind it, whose temperature is given.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct BusLink {
    /// Conductance by area of the face, in W/m2/K; 0 where it is insulated.
    pub conductance_w_m2_k: f64,
    /// Temperature of the bus, in K; without a meaning where the face is insulated.
    pub temperature_k: f64,
}

impl BusLink {
    /// Insulation.
    pub const NONE: Self = Self { conductance_w_m2_k: 0.0, temperature_k: 0.0 };

    /// Whether heat flows.
    pub const fn conducts(&self) -> bool {
        self.conductance_w_m2_k > 0.0
    }
}

/// Thermal properties of a plate or panel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Thermal {
    /// The front face.
    pub front: FaceThermal,
    /// The rear face, if light can reach it.
    pub rear: Option<FaceThermal>,
    /// Heat flow between the faces; without it each is insulated.
    pub conduction: Option<Conduction>,
    /// Heat flow from front and rear to the bus.
    pub bus: [BusLink; 2],
    /// Heat from inside that leaves through front and rear, in W.
    pub internal_heat_w: [f64; 2],
    /// Heat capacity of each face, in J/m2/K; 0 where the face follows its light at once.
    pub heat_capacity_j_m2_k: f64,
}

impl Emission {
    /// An emissivity that does not depend on temperature.
    pub const fn constant(emissivity: f64) -> Self {
        Self { emissivity, slope_per_k: 0.0, reference_temperature_k: EMISSIVITY_REFERENCE_TEMPERATURE_K }
    }
}

impl<T: Scalar> Emission<T> {
    /// Emissivity and its derivative by temperature.
    #[inline]
    pub fn at(&self, temperature_k: T) -> (T, T) {
        let linear = (temperature_k - self.reference_temperature_k) * self.slope_per_k + self.emissivity;
        if self.slope_per_k == 0.0 {
            (self.emissivity, T::constant(0.0))
        } else if linear.value() < LEAST_EMISSIVITY {
            (T::constant(LEAST_EMISSIVITY), T::constant(0.0))
        } else if linear.value() > 1.0 {
            (T::constant(1.0), T::constant(0.0))
        } else {
            (linear, T::constant(self.slope_per_k))
        }
    }

    /// Whether a hotter face always emits more, up to 2000 K; otherwise a heat balance has several answers.
    pub(super) fn grows(&self) -> bool {
        // d(eps T^4)/dT = T^3 (4 eps + T eps'); with a falling emissivity it is least at the highest temperature.
        let at_highest = self.emissivity.value()
            + self.slope_per_k * (HIGHEST_TEMPERATURE_K - self.reference_temperature_k);
        self.slope_per_k >= 0.0
            || (at_highest >= LEAST_EMISSIVITY
                && 4.0 * at_highest + HIGHEST_TEMPERATURE_K * self.slope_per_k > 0.0)
    }
}

impl<T> Emission<T> {
    /// The same of another number type.
    pub fn map<U>(self, of: impl Fn(T) -> U) -> Emission<U> {
        let Self { emissivity, slope_per_k, reference_temperature_k } = self;
        Emission { emissivity: of(emissivity), slope_per_k, reference_temperature_k }
    }
}

impl FaceThermal {
    /// As in paper 004: infrared light is treated as sunlight, emissivity equals absorptivity (but is at least 0.001).
    pub const fn like_sunlight(optics: &Optics) -> Self {
        let emissivity =
            if optics.absorptivity > LEAST_EMISSIVITY { optics.absorptivity } else { LEAST_EMISSIVITY };
        Self { infrared_optics: *optics, emission: Emission::constant(emissivity) }
    }
}

impl Honeycomb {
    /// Conductance and radiative exchange (eqs 45, 47).
    pub fn conduction(&self) -> Conduction {
        Conduction {
            conductance_w_m2_k: self.conductivity_w_m_k / self.thickness_m
                * self.wall_area_ratio
                * self.packing_factor,
            radiative_exchange: self.internal_emissivity * (1.0 - self.wall_area_ratio)
                / (2.0 - self.internal_emissivity),
        }
    }
}

impl Thermal {
    /// Insulated faces of these optics, with the paper's emissivities.
    pub fn insulated(front: &Optics, rear: Option<&Optics>) -> Self {
        Self {
            front: FaceThermal::like_sunlight(front),
            rear: rear.map(FaceThermal::like_sunlight),
            conduction: None,
            bus: [BusLink::NONE; 2],
            internal_heat_w: [0.0; 2],
            heat_capacity_j_m2_k: 0.0,
        }
    }
}
