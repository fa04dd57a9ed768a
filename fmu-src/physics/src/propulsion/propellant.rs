//! Propellant in the tanks while thrusters fire, and the mass properties without what is used.
//!
//! Equations: du/dt = q; p(u) as in [`Tank`]; r_c' = (M r_c - sum u_k r_k) / (M - sum u_k);
//! J' = J + M [r_c] - sum u_k [r_k] - M' [r_c'] with [r] = r.r 1 - r r^T (Steiner), propellant taken as points at its tanks.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::flow::{flowed_kg, lasts_s};
use super::pulse_schedule::due_s;
use crate::spacecraft::{MassProperties, Tank, steiner};

/// A tank that can feed less than this share of its load has given all that it can: the rest is rounding.
const LEAST_SHARE: f64 = 1e-13;

/// Propellant used from one tank, linear flow from a time on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct TankUse {
    used_kg: f64,
    /// In kg/s, and its slope in kg/s2.
    flow_kg_s: [f64; 2],
}

/// Propellant used so far.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PropellantState {
    since_s: f64,
    tanks: Vec<TankUse>,
}

impl PropellantState {
    /// With every tank as loaded.
    pub fn new(tanks: usize, time_s: f64) -> Self {
        Self { since_s: time_s, tanks: vec![TankUse::default(); tanks] }
    }

    /// Rejects decoded states that no simulation with this number of tanks can produce.
    pub fn is_valid(&self, tanks: usize) -> bool {
        self.tanks.len() == tanks && self.tanks.iter().all(|tank| tank.used_kg >= 0.0)
    }

    /// Used from tank `k` (from 0) until `time_s`, in kg.
    pub fn used_kg(&self, k: usize, time_s: f64) -> f64 {
        let elapsed_s = (time_s - self.since_s).max(0.0);
        self.tanks.get(k).map_or(0.0, |tank| tank.used_kg + flowed_kg(tank.flow_kg_s, elapsed_s))
    }

    /// Used from all tanks until `time_s`, in kg.
    pub fn total_used_kg(&self, time_s: f64) -> f64 {
        (0..self.tanks.len()).map(|k| self.used_kg(k, time_s)).sum()
    }

    /// Counts what was used until `time_s`; from there nothing flows. A tank whose time has come feeds no longer.
    pub fn accumulate(&mut self, tanks: &[Tank], time_s: f64) {
        for (k, tank) in tanks.iter().enumerate().take(self.tanks.len()) {
            let is_over = self.depletion_time_s(k, tank) <= due_s(time_s);
            let used_kg = if is_over { tank.usable_kg() } else { self.used_kg(k, time_s) };
            self.tanks[k] = TankUse { used_kg: without_rest(tank, used_kg), flow_kg_s: [0.0; 2] };
        }
        self.since_s = time_s;
    }

    /// Adds to the flow from tank `k` since it was settled, in kg/s and kg/s2.
    pub fn add_flow(&mut self, k: usize, flow_kg_s: [f64; 2]) {
        if let Some(tank) = self.tanks.get_mut(k) {
            for (sum, flow) in tank.flow_kg_s.iter_mut().zip(flow_kg_s) {
                *sum += flow;
            }
        }
    }

    /// Flow from tank `k` when it was settled, in kg/s.
    pub fn flow_kg_s(&self, k: usize) -> f64 {
        self.tanks.get(k).map_or(0.0, |tank| tank.flow_kg_s[0])
    }

    /// Takes this much from tank `k` at once, in kg, and no more than it can feed.
    pub fn take(&mut self, k: usize, tank: &Tank, propellant_kg: f64) {
        if let Some(used) = self.tanks.get_mut(k) {
            let taken_kg = propellant_kg.min(tank.feedable_kg(used.used_kg));
            used.used_kg = without_rest(tank, used.used_kg + taken_kg);
        }
    }

    /// When tank `k` has fed all that it can at the present flow, in s.
    pub fn depletion_time_s(&self, k: usize, tank: &Tank) -> f64 {
        self.tanks.get(k).map_or(f64::INFINITY, |used| {
            self.since_s + lasts_s(used.flow_kg_s, tank.usable_kg() - used.used_kg)
        })
    }

    /// Mass properties without what is used until `time_s`, of a spacecraft that has `loaded` with full tanks.
    pub fn mass_properties(&self, loaded: &MassProperties, tanks: &[Tank], time_s: f64) -> MassProperties {
        if self.total_used_kg(time_s) == 0.0 {
            return *loaded;
        }
        without(loaded, tanks, |k| self.used_kg(k, time_s))
    }

    /// Mass properties without what flowed since [`PropellantState::accumulate`] until `time_s`, of a spacecraft that had `settled`
    /// then.
    pub fn mass_properties_since(
        &self,
        settled: &MassProperties,
        tanks: &[Tank],
        time_s: f64,
    ) -> MassProperties {
        without(settled, tanks, |k| self.used_kg(k, time_s) - self.used_kg(k, self.since_s))
    }
}

/// Propellant used, in kg, rounded to all that the tank can feed where hardly more is left.
fn without_rest(tank: &Tank, used_kg: f64) -> f64 {
    let usable_kg = tank.usable_kg();
    if usable_kg - used_kg < LEAST_SHARE * tank.propellant_kg { usable_kg } else { used_kg }
}

/// Mass properties of a body without so much of each tank, in kg.
fn without(body: &MassProperties, tanks: &[Tank], used_kg: impl Fn(usize) -> f64) -> MassProperties {
    let mut mass_kg = body.mass_kg;
    let mut moment_kg_m = body.center_of_mass_body_m * body.mass_kg;
    let mut about_origin_kg_m2 =
        body.inertia_body_kg_m2 + steiner(&body.center_of_mass_body_m) * body.mass_kg;
    for (k, tank) in tanks.iter().enumerate() {
        let used_kg = used_kg(k);
        mass_kg -= used_kg;
        moment_kg_m -= tank.position_body_m * used_kg;
        about_origin_kg_m2 -= steiner(&tank.position_body_m) * used_kg;
    }
    let center_of_mass_body_m: Vector3<f64> = moment_kg_m / mass_kg;
    MassProperties {
        mass_kg,
        center_of_mass_body_m,
        inertia_body_kg_m2: about_origin_kg_m2 - steiner(&center_of_mass_body_m) * mass_kg,
    }
}

#[cfg(test)]
mod tests;
