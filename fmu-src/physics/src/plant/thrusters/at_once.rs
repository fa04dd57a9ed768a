//! Thrusters in flight that is followed ideally: dumps and delta-v at once by nominal thrust, as far as the tanks feed them.

use nalgebra::Vector3;

use super::allocation::{ThrusterAllocator, Unserved};
use super::reaction_control::Thrusters;
use crate::math;
use crate::momentum::DumpEvent;
use crate::plant::settings::error::ManeuverError;
use crate::plant::settings::reaction_control_settings::{Feed, Purpose};
use crate::spacecraft::ThrusterSet;

/// Forces of a set whose sum is below this share of them cancel.
const LEAST_FORCE: f64 = 1e-6;

/// Thrusters and tanks at a time, in s.
pub(crate) struct AtOnce<'a> {
    pub thrusters: &'a mut Thrusters,
    pub allocator: &'a mut ThrusterAllocator,
    pub time_s: f64,
}

/// A dump as far as it is carried out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DumpAtOnce {
    pub event: DumpEvent,
    /// Impulse of force that the thrusters leave beside their torque, body frame, in N s; absent of a dump without thrusters.
    pub push_body_n_s: Option<Vector3<f64>>,
}

impl AtOnce<'_> {
    /// A dump without a shortest pulse, about this centre of mass: takes the propellant. What the tanks of the weakest thrusters do
    /// not feed is left to the next ones, and what none feeds is not dumped; without thrusters for every axis and sense all of it
    /// is. `None` where nothing feeds.
    pub(crate) fn dump(
        &mut self,
        event: &DumpEvent,
        center_of_mass_body_m: &Vector3<f64>,
    ) -> Option<DumpAtOnce> {
        let Self { thrusters: Thrusters { propellant, unserved, .. }, allocator, time_s } = self;
        let whole_body_n_m_s = event.impulse_body_n_m_s();
        let (mut left, mut push_body_n_s) = (1.0, Vector3::zeros());
        // Each pass but the last leaves a tank that feeds no longer.
        for _ in 0..=allocator.settings.tanks.len() {
            let selected = allocator.select(propellant, *time_s, Purpose::Dump, center_of_mass_body_m);
            let selection = match selected {
                Ok((_, selection)) => *selection,
                Err(reason) => {
                    unserved.count(reason);
                    if reason == Unserved::OneSided && left == 1.0 {
                        return Some(DumpAtOnce { event: *event, push_body_n_s: None });
                    }
                    break;
                }
            };
            let on_times = selection.on_times_s(&(whole_body_n_m_s * left));
            let settings = &allocator.settings;
            let thrusters = settings.thrusters.iter().zip(on_times);
            let needed_kg = |index: usize| -> f64 {
                let fed = thrusters.clone().filter(|(thruster, _)| thruster.tank == index);
                fed.map(|(thruster, full_s)| thruster.flow_kg_s * full_s).sum()
            };
            let feed = Feed { settings, propellant, time_s: *time_s };
            let part =
                (0..settings.tanks.len()).map(|k| feed.feedable_kg(k) / needed_kg(k)).fold(1.0, f64::min);
            push_body_n_s +=
                thrusters.clone().map(|(it, full_s)| it.force_body_n * full_s).sum::<Vector3<f64>>() * part;
            for (k, tank) in settings.tanks.iter().enumerate() {
                propellant.take(k, tank, needed_kg(k) * part);
            }
            left *= 1.0 - part;
            if left == 0.0 {
                return Some(DumpAtOnce { event: *event, push_body_n_s: Some(push_body_n_s) });
            }
        }
        let after_body_n_m_s = event.after_body_n_m_s - whole_body_n_m_s * left;
        let event = DumpEvent { after_body_n_m_s, ..*event };
        (left < 1.0).then_some(DumpAtOnce { event, push_body_n_s: Some(push_body_n_s) })
    }

    /// A delta-v of this magnitude by a set, of a spacecraft of this mass: takes the propellant m (1 - exp(-dv / c)) from the set's
    /// tanks as it flows, c being the set's force over its flow. A set without thrusters takes none.
    ///
    /// # Errors
    /// A set whose forces cancel, or more propellant than its tanks feed.
    pub(crate) fn delta_v(
        &mut self,
        set: ThrusterSet,
        delta_v_m_s: f64,
        mass_kg: f64,
    ) -> Result<(), ManeuverError> {
        let Self { thrusters: Thrusters { propellant, .. }, allocator, time_s } = self;
        let settings = &allocator.settings;
        let members = || settings.thrusters.iter().filter(|it| it.set == Some(set));
        if members().next().is_none() {
            return Ok(());
        }
        let [force_body_n, _] = settings.nominal_thrust(set, &Vector3::zeros());
        let force_n = force_body_n.norm();
        if force_n <= LEAST_FORCE * members().map(|it| it.force_body_n.norm()).sum::<f64>() {
            return Err(ManeuverError::WithoutThrust { found_n: force_n });
        }
        let total_kg_s: f64 = members().map(|it| it.flow_kg_s).sum();
        let exhaust_m_s = force_n / total_kg_s;
        let used_kg = mass_kg * -math::exp_m1(-delta_v_m_s / exhaust_m_s);
        let needed = |tank: usize| {
            let flow_kg_s: f64 = members().filter(|it| it.tank == tank).map(|it| it.flow_kg_s).sum();
            used_kg * (flow_kg_s / total_kg_s)
        };
        let feed = Feed { settings, propellant, time_s: *time_s };
        for (index, tank) in settings.tanks.iter().enumerate() {
            let (needed_kg, left_kg) = (needed(index), feed.feedable_kg(index));
            if needed_kg > left_kg {
                return Err(ManeuverError::Propellant { tank: tank.name.clone(), needed_kg, left_kg });
            }
        }
        for (index, tank) in settings.tanks.iter().enumerate() {
            propellant.take(index, tank, needed(index));
        }
        Ok(())
    }
}
