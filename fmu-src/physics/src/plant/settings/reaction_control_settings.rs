//! Settings and commands of thrusters and tanks, and the thrusters that dump or control the attitude.

use nalgebra::Vector3;

use crate::propulsion::{Preference, PropellantState, SelectionError, ThrustErrors, ThrusterSelection};
use crate::spacecraft::{Tank, Thruster, ThrusterSet};

/// Settings of thrusters and tanks.
#[derive(Clone, Debug, Default)]
pub struct ReactionControlSettings {
    /// Thrusters.
    pub thrusters: Vec<Thruster>,
    /// Tanks.
    pub tanks: Vec<Tank>,
    /// How far a delta-v's thrust is off; its seed scatters pulses too.
    pub errors: ThrustErrors,
    /// Greatest mean torque of a dump about a body axis, in N m.
    pub dump_torque_n_m: f64,
    /// Shortest time between two pulses of a dump, in s.
    pub dump_period_s: f64,
}

/// Purpose of a selection of thrusters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// A dump: the weakest thrusters that give torque in both senses about every axis.
    Dump,
    /// The attitude, while those of a set give a delta-v.
    Attitude(Option<ThrusterSet>),
}

impl ReactionControlSettings {
    /// The thrusters that are fed and serve this purpose about a centre of mass, in m.
    ///
    /// # Errors
    /// A way about an axis that no thruster gives.
    pub fn selection(
        &self,
        purpose: Purpose,
        is_fed: &dyn Fn(usize) -> bool,
        center_of_mass_body_m: &Vector3<f64>,
    ) -> Result<ThrusterSelection, SelectionError> {
        let may_fire = |k: usize| self.thrusters[k].attitude_control && is_fed(k);
        match purpose {
            Purpose::Dump => {
                ThrusterSelection::of_the_finest(&self.thrusters, may_fire, center_of_mass_body_m)
            }
            Purpose::Attitude(burning) => {
                let may_fire =
                    |k: usize| may_fire(k) && (burning.is_none() || self.thrusters[k].set != burning);
                let preference = Preference::LeastOnTime;
                ThrusterSelection::new(&self.thrusters, may_fire, center_of_mass_body_m, preference)
            }
        }
    }

    /// Sum of the nominal forces of a set, body frame, in N, and their torque about a centre of mass, in N m.
    pub fn nominal_thrust(
        &self,
        set: ThrusterSet,
        center_of_mass_body_m: &Vector3<f64>,
    ) -> [Vector3<f64>; 2] {
        let members = self.thrusters.iter().filter(|thruster| thruster.set == Some(set));
        members.fold([Vector3::zeros(); 2], |[force, torque], it| {
            [force + it.force_body_n, torque + it.torque_about_n_m(center_of_mass_body_m)]
        })
    }
}

/// Thrusters as their tanks feed them at a time; pulses, dumps and burns in every mode ask it for the limits of the tanks.
#[derive(Clone, Copy)]
pub(crate) struct Feed<'a> {
    pub settings: &'a ReactionControlSettings,
    pub propellant: &'a PropellantState,
    pub time_s: f64,
}

impl Feed<'_> {
    /// Propellant that tank `index` can still feed, in kg.
    pub(crate) fn feedable_kg(&self, index: usize) -> f64 {
        self.settings.tanks[index].feedable_kg(self.propellant.used_kg(index, self.time_s))
    }

    /// Whether the tank of thruster `k` feeds it.
    pub(crate) fn feeds(&self, k: usize) -> bool {
        let index = self.settings.thrusters[k].tank;
        let tank = self.settings.tanks.get(index);
        tank.is_some_and(|tank| tank.feeds(self.propellant.used_kg(index, self.time_s)))
    }

    /// Whether a thruster of the set is fed.
    pub(crate) fn feeds_any_of(&self, set: ThrusterSet) -> bool {
        let mut members = self.settings.thrusters.iter().enumerate().filter(|(_, it)| it.set == Some(set));
        members.any(|(k, _)| self.feeds(k))
    }

    /// Thrust of thruster `k` over its nominal one, by the pressure of its tank.
    pub(crate) fn pressure_ratio(&self, k: usize) -> f64 {
        let thruster = &self.settings.thrusters[k];
        self.settings.tanks.get(thruster.tank).map_or(0.0, |tank| {
            let used_kg = self.propellant.used_kg(thruster.tank, self.time_s);
            tank.pressure_pa(used_kg) / thruster.at_pressure_pa.unwrap_or(tank.pressure_pa)
        })
    }

    /// Open time of the valve of thruster `k` for `full_s` seconds of nominal thrust, in s; not below zero.
    pub(crate) fn opens_for_s(&self, k: usize, full_s: f64) -> f64 {
        if full_s <= 0.0 {
            return 0.0;
        }
        self.settings.thrusters[k].valve.on_s(full_s / self.pressure_ratio(k)).max(0.0)
    }
}

/// Command of a delta-v.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ThrustCommand {
    /// The thrusters that are to fire; none = no thrust.
    pub set: Option<ThrusterSet>,
    /// When they stop at the latest, in s; infinite without end.
    pub stop_s: f64,
}
