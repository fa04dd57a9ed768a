//! Hardware of a spinner: mass properties, thrusters, sensors, limits.

use crate::attitude::{Inertia, InertiaError};
use crate::constants::{DEG_RAD, RPM_RAD_S};
use crate::spacecraft::ValveTiming;
use crate::toml::{
    AtLeastOne, Deviation, FieldWidth, Finite, List, NotNegative, Pickets, Positive, Written, tables,
};
use serde::{Deserialize, Serialize};

tables! {
/// Mass and inertia as functions of the propellant on board.
struct MassEntry makes #[derive(Clone, Debug, PartialEq, Serialize)] pub struct MassTable {
    /// I3 at each point, in kg m2.
    spin_inertia_kg_m2: List<Positive, 2>,
    /// I3/I_T at each point.
    inertia_ratio: List<Positive, 2>,
    /// The points, rising from empty, in kg.
    propellant_kg: List<NotNegative, 2>,
    /// Everything but propellant, in kg.
    dry_mass_kg: Positive,
    /// On board at the start, in kg; otherwise the last point.
    initial_propellant_kg: f64 => |it| it.propellant_kg.last().map_or(0.0, NotNegative::value),
    /// I1/I2.
    transverse_quotient: Positive = 1.0,
    /// Products of inertia 12, 13, 23 at each point, in kg m2: elements of the tensor; otherwise 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    products_of_inertia_kg_m2: Option<Vec<[Finite; 3]>>,
}

/// Star tracker that searches pickets of sky.
struct StarTrackerEntry makes #[derive(Clone, Debug, PartialEq, Serialize)] pub struct StarTracker or Default {
    /// Boresight azimuth from body X toward Y, in deg.
    azimuth_deg: Finite = 90.0,
    /// Full width of the field in declination, in deg.
    field_of_view_deg: FieldWidth = 20.0,
    /// Pickets in a turn, a multiple of 4.
    pickets: Pickets = 900,
    /// One in so many is searched in a turn.
    every: AtLeastOne = 8,
    /// Standard deviation of a declination, in deg.
    noise_deg: Deviation = 0.0,
}

/// Sun sensor with a slit, from which spins are timed.
struct SunSensorEntry makes #[derive(Clone, Debug, PartialEq, Serialize)] pub struct SunSensor or Default {
    /// Azimuth of the slit from body X toward Y, in deg.
    azimuth_deg: Finite = 0.0,
    /// Standard deviation of a Sun angle, in deg.
    noise_deg: Deviation = 0.0,
    /// Sectors into which science data of one spin are sorted.
    sectors: AtLeastOne = 16384,
}
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

/// How a thruster executes its pulses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PulseExecution {
    /// How its valve opens and closes.
    pub valve: ValveTiming,
    /// Standard deviation of the thrust from pulse to pulse, as a fraction of it.
    pub scatter: f64,
}

impl PulseExecution {
    /// Rejects decoded numbers that no simulation can produce.
    pub fn is_valid(&self) -> bool {
        self.valve.is_valid() && (0.0..=1.0).contains(&self.scatter)
    }
}
