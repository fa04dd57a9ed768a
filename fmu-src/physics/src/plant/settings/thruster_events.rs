//! Thruster events of a flight: what is scheduled, how far a maneuver is off, and how far the centre of mass moves.
//!
//! The delta-v that is executed is v (1 + s_m n), turned by the rotation s_d n x: n is a normal draw, n x one about each of the
//! two axes across v. After every thruster event, a dump or a maneuver, the centre of mass is its nominal place + s_c n, by axis.
//! Draws are functions of the seed and the event's number.

use serde::{Deserialize, Serialize};
use std::sync::Arc;

use nalgebra::{Rotation3, Vector3};

use super::error::PlantError;
use crate::guidance::timeline::{TimelineDump, TimelineEvent, begun, simulation_time_s};
use crate::momentum::DumpEvent;
use crate::numerics::noise::{Channel, normal, normal_vector};
use crate::spacecraft::ThrusterSet;

/// A delta-v as an impulse through the centre of mass.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Maneuver {
    /// EME2000, in m/s.
    pub delta_v_inertial_m_s: Vector3<f64>,
    /// The thrusters whose propellant it takes; none = no propellant.
    pub thrusters: Option<ThrusterSet>,
    /// Whether a dump goes with it.
    pub dumps: bool,
}

/// A dump or a maneuver as it happens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ThrusterEvent {
    /// A dump.
    Dump(DumpEvent),
    /// A maneuver.
    Maneuver {
        /// When, in s.
        time_s: f64,
        /// The delta-v that was requested, EME2000, in m/s.
        requested_m_s: Vector3<f64>,
        /// The delta-v that was executed.
        executed_m_s: Vector3<f64>,
    },
}

/// Settings of thruster events.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ThrusterEventSettings {
    /// Events of a timeline, in the order of their times.
    pub schedule: Arc<[TimelineEvent]>,
    /// The timeline's clock minus the time of the simulation, in s.
    pub clock_minus_time_s: f64,
    /// The thrusters of maneuvers that name none; `None`: they take no propellant.
    pub thrusters: Option<ThrusterSet>,
    /// Whether a dump goes with maneuvers that do not say so.
    pub dumps: bool,
    /// Standard deviation of a maneuver's magnitude, as a share of it.
    pub magnitude_error: f64,
    /// Standard deviation of its direction about each axis across it, in rad.
    pub direction_error_rad: f64,
    /// Standard deviation of the centre of mass about its nominal place, body frame, in m.
    pub center_of_mass_shift_m: Vector3<f64>,
    /// Seed of the random draws.
    pub seed: u64,
    /// Momentum that dumps on request leave, body frame, in N m s.
    pub requested_body_n_m_s: Vector3<f64>,
}

impl ThrusterEventSettings {
    /// Velocity change that maneuver `number` (from 0 on) executes for a requested delta-v, EME2000, in m/s.
    pub fn executed_m_s(&self, delta_v_m_s: &Vector3<f64>, number: u64) -> Vector3<f64> {
        let mut executed_m_s = *delta_v_m_s;
        if self.magnitude_error != 0.0 {
            executed_m_s *=
                1.0 + self.magnitude_error * normal(self.seed, Channel::ManeuverMagnitude, number);
        }
        let Some(along) = delta_v_m_s.try_normalize(0.0).filter(|_| self.direction_error_rad != 0.0) else {
            return executed_m_s;
        };
        let draw = normal_vector(self.seed, Channel::ManeuverDirection, number);
        let across = draw - along * along.dot(&draw);
        Rotation3::new(across * self.direction_error_rad) * executed_m_s
    }

    /// How far thruster event `number` (from 0 on) leaves the centre of mass from its nominal place, body frame, in m; none
    /// where nothing moves it.
    pub fn shift_body_m(&self, number: u64) -> Option<Vector3<f64>> {
        let sigma_m = self.center_of_mass_shift_m;
        (sigma_m != Vector3::zeros())
            .then(|| normal_vector(self.seed, Channel::CenterOfMass, number).component_mul(&sigma_m))
    }

    /// The momentum that the dump of an event leaves, if it has one, body frame, in N m s.
    pub fn dump_target_body_n_m_s(&self, event: &TimelineEvent) -> Option<Vector3<f64>> {
        match event.dump {
            Some(TimelineDump::To { momentum_body_n_m_s }) => Some(momentum_body_n_m_s),
            Some(TimelineDump::Requested) => Some(self.requested_body_n_m_s),
            None => self.maneuver(event).filter(|it| it.dumps).map(|_| self.requested_body_n_m_s),
        }
    }

    /// The maneuver of an event, if it has one.
    pub(crate) fn maneuver(&self, event: &TimelineEvent) -> Option<Maneuver> {
        event.maneuver.map(|it| Maneuver {
            delta_v_inertial_m_s: it.delta_v_inertial_m_s,
            thrusters: it.thrusters.or(self.thrusters),
            dumps: it.dumps.unwrap_or(self.dumps),
        })
    }

    /// When an event of the schedule comes, in s.
    pub(crate) fn time_s(&self, event: &TimelineEvent) -> f64 {
        simulation_time_s(event.at_s, self.clock_minus_time_s)
    }

    /// The events of the schedule that lie beyond this place.
    fn beyond(&self, place: LastEvent) -> &[TimelineEvent] {
        if self.schedule.is_empty() {
            return &[];
        }
        let up_to = begun(&self.schedule, self.clock_minus_time_s, place.time_s, |event| event.at_s);
        let (over, beyond) = self.schedule.split_at(up_to);
        let at = over.iter().rev().take_while(|event| self.time_s(event) == place.time_s).count();
        let due = at.saturating_sub(place.count as usize);
        self.schedule.get(up_to - due..).unwrap_or(beyond)
    }

    /// The next event of the schedule from this place on.
    pub(crate) fn next(&self, place: LastEvent) -> Option<&TimelineEvent> {
        self.beyond(place).first()
    }

    /// Refuses what a flight by torque does not have from this place on.
    ///
    /// # Errors
    /// An event that is no dump.
    pub(crate) fn check_for_dynamics(&self, place: LastEvent) -> Result<(), PlantError> {
        for event in self.beyond(place) {
            let found = match (event.maneuver, event.center_of_mass_body_m) {
                (Some(_), _) => "a maneuver",
                (None, Some(_)) => "a centre of mass",
                (None, None) => continue,
            };
            return Err(PlantError::ScheduledEvent { line: event.line, found });
        }
        Ok(())
    }

    /// When the next event from this place on comes, in s; infinite where none does.
    pub(crate) fn next_s(&self, place: LastEvent) -> f64 {
        self.next(place).map_or(f64::INFINITY, |event| self.time_s(event))
    }
}

/// The last event of a kind. In a schedule it is a place by time, which counts in any other schedule too: events before `time_s` are
/// over, and `count` of those at it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct LastEvent {
    /// Time of the event, in s.
    pub time_s: f64,
    /// Number of events at that time.
    pub count: u32,
}

impl LastEvent {
    /// Returns the place before the events at `time_s`.
    pub(crate) fn before(time_s: f64) -> Self {
        Self { time_s, count: 0 }
    }

    /// Returns the place after all events up to `time_s`.
    pub(crate) fn until(time_s: f64) -> Self {
        Self { time_s, count: u32::MAX }
    }

    /// Goes on to `time_s`: what another schedule had before it is over.
    pub(crate) fn skip_to(&mut self, time_s: f64) {
        if self.time_s < time_s {
            *self = Self::before(time_s);
        }
    }

    /// Counts an event at `time_s`.
    pub(crate) fn take(&mut self, time_s: f64) {
        let count = if self.time_s == time_s { self.count } else { 0 };
        *self = Self { time_s, count: count.saturating_add(1) };
    }
}

#[cfg(test)]
mod tests;
