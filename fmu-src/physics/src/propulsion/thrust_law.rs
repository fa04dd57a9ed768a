//! Force, torque and flow of thrusters between two edges of their valves: linear in time.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::flow::{flowed_kg, lasts_s};
use crate::spacecraft::Thrust;

/// Force, torque and flow of thrusters from a time on: values then, and their slopes a second.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ThrustLaw {
    /// From when on, in s.
    pub since_s: f64,
    /// Body components, in N.
    pub force_body_n: [Vector3<f64>; 2],
    /// Body components, in N m.
    pub torque_body_n_m: [Vector3<f64>; 2],
    /// In kg/s.
    pub flow_kg_s: [f64; 2],
}

impl ThrustLaw {
    /// Law without force, torque and flow.
    pub fn none(since_s: f64) -> Self {
        let nothing = [Vector3::zeros(); 2];
        Self { since_s, force_body_n: nothing, torque_body_n_m: nothing, flow_kg_s: [0.0; 2] }
    }

    /// Whether nothing fires; couples exert no force, but propellant flows.
    pub fn is_none(&self) -> bool {
        self.flow_kg_s == [0.0; 2]
    }

    /// Adds a thruster's full thrust times a share that is linear in time.
    pub fn add(&mut self, thrust: &Thrust, share: [f64; 2]) {
        for (order, part) in share.into_iter().enumerate() {
            self.force_body_n[order] += thrust.force_body_n * part;
            self.torque_body_n_m[order] += thrust.torque_body_n_m * part;
            self.flow_kg_s[order] += thrust.flow_kg_s * part;
        }
    }

    /// Force at `time_s`, body components, in N.
    pub fn force_at_n(&self, time_s: f64) -> Vector3<f64> {
        self.at(&self.force_body_n, time_s)
    }

    /// Torque at `time_s`, body components, in N m.
    pub fn torque_at_n_m(&self, time_s: f64) -> Vector3<f64> {
        self.at(&self.torque_body_n_m, time_s)
    }

    /// Flow at `time_s`, in kg/s.
    pub fn flow_at_kg_s(&self, time_s: f64) -> f64 {
        self.flow_kg_s[0] + self.flow_kg_s[1] * (time_s - self.since_s)
    }

    /// Mass that flowed out until `time_s`, in kg.
    pub fn burnt_kg(&self, time_s: f64) -> f64 {
        flowed_kg(self.flow_kg_s, time_s - self.since_s)
    }

    /// In how many seconds from its start `left_kg` flow out; infinite where they never do.
    pub fn lasts_s(&self, left_kg: f64) -> f64 {
        lasts_s(self.flow_kg_s, left_kg)
    }

    fn at(&self, [start, slope]: &[Vector3<f64>; 2], time_s: f64) -> Vector3<f64> {
        start + slope * (time_s - self.since_s)
    }
}
