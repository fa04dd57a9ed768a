//! Valves of a spinner's thrusters, and what the thrusters exert between edges.

use serde::{Deserialize, Serialize};

use super::commands::Commands;
use crate::attitude::JetDamping;
use crate::numerics::Span;
use crate::propulsion::{PulseSchedule, ThrustLaw, Valve, due_s};
use crate::spacecraft::{MOST_THRUSTERS, Thruster, steiner};
use crate::spin::spinner::{PulseExecution, Spinner};

/// Valves of all thrusters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Valves {
    execution: [PulseExecution; MOST_THRUSTERS],
    valves: [Valve; MOST_THRUSTERS],
    /// Pulses that were commanded.
    schedule: [PulseSchedule; MOST_THRUSTERS],
    /// Seed of the scatter.
    seed: u64,
    /// Force and torque of the thrusters over time.
    pub law: ThrustLaw,
}

impl Valves {
    /// All closed.
    pub(super) fn new(execution: [PulseExecution; MOST_THRUSTERS], seed: u64, start_s: f64) -> Self {
        Self {
            execution,
            valves: [Valve::default(); MOST_THRUSTERS],
            schedule: [PulseSchedule::default(); MOST_THRUSTERS],
            seed,
            law: ThrustLaw::none(start_s),
        }
    }

    /// Thrusters whose valves are open, bit by bit.
    pub fn open_mask(&self) -> u32 {
        self.valves.iter().enumerate().map(|(k, valve)| u32::from(valve.is_open()) << k).sum()
    }

    /// When a thrust next stops rising or falling, in s; infinite where none does either.
    pub(super) fn ramp_end_s(&self, spinner: &Spinner) -> f64 {
        let ends = self.valves.iter().zip(&self.execution).zip(&spinner.thrusters);
        ends.map(|((valve, execution), _)| valve.ramp_end_s(&execution.valve)).fold(f64::INFINITY, f64::min)
    }

    /// Takes what is commanded for the step from `start_s` to `end_s`, in s, by the law of [`PulseSchedule`].
    pub(super) fn command(&mut self, commands: &Commands, start_s: f64, end_s: f64) {
        let step = Span::new(start_s, end_s);
        for (k, schedule) in self.schedule.iter_mut().enumerate() {
            let timing = &self.execution[k].valve;
            schedule.command(timing, &commands.pulses[k], step, true);
            if commands.fire >> k & 1 == 1 {
                schedule.plan(timing, step);
            }
        }
    }

    /// Thrusters whose commanded pulses act at `now_s`, bit by bit, those that begin and end there taken note of.
    pub(super) fn pulsing_mask(&mut self, now_s: f64) -> u32 {
        let due_s = due_s(now_s);
        let mut mask = 0;
        for (k, schedule) in self.schedule.iter_mut().enumerate() {
            schedule.close_if_due(due_s);
            schedule.open_if_due(&self.execution[k].valve, due_s);
            mask |= u32::from(schedule.is_open()) << k;
        }
        mask
    }

    /// The first edge of a commanded pulse clearly before `end_s`, in s: one at the end of a step waits for the next step's
    /// command, which may continue with the pulse.
    pub(super) fn edge_before_s(&self, spinner: &Spinner, end_s: f64) -> f64 {
        let used = self.schedule.iter().zip(&spinner.thrusters).map(|(schedule, _)| schedule);
        let edges = used.filter(|it| !it.is_idle()).map(PulseSchedule::next_edge_s);
        let edge_s = edges.fold(f64::INFINITY, f64::min);
        if due_s(edge_s) < end_s { edge_s } else { f64::INFINITY }
    }

    /// Thrusters for which the last step commanded a pulse that does not open their valves, bit by bit.
    pub fn too_short_mask(&self) -> u32 {
        self.schedule.iter().enumerate().map(|(k, it)| u32::from(it.was_too_short()) << k).sum()
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

    /// Shuts all valves at `now_s` with nothing more to come out.
    pub(super) fn shut(&mut self, now_s: f64) {
        self.valves.iter_mut().for_each(|valve| valve.shut(now_s));
        self.schedule.iter_mut().for_each(PulseSchedule::clear);
        self.law = ThrustLaw::none(now_s);
    }

    /// Law of the thrusters from `since_s` on with the valves as they are.
    fn law_from(&self, spinner: &Spinner, since_s: f64) -> ThrustLaw {
        let mut law = ThrustLaw::none(since_s);
        self.firing(spinner, since_s).for_each(|(thruster, fraction)| law.add(&thruster.thrust(), fraction));
        law
    }

    /// Momentum that their flow carries away from a body that turns, from the start of the law on.
    pub(super) fn jet_damping(&self, spinner: &Spinner) -> JetDamping {
        let mut jet_damping = JetDamping::default();
        for (thruster, fraction) in self.firing(spinner, self.law.since_s) {
            jet_damping.add(thruster.flow_kg_s, &steiner(&thruster.position_body_m), fraction);
        }
        jet_damping
    }

    /// Thrusters that thrust from `since_s` on, each with the fraction of its thrust there and per second.
    fn firing<'a>(
        &'a self,
        spinner: &'a Spinner,
        since_s: f64,
    ) -> impl Iterator<Item = (&'a Thruster, [f64; 2])> {
        let valves = self.valves.iter().zip(&self.execution).zip(&spinner.thrusters);
        let fractions =
            valves.map(move |((valve, execution), it)| (it, valve.thrust(&execution.valve, since_s)));
        fractions.filter(|(_, fraction)| *fraction != [0.0; 2])
    }

    /// Rejects decoded valves that no simulation can produce by `latest_s`.
    pub(super) fn is_valid(&self, spinner: &Spinner, latest_s: f64) -> bool {
        let since_s = self.law.since_s;
        self.execution.iter().all(PulseExecution::is_valid)
            && self.valves.iter().all(Valve::is_valid)
            && self.schedule.iter().all(PulseSchedule::is_valid)
            && since_s <= latest_s
            && self.law == self.law_from(spinner, since_s)
    }
}
