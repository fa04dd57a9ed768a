//! Reaction control of the plant: valves, dump by pulses, propellant, and the force and torque that follow from them.
//!
//! Edges of pulses, ends of ramps and an empty tank are times at which the motion's segments end; between them force, torque
//! and flow are linear in time: F = F0 f p(u) / p0 with the valve's fraction f and the tank's pressure p, T = (r - c) x F about the
//! centre of mass c, which moves as the tanks drain ([`super::thruster_load`]).

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::attitude::GyrostatMotion;
use crate::numerics::quadrature::GAUSS_3;
use crate::propulsion::{PropellantState, due_s};
use crate::spacecraft::{MassProperties, Spacecraft, Thrust, Thruster};

use super::allocation::{ThrusterAllocator, Unserved, UnservedDumps};
use super::pulsed_dump::PulsedDump;
use super::thruster_load::{ThrusterLoad, ThrusterTotals};
use super::valves::Valves;
use crate::plant::settings::reaction_control_settings::{Feed, Purpose, ReactionControlSettings};

/// State of thrusters and tanks: propellant, valves, the current dump, load and totals.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Thrusters {
    /// Propellant used so far.
    pub propellant: PropellantState,
    /// Valves, their pulses and the current delta-v.
    pub valves: Valves,
    dump: Option<PulsedDump>,
    /// Force, torque and flow of the thrusters in the motion's present segment.
    pub load: ThrusterLoad,
    totals: ThrusterTotals,
    /// Dumps so far that thrusters did not carry out, or not to their end.
    pub unserved: UnservedDumps,
}

impl Thrusters {
    /// State with closed valves and full tanks, of a spacecraft with these numbers of thrusters and tanks.
    pub fn new(thrusters: usize, tanks: usize, time_s: f64) -> Self {
        Self {
            propellant: PropellantState::new(tanks, time_s),
            valves: Valves::new(thrusters),
            dump: None,
            load: ThrusterLoad::none(time_s, 1.0),
            totals: ThrusterTotals::default(),
            unserved: UnservedDumps::default(),
        }
    }

    /// Rejects decoded states that no simulation of this spacecraft can produce.
    pub fn is_valid(&self, spacecraft: &Spacecraft) -> bool {
        self.valves.is_valid(&spacecraft.thrusters)
            && self.propellant.is_valid(spacecraft.tanks.len())
            && self.dump.as_ref().is_none_or(PulsedDump::is_valid)
            && self.load.mass_kg > 0.0
    }

    /// Time of the next edge of a valve or of an empty tank, in s.
    pub fn next_edge_s(&self, settings: &ReactionControlSettings) -> f64 {
        let mut next_s = self.valves.next_edge_s(&settings.thrusters);
        if !self.load.law.is_none() {
            for (k, tank) in settings.tanks.iter().enumerate() {
                next_s = next_s.min(self.propellant.depletion_time_s(k, tank));
            }
        }
        next_s
    }

    /// Adds impulse, velocity change and propellant up to `time_s`, the end of the motion's present segment.
    pub fn accumulate(&mut self, settings: &ReactionControlSettings, motion: &GyrostatMotion, time_s: f64) {
        if !self.load.law.is_none() {
            self.totals = self.totals_at(motion, time_s);
            self.propellant.accumulate(&settings.tanks, time_s);
        }
    }

    /// Updates force, torque and flow from `time_s` on, about the centre of mass of these mass properties.
    pub fn update_load(&mut self, settings: &ReactionControlSettings, mass: &MassProperties, time_s: f64) {
        self.load = ThrusterLoad::none(time_s, mass.mass_kg);
        let (thrusters, valves) = (&settings.thrusters, &self.valves);
        if !valves.fire(thrusters, time_s) {
            return;
        }
        let thrust = |k: usize| valves.valves[k].thrust(&thrusters[k].valve, time_s);
        self.propellant.accumulate(&settings.tanks, time_s);
        let mut nozzles_kg_m_s = Vector3::zeros();
        for (index, tank) in settings.tanks.iter().enumerate() {
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
                let opening = [fraction * pressure, slope * pressure + fraction * per_kg * flow_kg_s];
                if opening == [0.0; 2] {
                    continue;
                }
                let force_body_n = valves.force_body_n(k, settings, time_s);
                let arm_m = thruster.position_body_m - mass.center_of_mass_body_m;
                let torque_body_n_m = arm_m.cross(&force_body_n);
                let flow_kg_s = thruster.flow_kg_s;
                self.propellant.add_flow(index, opening.map(|part| flow_kg_s * part));
                nozzles_kg_m_s += arm_m * (flow_kg_s * opening[0]);
                self.load.add(&Thrust { force_body_n, torque_body_n_m, flow_kg_s }, &arm_m, opening);
            }
        }
        let drained = settings.tanks.iter().enumerate().map(|(k, tank)| {
            (self.propellant.flow_kg_s(k), tank.position_body_m - mass.center_of_mass_body_m)
        });
        self.load.drain(drained, &nozzles_kg_m_s);
    }

    /// Impulse and velocity change up to `time_s` in the motion's present segment.
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

    /// Begins a dump by pulses toward a total momentum, EME2000, in N m s, at the end of the motion.
    ///
    /// # Errors
    /// No thrusters that are fed give torque in both senses about every axis through this centre of mass.
    pub(crate) fn begin_dump(
        &mut self,
        allocator: &mut ThrusterAllocator,
        motion: &GyrostatMotion,
        target_inertial_n_m_s: Vector3<f64>,
        center_of_mass_body_m: &Vector3<f64>,
    ) -> Result<(), Unserved> {
        let time_s = motion.end_s();
        let selection =
            allocator.select(&self.propellant, time_s, Purpose::Dump, center_of_mass_body_m).map(|_| ());
        if let Err(unserved) = selection {
            self.unserved.count(unserved);
            if unserved == Unserved::OneSided {
                self.dump = None;
            }
            return Err(unserved);
        }
        self.dump = Some(PulsedDump {
            target_inertial_n_m_s,
            attitude_at_start: motion.attitude_at(time_s),
            before: self.totals_at(motion, time_s),
            next_s: time_s,
            ..PulsedDump::default()
        });
        Ok(())
    }

    /// The dump that lasts.
    pub(crate) fn current_dump(&self) -> Option<PulsedDump> {
        self.dump.filter(|dump| dump.after.is_none())
    }

    /// Whether a dump lasts.
    pub fn is_dumping(&self) -> bool {
        self.current_dump().is_some()
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
        allocator: &mut ThrusterAllocator,
        motion: &GyrostatMotion,
        momentum_inertial_n_m_s: &Vector3<f64>,
        mass: &MassProperties,
    ) {
        let time_s = motion.end_s();
        let Some(mut dump) = self.current_dump().filter(|dump| dump.next_s <= due_s(time_s)) else { return };
        let totals = self.totals_at(motion, time_s);
        let Self { propellant, valves, .. } = self;
        let center_of_mass_body_m = &mass.center_of_mass_body_m;
        let fires = valves.fire(&allocator.settings.thrusters, time_s);
        let selection = allocator.select(propellant, time_s, Purpose::Dump, center_of_mass_body_m);
        if let Err(unserved) = selection {
            self.unserved.count(unserved);
        }
        match selection {
            Ok((feed, selection)) if !dump.is_last => {
                let attitude = motion.attitude_at(time_s);
                let remaining_body_n_m_s =
                    attitude.body_from_inertial(&(dump.target_inertial_n_m_s - momentum_inertial_n_m_s));
                let opened_s = dump.decide(&feed, selection, &remaining_body_n_m_s, center_of_mass_body_m);
                for (k, on_s) in opened_s.into_iter().enumerate() {
                    valves.open(k, &feed, on_s);
                }
            }
            // Open valves deliver the rest of their pulses.
            _ if fires => return,
            _ => dump.after = Some(totals),
        }
        self.dump = Some(dump);
    }

    /// Plans pulses over `period_s` from `time_s` on with this mean torque, body frame, in N m; returns the fraction of it that they
    /// give, `None` without thrusters that give torque in both senses about every axis.
    pub fn give(
        &mut self,
        allocator: &mut ThrusterAllocator,
        torque_body_n_m: &Vector3<f64>,
        mass: &MassProperties,
        [time_s, period_s]: [f64; 2],
    ) -> Option<f64> {
        let Self { propellant, valves, .. } = self;
        let purpose = Purpose::Attitude(valves.burning());
        let selected = allocator.select(propellant, time_s, purpose, &mass.center_of_mass_body_m);
        let (feed, selection) = selected.ok()?;
        let impulse_body_n_m_s = torque_body_n_m * period_s;
        let times = selection.on_times_s(&impulse_body_n_m_s).enumerate();
        let longest_s = times.clone().map(|(k, full_s)| feed.opens_for_s(k, full_s)).fold(0.0, f64::max);
        let given = if longest_s > period_s { period_s / longest_s } else { 1.0 };
        for (k, full_s) in times {
            let shortest_s = feed.settings.thrusters[k].valve.min_on_s;
            let commanded_s = feed.opens_for_s(k, full_s * given).min(period_s);
            if commanded_s >= 0.5 * shortest_s {
                valves.open(k, &feed, commanded_s.max(shortest_s));
            }
        }
        Some(given)
    }

    /// Whether thrusters that are fed at `time_s`, other than a delta-v's, give torque in both senses about every axis.
    pub fn spans(&self, allocator: &mut ThrusterAllocator, mass: &MassProperties, time_s: f64) -> bool {
        let purpose = Purpose::Attitude(self.valves.burning());
        !allocator.settings.thrusters.is_empty()
            && allocator.select(&self.propellant, time_s, purpose, &mass.center_of_mass_body_m).is_ok()
    }

    /// Thrust of thruster `k` at `time_s`, in N.
    pub fn thrust_n(&self, settings: &ReactionControlSettings, k: usize, time_s: f64) -> f64 {
        let (thruster, since_s) = (&settings.thrusters[k], self.load.law.since_s);
        let [fraction, slope] = self.valves.valves[k].thrust(&thruster.valve, since_s);
        let opening = fraction + slope * (time_s - since_s).max(0.0);
        if opening == 0.0 {
            return 0.0;
        }
        let feed = Feed { settings, propellant: &self.propellant, time_s };
        thruster.force_body_n.norm() * opening * feed.pressure_ratio(k)
    }
}
