//! Valves of a spinner's thrusters, and what the thrusters exert between edges: linear in time.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::sound::{are_moderate, is_moderate};
use crate::propulsion::Valve;
use crate::spacecraft::MOST_THRUSTERS;
use crate::spin::{execution::PulseExecution, spinner::Spinner};

/// What thrusters exert from a time on: values then, and their slopes a second.
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
    /// Nothing.
    pub fn none(since_s: f64) -> Self {
        let nothing = [Vector3::zeros(); 2];
        Self { since_s, force_body_n: nothing, torque_body_n_m: nothing, flow_kg_s: [0.0; 2] }
    }

    /// Whether nothing comes out.
    pub fn is_none(&self) -> bool {
        self.flow_kg_s == [0.0; 2]
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

    /// What flowed out until `time_s`, in kg.
    pub fn burnt_kg(&self, time_s: f64) -> f64 {
        let [flow, slope] = self.flow_kg_s;
        let elapsed_s = time_s - self.since_s;
        if slope == 0.0 { flow * elapsed_s } else { (flow + 0.5 * slope * elapsed_s) * elapsed_s }
    }

    /// In how many seconds from its start `left_kg` flow out; infinite where they never do.
    pub fn lasts_s(&self, left_kg: f64) -> f64 {
        let [flow, slope] = self.flow_kg_s;
        if slope == 0.0 {
            return if flow > 0.0 { left_kg / flow } else { f64::INFINITY };
        }
        // Of flow t + slope t^2 / 2 = left, in the form without cancellation.
        let root = flow * flow + 2.0 * slope * left_kg.max(0.0);
        if root < 0.0 { f64::INFINITY } else { 2.0 * left_kg.max(0.0) / (flow + root.sqrt()) }
    }

    fn at(&self, [start, slope]: &[Vector3<f64>; 2], time_s: f64) -> Vector3<f64> {
        if *slope == Vector3::zeros() { *start } else { start + slope * (time_s - self.since_s) }
    }
}

/// Valves of all thrusters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Valves {
    execution: [PulseExecution; MOST_THRUSTERS],
    valves: [Valve; MOST_THRUSTERS],
    /// Of the scatter.
    seed: u64,
    law: ThrustLaw,
}

impl Valves {
    /// All closed.
    pub(super) fn new(execution: [PulseExecution; MOST_THRUSTERS], seed: u64, start_s: f64) -> Self {
        Self { execution, valves: [Valve::default(); MOST_THRUSTERS], seed, law: ThrustLaw::none(start_s) }
    }

    /// How thrusters execute pulses.
    pub fn execution(&self) -> &[PulseExecution; MOST_THRUSTERS] {
        &self.execution
    }

    /// Thrusters whose valves are open, bit by bit.
    pub fn open_mask(&self) -> u32 {
        self.valves.iter().enumerate().map(|(k, valve)| u32::from(valve.is_open()) << k).sum()
    }

    /// What the thrusters exert.
    pub fn law(&self) -> &ThrustLaw {
        &self.law
    }

    /// When a thrust next stops rising or falling, in s; infinite where none does either.
    pub fn ramp_end_s(&self) -> f64 {
        let ends = self.valves.iter().zip(&self.execution);
        ends.map(|(valve, execution)| valve.ramp_end_s(&execution.valve)).fold(f64::INFINITY, f64::min)
    }

    /// Opens the valves of `mask` at `now_s` and closes the others.
    pub(super) fn open(&mut self, spinner: &Spinner, mask: u32, now_s: f64) {
        for (k, (valve, execution)) in self.valves.iter_mut().zip(&self.execution).enumerate() {
            let PulseExecution { valve: timing, scatter } = execution;
            if valve.ramp_end_s(timing) <= now_s {
                valve.end_ramp(now_s);
            }
            if mask >> k & 1 == 1 {
                valve.open(timing, now_s, *scatter, self.seed, k as u16);
            } else {
                valve.close(timing, now_s);
            }
        }
        self.law = self.law_from(spinner, now_s);
    }

    /// Shuts all valves at `now_s` with nothing left to come out.
    pub(super) fn shut(&mut self, now_s: f64) {
        self.valves.iter_mut().for_each(|valve| valve.shut(now_s));
        self.law = ThrustLaw::none(now_s);
    }

    /// What the thrusters exert from `since_s` on with the valves as they are.
    fn law_from(&self, spinner: &Spinner, since_s: f64) -> ThrustLaw {
        let mut law = ThrustLaw::none(since_s);
        for ((valve, execution), thruster) in self.valves.iter().zip(&self.execution).zip(&spinner.thrusters)
        {
            let shares = valve.thrust(&execution.valve, since_s);
            if shares == [0.0; 2] {
                continue;
            }
            for (order, share) in shares.into_iter().enumerate() {
                law.force_body_n[order] += thruster.force_body_n * share;
                law.torque_body_n_m[order] += thruster.torque_body_n_m * share;
                law.flow_kg_s[order] += thruster.flow_kg_s * share;
            }
        }
        law
    }

    /// Whether decoded valves can be some by `latest_s`.
    pub(super) fn is_sound(&self, spinner: &Spinner, latest_s: f64) -> bool {
        let since_s = self.law.since_s;
        self.execution.iter().all(PulseExecution::is_sound)
            && self.valves.iter().all(Valve::is_sound)
            && is_moderate(since_s)
            && since_s <= latest_s
            && self.law.force_body_n.iter().chain(&self.law.torque_body_n_m).all(are_moderate)
            && self.law == self.law_from(spinner, since_s)
    }
}
