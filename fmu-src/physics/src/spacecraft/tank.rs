//! Propellant tanks: where each stands, what it holds, and the pressure that it feeds at.

use nalgebra::Vector3;
use serde::Serialize;

use super::part_reader::PartReader;
use crate::toml::{Named, Point, Positive, tables};

/// Density of hydrazine at 20 degrees Celsius, in kg/m3.
const HYDRAZINE_KG_M3: f64 = 1_008.0;

tables! {
/// A propellant tank.
struct TankDescription called "tank" {
    /// Name for thrusters and messages; numbered unless given.
    name: Option<String>,
    /// Position of its propellant, taken as a point, body frame, in m.
    position_m as position_body_m: Point,
    /// Propellant loaded, in kg; a part of mass_properties.mass_kg.
    propellant_kg: Positive,
    /// Pressure when loaded, in Pa. Only its ratio counts; the default is assumed.
    pressure_pa: Positive = 2e6,
    /// Least and greatest pressure at which thrusters may be fed, in Pa; any unless given.
    allowed_pressure_pa: Option<[f64; 2]>,
    /// Volume of the gas that drives the propellant out, in m3: the pressure falls as it expands (blowdown). Left out, the
    /// pressure is regulated.
    ullage_m3: Option<Positive>,
    /// Density of the propellant in blowdown, in kg/m3; the default is hydrazine's.
    density_kg_m3: Positive = HYDRAZINE_KG_M3,
} rules {
    Requires density_kg_m3 => ullage_m3: "no ullage_m3 beside it", "with ullage_m3 alone (blowdown)";
}
}

/// Gas that drives the propellant out without being renewed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Blowdown {
    /// Volume of the gas when the tank is loaded, in m3.
    pub ullage_m3: f64,
    /// Density of the propellant, in kg/m3.
    pub density_kg_m3: f64,
}

/// One tank; its propellant counts as a point there.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Tank {
    /// Name.
    pub name: String,
    /// Position of the propellant, taken as a point, body frame, in m.
    pub position_body_m: Vector3<f64>,
    /// Propellant loaded, in kg; a part of the spacecraft's mass.
    pub propellant_kg: f64,
    /// Pressure when loaded, in Pa.
    pub pressure_pa: f64,
    /// Least and greatest pressure at which thrusters may be fed, in Pa.
    pub allowed_pa: [f64; 2],
    /// The gas's expansion in blowdown; none where the pressure is regulated.
    pub blowdown: Option<Blowdown>,
}

impl Tank {
    /// Pressure when so much is used, in Pa: constant, or that of a gas that expands at constant temperature.
    pub fn pressure_pa(&self, used_kg: f64) -> f64 {
        self.blowdown.map_or(self.pressure_pa, |gas| {
            self.pressure_pa * gas.ullage_m3 / (gas.ullage_m3 + used_kg / gas.density_kg_m3)
        })
    }

    /// Its change with the propellant used, in Pa/kg.
    pub fn pressure_slope_pa_kg(&self, used_kg: f64) -> f64 {
        self.blowdown
            .map_or(0.0, |gas| -self.pressure_pa(used_kg) / (gas.density_kg_m3 * gas.ullage_m3 + used_kg))
    }

    /// Propellant left when so much is used, in kg.
    pub fn left_kg(&self, used_kg: f64) -> f64 {
        (self.propellant_kg - used_kg).max(0.0)
    }

    /// Propellant that it can feed from full until it is empty or its pressure has fallen to the least allowed, in kg.
    pub fn usable_kg(&self) -> f64 {
        let [least_pa, _] = self.allowed_pa;
        let until_least_kg = match self.blowdown {
            Some(gas) => gas.density_kg_m3 * gas.ullage_m3 * (self.pressure_pa / least_pa - 1.0),
            None if self.pressure_pa < least_pa => 0.0,
            None => f64::INFINITY,
        };
        self.propellant_kg.min(until_least_kg).max(0.0)
    }

    /// Whether thrusters may be fed when so much is used.
    pub fn feeds(&self, used_kg: f64) -> bool {
        let [_, greatest_pa] = self.allowed_pa;
        used_kg < self.usable_kg() && self.pressure_pa(used_kg) <= greatest_pa
    }

    /// Propellant that it can still feed when so much is used, in kg.
    pub fn feedable_kg(&self, used_kg: f64) -> f64 {
        if self.feeds(used_kg) { self.usable_kg() - used_kg } else { 0.0 }
    }
}

/// A tank that holds a part of `mass_kg`.
pub(super) fn tank(part: &PartReader<'_>, description: &TankDescription) -> Tank {
    let pressure_pa = description.pressure_pa();
    let blowdown = description
        .ullage_m3
        .map(|ullage_m3| Blowdown { ullage_m3: ullage_m3.0, density_kg_m3: description.density_kg_m3() });
    let allowed_pa = description.allowed_pressure_pa.unwrap_or([0.0, f64::MAX]);
    let [least_pa, greatest_pa] = allowed_pa;
    if !(least_pa >= 0.0 && greatest_pa > least_pa) {
        part.key("allowed_pressure_pa")
            .report(format_args!("{allowed_pa:?}"), "two rising numbers, not negative");
    } else if !(least_pa..=greatest_pa).contains(&pressure_pa) {
        let allowed = format!("a range around pressure_pa = {pressure_pa}");
        part.key("allowed_pressure_pa").report(format_args!("{allowed_pa:?}"), allowed);
    }
    Tank {
        name: description.called(part.index),
        position_body_m: description.position_body_m(),
        propellant_kg: description.propellant_kg.0,
        pressure_pa,
        allowed_pa,
        blowdown,
    }
}
