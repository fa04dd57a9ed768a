//! Reaction control of the plant: pulses of the thrusters, on command from outside, for a delta-v, a dump or the attitude, and
//! what they exert.
//!
//! Every thruster has a valve and at most one pulse ahead of it. Edges of pulses, ends of ramps and an empty tank are times at
//! which the motion's segments end; between them force, torque and flow are linear in time:
//! F = F0 f p(u) / p0 with the valve's fraction f and the tank's pressure p, T = (r - c) x F about the centre of mass c, which
//! moves as the tanks drain ([`super::thruster_load`]).

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::attitude::GyrostatMotion;
use crate::numerics::or_infinite;
use crate::numerics::quadrature::GAUSS_3;
use crate::propulsion::{PropellantState, PulseCommand, PulseSchedule, Valve, due_s};
use crate::spacecraft::{MassProperties, Spacecraft, Thrust, Thruster, ThrusterSet};

use super::at_once::AtOnce;
use super::pulsed_dump::PulsedDump;
use super::selected::{Purpose, Selected, Unserved, UnservedDumps};
use super::thruster_load::{ThrusterLoad, ThrusterTotals};
use crate::plant::settings::reaction_control_settings::{Feed, ReactionControlSettings, ThrustCommand};

/// The current delta-v.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Burn {
    set: ThrusterSet,
    since_s: f64,
    #[serde(with = "or_infinite")]
    stop_s: f64,
}

/// Thrusters of the plant: what they are, what is left in their tanks, and what their valves do.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Thrusters {
    /// What parameters set; in a state that was restored nothing, until it is said again.
    #[serde(skip)]
    pub settings: ReactionControlSettings,
    /// Propellant used so far.
    pub propellant: PropellantState,
    valves: Vec<Valve>,
    schedule: Vec<PulseSchedule>,
    burn: Option<Burn>,
    dump: Option<PulsedDump>,
    load: ThrusterLoad,
    totals: ThrusterTotals,
    unserved: UnservedDumps,
    #[serde(skip)]
    for_dumps: Selected,
    #[serde(skip)]
    for_attitude: Selected,
}

impl Thrusters {
    /// With every valve closed and every tank as loaded.
    pub fn new(settings: ReactionControlSettings, time_s: f64) -> Self {
        let count = settings.thrusters.len();
        Self {
            propellant: PropellantState::new(settings.tanks.len(), time_s),
            settings,
            valves: vec![Valve::default(); count],
            schedule: vec![PulseSchedule::default(); count],
            burn: None,
            dump: None,
            load: ThrusterLoad::none(time_s, 1.0),
            totals: ThrusterTotals::default(),
            unserved: UnservedDumps::default(),
            for_dumps: Selected::default(),
            for_attitude: Selected::default(),
        }
    }

    /// Whether a simulation of this spacecraft can produce it; a decoded state has no settings yet.
    pub fn is_valid(&self, spacecraft: &Spacecraft) -> bool {
        let thrusters = &spacecraft.thrusters;
        let has_members = |set: ThrusterSet| thrusters.iter().any(|thruster| thruster.set == Some(set));
        self.valves.len() == thrusters.len()
            && self.schedule.len() == thrusters.len()
            && self.propellant.is_valid(spacecraft.tanks.len())
            && self.valves.iter().all(Valve::is_valid)
            && self.schedule.iter().all(PulseSchedule::is_valid)
            && self.burn.is_none_or(|it| it.stop_s > f64::NEG_INFINITY && has_members(it.set))
            && self.dump.as_ref().is_none_or(PulsedDump::is_valid)
            && self.load.is_valid()
    }

    /// Takes the pulses commanded for the step over `span_s`, by the law of [`PulseSchedule`]. Whether there are any.
    pub fn command_pulses(&mut self, pulses: &[PulseCommand], span_s: [f64; 2]) -> bool {
        let mut any = false;
        let is_dumping = self.is_dumping();
        for (k, (thruster, pulse)) in self.settings.thrusters.iter().zip(pulses).enumerate() {
            // What thrusters do on their own continues.
            let is_own = self.burn.is_some_and(|burn| thruster.set == Some(burn.set)) || is_dumping;
            any |= self.schedule[k].command(&thruster.valve, pulse, span_s, !is_own);
        }
        any
    }

    /// Takes the command of a delta-v that holds from `time_s` on; whether it changes what was going to happen.
    pub fn command_thrust(&mut self, command: &ThrustCommand, time_s: f64) -> bool {
        // A set without thrusters that are fed gives no delta-v.
        let requested =
            command.set.filter(|set| command.stop_s > due_s(time_s) && self.can_burn(*set, time_s));
        let before = self.burn.map(|burn| (burn.set, burn.stop_s));
        if requested.map(|set| (set, command.stop_s)) == before {
            return false;
        }
        for (k, thruster) in self.settings.thrusters.iter().enumerate() {
            if self.burn.is_some_and(|burn| thruster.set == Some(burn.set)) {
                self.schedule[k].end(time_s);
            }
            if requested.is_some() && thruster.set == requested {
                self.schedule[k].plan(&thruster.valve, time_s, command.stop_s);
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

    /// When something about the thrusters next changes by itself, in s.
    pub fn next_edge_s(&self) -> f64 {
        let mut next_s = f64::INFINITY;
        for (k, thruster) in self.settings.thrusters.iter().enumerate() {
            let (valve, pulse) = (&self.valves[k], &self.schedule[k]);
            let edge_s = pulse.next_edge_s();
            next_s = next_s.min(edge_s).min(valve.ramp_end_s(&thruster.valve));
        }
        if !self.load.law.is_none() {
            for (k, tank) in self.settings.tanks.iter().enumerate() {
                next_s = next_s.min(self.propellant.depletion_time_s(k, tank));
            }
        }
        next_s
    }

    /// Opens and closes the valves whose time has come.
    pub fn process_valve_events(&mut self, time_s: f64) {
        let due_s = due_s(time_s);
        let Self { settings, propellant, .. } = self;
        let feed = Feed { settings, propellant, time_s };
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
            if pulse.take_closing(due_s) {
                valve.close(&thruster.valve, time_s);
            }
            if pulse.take_opening(&thruster.valve, due_s) {
                valve.open(&thruster.valve, time_s, thruster.scatter, settings.errors.seed, k as u16);
            }
        }
        self.burn = self.burn.filter(|burn| burn.stop_s > due_s && self.can_burn(burn.set, time_s));
    }

    /// Counts what thrusters did up to `time_s`, the end of the motion's present segment.
    pub fn accumulate(&mut self, motion: &GyrostatMotion, time_s: f64) {
        if !self.load.law.is_none() {
            self.totals = self.totals_at(motion, time_s);
            self.propellant.accumulate(&self.settings.tanks, time_s);
        }
    }

    /// Works out what the thrusters exert from `time_s` on, on a spacecraft with these mass properties then.
    pub fn exert(&mut self, mass: &MassProperties, time_s: f64) {
        self.load = ThrusterLoad::none(time_s, mass.mass_kg);
        let (thrusters, valves) = (&self.settings.thrusters, &self.valves);
        let thrust = |k: usize| valves[k].thrust(&thrusters[k].valve, time_s);
        if (0..thrusters.len()).all(|k| thrust(k) == [0.0; 2]) {
            return;
        }
        self.propellant.accumulate(&self.settings.tanks, time_s);
        let mut nozzles_kg_m_s = Vector3::zeros();
        for (index, tank) in self.settings.tanks.iter().enumerate() {
            let fed = || thrusters.iter().enumerate().filter(|(_, thruster)| thruster.tank == index);
            let used_kg = self.propellant.used_kg(index, time_s);
            // Pressure over that of the nominal thrust, and its slope.
            let over = |thruster: &Thruster| {
                let nominal_pa = thruster.at_pressure_pa.unwrap_or(tank.pressure_pa);
                [tank.pressure_pa(used_kg), tank.pressure_slope_pa_kg(used_kg)].map(|it| it / nominal_pa)
            };
            let flow_kg_s: f64 =
                fed().map(|(k, thruster)| thruster.flow_kg_s * thrust(k)[0] * over(thruster)[0]).sum();
            for (k, thruster) in fed() {
                let ([fraction, slope], [pressure, per_kg]) = (thrust(k), over(thruster));
                let share = [fraction * pressure, slope * pressure + fraction * per_kg * flow_kg_s];
                if share == [0.0; 2] {
                    continue;
                }
                let force_body_n = self.force_body_n(k, time_s);
                let arm_m = thruster.position_body_m - mass.center_of_mass_body_m;
                let torque_body_n_m = arm_m.cross(&force_body_n);
                let flow_kg_s = thruster.flow_kg_s;
                self.propellant.add_flow(index, share.map(|part| flow_kg_s * part));
                nozzles_kg_m_s += arm_m * (flow_kg_s * share[0]);
                self.load.add(&Thrust { force_body_n, torque_body_n_m, flow_kg_s }, &arm_m, share);
            }
        }
        let drained = self.settings.tanks.iter().enumerate().map(|(k, tank)| {
            (self.propellant.flow_kg_s(k), tank.position_body_m - mass.center_of_mass_body_m)
        });
        self.load.drain(drained, &nozzles_kg_m_s);
    }

    /// Full thrust of thruster `k` as it points now.
    fn force_body_n(&self, k: usize, time_s: f64) -> Vector3<f64> {
        let thruster = &self.settings.thrusters[k];
        match self.burn {
            Some(burn) if thruster.set == Some(burn.set) => {
                let [along, _] = self.settings.nominal_thrust(burn.set, &Vector3::zeros());
                self.settings.errors.turned(&thruster.force_body_n, &along, time_s - burn.since_s)
            }
            _ => thruster.force_body_n,
        }
    }

    /// What the thrusters exert in the motion's present segment.
    pub fn load(&self) -> &ThrusterLoad {
        &self.load
    }

    /// What they did up to `time_s` in the motion's present segment.
    pub fn totals_at(&self, motion: &GyrostatMotion, time_s: f64) -> ThrusterTotals {
        let mut totals = self.totals;
        if self.load.law.is_none() {
            return totals;
        }
        let span_s = time_s - self.load.law.since_s;
        for (node, weight) in GAUSS_3 {
            let at_s = self.load.law.since_s + node * span_s;
            let attitude = motion.attitude_at(at_s);
            let torque = self.load.torque_at_n_m(at_s, &motion.rate_at(at_s));
            let acceleration = self.load.acceleration_body_m_s2(at_s);
            totals.impulse_inertial_n_m_s += attitude.inertial_from_body(&torque) * (weight * span_s);
            totals.delta_v_inertial_m_s += attitude.inertial_from_body(&acceleration) * (weight * span_s);
        }
        totals
    }

    /// Thrusters as their tanks feed them at `time_s`.
    fn feed(&self, time_s: f64) -> Feed<'_> {
        Feed { settings: &self.settings, propellant: &self.propellant, time_s }
    }

    /// Whether a thruster of the set is fed.
    fn can_burn(&self, set: ThrusterSet, time_s: f64) -> bool {
        let mut members = self.settings.thrusters.iter().enumerate().filter(|(_, it)| it.set == Some(set));
        members.any(|(k, _)| self.feed(time_s).feeds(k))
    }

    /// The set that gives the current delta-v.
    pub fn burning(&self) -> Option<ThrusterSet> {
        self.burn.map(|burn| burn.set)
    }

    /// Dumps so far that thrusters did not carry out, or not to their end.
    pub fn unserved_dumps(&self) -> UnservedDumps {
        self.unserved
    }

    /// Impulsive dumps and velocity changes at `time_s`.
    pub(crate) fn at_once(&mut self, time_s: f64) -> AtOnce<'_> {
        let Self { settings, propellant, unserved, for_dumps, .. } = self;
        AtOnce { settings, propellant, for_dumps, unserved, time_s }
    }

    /// Begins a dump by pulses toward a total momentum, EME2000, in N m s, at the end of the motion.
    ///
    /// # Errors
    /// No thrusters that are fed give torque all ways about this centre of mass.
    pub(crate) fn begin_dump(
        &mut self,
        motion: &GyrostatMotion,
        target_inertial_n_m_s: Vector3<f64>,
        center_of_mass_body_m: &Vector3<f64>,
    ) -> Result<(), Unserved> {
        let time_s = motion.end_s();
        let Self { settings, propellant, for_dumps, .. } = self;
        let feed = Feed { settings, propellant, time_s };
        if let Err(unserved) = for_dumps.about(&feed, Purpose::Dump, center_of_mass_body_m) {
            self.unserved.count(unserved);
            if unserved == Unserved::OneSided {
                self.dump = None;
            }
            return Err(unserved);
        }
        let before = self.totals_at(motion, time_s);
        self.dump = Some(PulsedDump::new(target_inertial_n_m_s, motion.attitude_at(time_s), before, time_s));
        Ok(())
    }

    /// Whether a dump lasts.
    pub fn is_dumping(&self) -> bool {
        self.dump.is_some_and(|dump| dump.after.is_none())
    }

    /// Mean torque of the current dump's pulses, body frame, in N m.
    pub fn dump_torque_body_n_m(&self) -> Vector3<f64> {
        self.dump
            .filter(|dump| dump.after.is_none())
            .map_or(Vector3::zeros(), |dump| dump.mean_torque_body_n_m)
    }

    /// Angular impulse of the current dump or the last one, in the body frame at its start, in N m s, and its velocity change,
    /// EME2000, in m/s.
    pub fn dumped_at(&self, motion: &GyrostatMotion, time_s: f64) -> Option<[Vector3<f64>; 2]> {
        self.dump.map(|dump| {
            let now = dump.after.unwrap_or_else(|| self.totals_at(motion, time_s));
            let impulse = now.impulse_inertial_n_m_s - dump.before.impulse_inertial_n_m_s;
            let delta_v = now.delta_v_inertial_m_s - dump.before.delta_v_inertial_m_s;
            [dump.attitude_at_start.body_from_inertial(&impulse), delta_v]
        })
    }

    /// Decides the next pulses of a dump where that is due at the end of the motion, the total momentum being this, EME2000, in
    /// N m s.
    pub fn sample_dump(
        &mut self,
        motion: &GyrostatMotion,
        momentum_inertial_n_m_s: &Vector3<f64>,
        mass: &MassProperties,
    ) {
        let time_s = motion.end_s();
        let Some(mut dump) = self.dump.filter(|dump| dump.after.is_none() && dump.next_s <= due_s(time_s))
        else {
            return;
        };
        let totals = self.totals_at(motion, time_s);
        let Self { settings, propellant, valves, schedule, for_dumps, .. } = self;
        let center_of_mass_body_m = &mass.center_of_mass_body_m;
        let feed = Feed { settings, propellant, time_s };
        let selection = for_dumps.about(&feed, Purpose::Dump, center_of_mass_body_m);
        if let Err(unserved) = selection {
            self.unserved.count(unserved);
        }
        let mut pairs = valves.iter().zip(&settings.thrusters);
        let fires = pairs.any(|(valve, it)| valve.thrust(&it.valve, time_s) != [0.0; 2]);
        match selection {
            Ok(selection) if !dump.is_last => {
                let attitude = motion.attitude_at(time_s);
                let left_body_n_m_s =
                    attitude.body_from_inertial(&(dump.target_inertial_n_m_s - momentum_inertial_n_m_s));
                let opened_s = dump.decide(&feed, selection, &left_body_n_m_s, center_of_mass_body_m);
                for (k, on_s) in opened_s.iter().enumerate().filter(|(_, on_s)| **on_s > 0.0) {
                    schedule[k].plan(&settings.thrusters[k].valve, time_s, time_s + on_s);
                }
            }
            // What is left in the valves still comes out.
            _ if fires => return,
            _ => dump.after = Some(totals),
        }
        self.dump = Some(dump);
    }

    /// Pulses over `period_s` from `time_s` on whose mean is this torque, body frame, in N m; the part of it that they give, none
    /// where no thrusters give torque all ways.
    pub fn give(
        &mut self,
        torque_body_n_m: &Vector3<f64>,
        mass: &MassProperties,
        period_s: f64,
        time_s: f64,
    ) -> Option<f64> {
        let purpose = Purpose::Attitude { burning: self.burning() };
        let Self { settings, propellant, schedule, for_attitude, .. } = self;
        let feed = Feed { settings, propellant, time_s };
        let selection = for_attitude.about(&feed, purpose, &mass.center_of_mass_body_m).ok()?;
        let impulse_body_n_m_s = torque_body_n_m * period_s;
        let times = selection.on_times_s(&impulse_body_n_m_s).enumerate();
        let longest_s = times.clone().map(|(k, full_s)| feed.opens_for_s(k, full_s)).fold(0.0, f64::max);
        let given = if longest_s > period_s { period_s / longest_s } else { 1.0 };
        for (k, full_s) in times {
            let shortest_s = settings.thrusters[k].valve.min_on_s;
            let commanded_s = feed.opens_for_s(k, full_s * given).min(period_s);
            let opens_s = if commanded_s >= shortest_s {
                commanded_s
            } else if commanded_s >= 0.5 * shortest_s {
                shortest_s
            } else {
                0.0
            };
            if opens_s > 0.0 {
                schedule[k].plan(&settings.thrusters[k].valve, time_s, time_s + opens_s);
            }
        }
        Some(given)
    }

    /// Whether thrusters that are fed at `time_s`, other than a delta-v's, give torque all ways.
    pub fn spans(&mut self, mass: &MassProperties, time_s: f64) -> bool {
        let purpose = Purpose::Attitude { burning: self.burning() };
        let Self { settings, propellant, for_attitude, .. } = self;
        let feed = Feed { settings, propellant, time_s };
        !settings.thrusters.is_empty()
            && for_attitude.about(&feed, purpose, &mass.center_of_mass_body_m).is_ok()
    }

    /// Thrust of thruster `k` at `time_s`, in N.
    pub fn thrust_n(&self, k: usize, time_s: f64) -> f64 {
        let thruster = &self.settings.thrusters[k];
        let [fraction, slope] = self.valves[k].thrust(&thruster.valve, self.load.law.since_s);
        let share = fraction + slope * (time_s - self.load.law.since_s).max(0.0);
        if share == 0.0 {
            return 0.0;
        }
        thruster.force_body_n.norm() * share * self.feed(time_s).pressure_ratio(k)
    }

    /// Pulses that thruster `k` has begun.
    pub fn pulses(&self, k: usize) -> u32 {
        self.valves[k].pulses()
    }

    /// Whether the last step commanded a pulse of thruster `k` that does not open its valve.
    pub fn was_too_short(&self, k: usize) -> bool {
        self.schedule[k].was_too_short()
    }

    /// Mass properties at `time_s` with every panel at angle 0; none while no propellant is used.
    pub fn left(&self, loaded: &MassProperties, time_s: f64) -> Option<MassProperties> {
        let is_used = self.propellant.total_used_kg(time_s) > 0.0;
        is_used.then(|| self.propellant.mass_properties(loaded, &self.settings.tanks, time_s))
    }
}
