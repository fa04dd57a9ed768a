//! Propellant tanks: where each stands, what it holds, and the pressure that it feeds at.

use nalgebra::Vector3;
use serde::Serialize;

/// Density of hydrazine at 20 degrees Celsius, in kg/m3.
pub(super) const HYDRAZINE_KG_M3: f64 = 1_008.0;

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
