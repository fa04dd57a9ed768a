//! Hardware of a spinner: mass properties, thrusters, sensors, limits.

use crate::attitude::{Inertia, InertiaError};
use crate::constants::{DEG_RAD, RPM_RAD_S};
use crate::toml::Positive;
use serde::{Deserialize, Serialize};

/// Mass and inertia as functions of the propellant on board.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MassTable {
    /// I3 at each point, in kg m2.
    pub spin_inertia_kg_m2: Vec<f64>,
    /// I3/I_T at each point.
    pub inertia_ratio: Vec<f64>,
    /// The points, rising from empty, in kg.
    pub propellant_kg: Vec<f64>,
    /// Everything but propellant, in kg.
    pub dry_mass_kg: f64,
    /// On board at the start, in kg.
    pub initial_propellant_kg: f64,
    /// I1/I2.
    pub transverse_quotient: f64,
    /// Products of inertia 12, 13, 23 at each point, in kg m2: elements of the tensor. 0 where there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub products_of_inertia_kg_m2: Option<Vec<[f64; 3]>>,
}

impl MassTable {
    /// Inertia with `propellant_kg` on board; held constant outside the table.
    pub fn inertia(&self, propellant_kg: f64) -> Result<Inertia, InertiaError> {
        Inertia::with_products(self.moments_kg_m2(propellant_kg), self.products_kg_m2(propellant_kg))
    }

    /// Moments about the body axes with `propellant_kg` on board, in kg m2.
    pub fn moments_kg_m2(&self, propellant_kg: f64) -> [f64; 3] {
        let at = |values: &[f64]| self.interpolate(propellant_kg, |k| values.get(k).copied());
        let spin = at(&self.spin_inertia_kg_m2);
        let transverse = spin / at(&self.inertia_ratio);
        let root = self.transverse_quotient.sqrt();
        [transverse * root, transverse / root, spin]
    }

    /// Products of inertia 12, 13, 23 with `propellant_kg` on board, in kg m2.
    pub fn products_kg_m2(&self, propellant_kg: f64) -> [f64; 3] {
        let Some(products) = &self.products_of_inertia_kg_m2 else { return [0.0; 3] };
        core::array::from_fn(|i| self.interpolate(propellant_kg, |k| products.get(k).map(|it| it[i])))
    }

    /// A value between those at the points around `propellant_kg`; outside the table that at its end.
    fn interpolate(&self, propellant_kg: f64, value: impl Fn(usize) -> Option<f64>) -> f64 {
        let points = &self.propellant_kg;
        let after = points.iter().skip(1).position(|point| propellant_kg < *point);
        let k = after.unwrap_or(points.len().saturating_sub(2));
        let share = match (points.get(k), points.get(k.saturating_add(1))) {
            (Some(from), Some(to)) => ((propellant_kg - from) / (to - from)).clamp(0.0, 1.0),
            _ => 0.0,
        };
        let first = value(k).or(value(0)).unwrap_or(0.0);
        let next = value(k.saturating_add(1)).unwrap_or(first);
        first + share * (next - first)
    }

    /// Propellant at the last point of the table, in kg.
    pub fn most_propellant_kg(&self) -> f64 {
        self.propellant_kg.last().copied().unwrap_or(0.0)
    }
}

/// Thrusters that fire together.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Group {
    /// Name.
    pub name: String,
    /// Bit k stands for thruster k, from 0.
    pub mask: u32,
    /// Index of the group that pushes the other way.
    pub opposite: Option<usize>,
}

/// Star tracker of a spinner that searches pickets of sky.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StarTracker {
    /// Boresight azimuth from body X toward Y, in deg.
    pub azimuth_deg: f64,
    /// Full width of the field in declination, in deg.
    pub field_of_view_deg: f64,
    /// Pickets in a turn.
    pub pickets: u32,
    /// Spacing of the pickets that are searched in a turn: 1 searches all.
    pub every: u32,
    /// Standard deviation of a declination, in deg.
    pub noise_deg: f64,
}

/// Sun sensor with a slit, from which spins are timed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SunSensor {
    /// Azimuth of the slit from body X toward Y, in deg.
    pub azimuth_deg: f64,
    /// Standard deviation of a Sun angle, in deg.
    pub noise_deg: f64,
    /// Sectors into which science data of one spin are sorted.
    pub sectors: u32,
}

/// Mission limits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Limits {
    /// Greatest angle from the spin axis to the Sun, in deg.
    pub sun_angle_deg: Positive,
    /// Greatest angle from the antenna (-Z) to the Earth, in deg.
    pub earth_angle_deg: Positive,
    /// Nominal spin rate, in rpm.
    pub spin_rate_rpm: Positive,
    /// Allowed either way, in rpm.
    pub spin_rate_tolerance_rpm: Positive,
    /// Greatest variation of the spin period, in s.
    pub period_variation_s: Positive,
}

impl Limits {
    /// Greatest angle from the spin axis to the Sun, in rad.
    pub fn sun_angle_rad(&self) -> f64 {
        self.sun_angle_deg.0 * DEG_RAD
    }

    /// Greatest angle from the antenna (-Z) to the Earth, in rad.
    pub fn earth_angle_rad(&self) -> f64 {
        self.earth_angle_deg.0 * DEG_RAD
    }

    /// Nominal spin rate, in rad/s.
    pub fn spin_rate_rad_s(&self) -> f64 {
        self.spin_rate_rpm.0 * RPM_RAD_S
    }

    /// Allowed either way, in rad/s.
    pub fn spin_rate_tolerance_rad_s(&self) -> f64 {
        self.spin_rate_tolerance_rpm.0 * RPM_RAD_S
    }
}
