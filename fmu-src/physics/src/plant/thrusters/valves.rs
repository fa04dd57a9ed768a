//! Valves of the thrusters with at most one pulse ahead of each, and the current delta-v, which points its thrusters.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::numerics::{Span, or_infinite};
use crate::plant::settings::reaction_control_settings::{Feed, ReactionControlSettings, ThrustCommand};
use crate::propulsion::{PulseCommand, PulseSchedule, Valve, due_s};
use crate::spacecraft::{Thruster, ThrusterSet};

/// The current delta-v.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Burn {
    set: ThrusterSet,
    since_s: f64,
    #[serde(with = "or_infinite")]
    stop_s: f64,
}

/// Valves, their pulses and the current delta-v.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Valves {
    /// Valve of each thruster.
    pub valves: Vec<Valve>,
    /// Pulses of each thruster.
    pub schedule: Vec<PulseSchedule>,
    burn: Option<Burn>,
}

impl Valves {
    /// Closed valves of `count` thrusters.
    pub(super) fn new(count: usize) -> Self {
        Self {
            valves: vec![Valve::default(); count],
            schedule: vec![PulseSchedule::default(); count],
            burn: None,
        }
    }

    /// Rejects decoded states that no simulation of these thrusters can produce.
    pub(super) fn is_valid(&self, thrusters: &[Thruster]) -> bool {
        let has_members = |set: ThrusterSet| thrusters.iter().any(|thruster| thruster.set == Some(set));
        self.valves.len() == thrusters.len()
            && self.schedule.len() == thrusters.len()
            && self.valves.iter().all(Valve::is_valid)
            && self.schedule.iter().all(PulseSchedule::is_valid)
            && self.burn.is_none_or(|it| it.stop_s > f64::NEG_INFINITY && has_members(it.set))
    }

    /// Commands these pulses for a step, by the law of [`PulseSchedule`]; true if there are any. Thrusters of the delta-v, and all during a dump, keep their own.
    pub(crate) fn command_pulses(
        &mut self,
        thrusters: &[Thruster],
        pulses: &[PulseCommand],
        step: Span,
        is_dumping: bool,
    ) -> bool {
        let mut any = false;
        for (k, (thruster, pulse)) in thrusters.iter().zip(pulses).enumerate() {
            let is_own = self.burn.is_some_and(|burn| thruster.set == Some(burn.set)) || is_dumping;
            any |= self.schedule[k].command(&thruster.valve, pulse, step, !is_own);
        }
        any
    }

    /// Commands a delta-v from the time of `feed` on; true if that changes the present one.
    pub(crate) fn command_thrust(&mut self, feed: &Feed<'_>, command: &ThrustCommand) -> bool {
        let time_s = feed.time_s;
        // A set without thrusters that are fed gives no delta-v.
        let requested = command.set.filter(|set| command.stop_s > due_s(time_s) && feed.feeds_any_of(*set));
        let before = self.burn.map(|burn| (burn.set, burn.stop_s));
        if requested.map(|set| (set, command.stop_s)) == before {
            return false;
        }
        for (k, thruster) in feed.settings.thrusters.iter().enumerate() {
            if self.burn.is_some_and(|burn| thruster.set == Some(burn.set)) {
                self.schedule[k].end(time_s);
            }
            if requested.is_some() && thruster.set == requested {
                self.schedule[k].plan(&thruster.valve, Span::new(time_s, command.stop_s));
            }
        }
        let goes_on = self.burn.filter(|burn| Some(burn.set) == requested);
        self.burn = requested.map(|set| Burn {
            set,
            since_s: goes_on.map_or(time_s, |burn| burn.since_s),
            stop_s: command.stop_s,
        });
        true
    }

    /// Plans a pulse of thruster `k` for `on_s` seconds from the time of `feed` on; none without length.
    pub(super) fn open(&mut self, k: usize, feed: &Feed<'_>, on_s: f64) {
        if on_s > 0.0 {
            let pulse = Span::new(feed.time_s, feed.time_s + on_s);
            self.schedule[k].plan(&feed.settings.thrusters[k].valve, pulse);
        }
    }

    /// Time of the next edge of a pulse or end of a ramp, in s.
    pub(super) fn next_edge_s(&self, thrusters: &[Thruster]) -> f64 {
        let mut next_s = f64::INFINITY;
        for (k, thruster) in thrusters.iter().enumerate() {
            let edge_s = self.schedule[k].next_edge_s();
            next_s = next_s.min(edge_s).min(self.valves[k].ramp_end_s(&thruster.valve));
        }
        next_s
    }

    /// Opens and closes the valves whose time has come; those that no tank feeds shut.
    pub(crate) fn process_events(&mut self, feed: &Feed<'_>) {
        let Feed { settings, time_s, .. } = *feed;
        if settings.thrusters.is_empty() {
            return;
        }
        let due_s = due_s(time_s);
        for (k, thruster) in settings.thrusters.iter().enumerate() {
            let (valve, pulse) = (&mut self.valves[k], &mut self.schedule[k]);
            if pulse.is_idle() && valve.is_shut() {
                continue;
            }
            if !feed.feeds(k) {
                valve.shut(time_s);
                pulse.clear();
                continue;
            }
            if valve.ramp_end_s(&thruster.valve) <= due_s {
                valve.end_ramp(time_s);
            }
            if pulse.close_if_due(due_s) {
                valve.close(&thruster.valve, time_s);
            }
            if pulse.open_if_due(&thruster.valve, due_s) {
                valve.open(&thruster.valve, time_s, thruster.scatter, settings.errors.seed, k as u16);
            }
        }
        self.burn = self.burn.filter(|burn| burn.stop_s > due_s && feed.feeds_any_of(burn.set));
    }

    /// Whether a valve lets propellant through at `time_s`.
    pub(super) fn fire(&self, thrusters: &[Thruster], time_s: f64) -> bool {
        let mut valves = self.valves.iter().zip(thrusters);
        valves.any(|(valve, thruster)| valve.thrust(&thruster.valve, time_s) != [0.0; 2])
    }

    /// Full thrust of thruster `k` at `time_s`, body frame, in N, turned by the errors of a delta-v that it belongs to.
    pub(super) fn force_body_n(
        &self,
        k: usize,
        settings: &ReactionControlSettings,
        time_s: f64,
    ) -> Vector3<f64> {
        let thruster = &settings.thrusters[k];
        match self.burn {
            Some(burn) if thruster.set == Some(burn.set) => {
                let [along, _] = settings.nominal_thrust(burn.set, &Vector3::zeros());
                settings.errors.turned(&thruster.force_body_n, &along, time_s - burn.since_s)
            }
            _ => thruster.force_body_n,
        }
    }

    /// The set that gives the current delta-v.
    pub fn burning(&self) -> Option<ThrusterSet> {
        self.burn.map(|burn| burn.set)
    }
}
