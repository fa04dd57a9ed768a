//! Events of a flight: their kinds, the order of those at equal times, and the loop from one to the next.
//!
//! The queue is the least of the times that those who have events tell for each kind. Nothing is stored of it but the last event of
//! each kind, by time and number, so that a state continues under another schedule. Predictions and reports read and end no segment.

use serde::{Deserialize, Serialize};

use crate::guidance::timeline::TimelineEvent;
use crate::plant::settings::error::PlantError;
use crate::plant::settings::thruster_events::{LastEvent, ThrusterEventSettings};

/// Kind of an event, in the order of those at equal times.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum EventKind {
    /// The accounts of the segment that ends are closed.
    Accounts,
    /// Edges of valves, ends of ramps, empty tanks.
    Valves,
    /// End of the torque of a dump without thrusters.
    DumpEnd,
    /// Edge of the disturbance grid; steps of panels and ends of holds end an interval too.
    Grid,
    /// Event of the timeline: centre of mass, then maneuver, then dump.
    Schedule,
    /// Choice of the Sun's direction.
    SunDirection,
    /// Momentum beyond its threshold.
    Threshold,
    /// Sample of sensors and controller.
    Sample,
    /// Edges of valves that these opened, and the load from there on.
    Load,
}

impl EventKind {
    /// Kinds in the order of events at equal times, with their names in messages.
    const ALL: [(Self, &'static str); 9] = [
        (Self::Accounts, "accounts of a segment"),
        (Self::Valves, "edge of a valve"),
        (Self::DumpEnd, "end of a dump"),
        (Self::Grid, "edge of the disturbance grid"),
        (Self::Schedule, "event of the timeline"),
        (Self::SunDirection, "choice of the Sun's direction"),
        (Self::Threshold, "dump at a threshold"),
        (Self::Sample, "sample of the controller"),
        (Self::Load, "load of thrusters"),
    ];

    /// Whether several may come at one time: those of the timeline, and what every segment ends with, be it without length.
    fn may_repeat(self) -> bool {
        matches!(self, Self::Accounts | Self::Valves | Self::Schedule | Self::Load)
    }
}

/// The last event of each kind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct LastEvents([LastEvent; EventKind::ALL.len()]);

impl LastEvents {
    /// No event since `time_s`, where a flight begins.
    pub(crate) fn before(time_s: f64) -> Self {
        Self([LastEvent::before(time_s); EventKind::ALL.len()])
    }

    /// The last one of this kind.
    pub(crate) fn of_kind(&mut self, kind: EventKind) -> &mut LastEvent {
        &mut self.0[kind as usize]
    }

    /// The last one of the timeline.
    pub(crate) fn scheduled(&self) -> LastEvent {
        self.0[EventKind::Schedule as usize]
    }

    /// Returns the next event of a schedule, if there is one, which is over then.
    pub(crate) fn pop_scheduled(&mut self, events: &ThrusterEventSettings) -> Option<TimelineEvent> {
        let last = &mut self.0[EventKind::Schedule as usize];
        let event = events.next(*last).copied()?;
        last.take(events.time_s(&event));
        Some(event)
    }

    /// Whether one of this kind came at `time_s`.
    pub(crate) fn has_come(&self, kind: EventKind, time_s: f64) -> bool {
        let LastEvent { time_s: last_s, count } = self.0[kind as usize];
        last_s == time_s && count > 0
    }
}

/// A flight, or a fork of one, that goes from event to event.
pub(crate) trait Eventful {
    /// The last event of each kind.
    fn last(&mut self) -> &mut LastEvents;

    /// The end of the last segment, in s.
    fn reached_s(&self) -> f64;

    /// Whether that is before `limit_s`, or an edge there belongs to the segment that begins there.
    fn ends_by(&self, limit_s: f64) -> bool;

    /// Returns the time of the next event of this kind, in s; infinite where none does, or where it is found on the way.
    fn next_event_s(&self, kind: EventKind) -> f64;

    /// Whether one of this kind is due at the end of the last segment.
    ///
    /// # Errors
    /// What ends a flight.
    fn is_due(&mut self, kind: EventKind) -> Result<bool, PlantError>;

    /// Counts the work of an event of this kind, or of a segment.
    ///
    /// # Errors
    /// More work than a step may take.
    fn spend(&mut self, kind: Option<EventKind>) -> Result<(), PlantError>;

    /// Applies the event of this kind that is due.
    ///
    /// # Errors
    /// What ends a flight.
    fn apply_event(&mut self, kind: EventKind) -> Result<(), PlantError>;

    /// Advances by a segment, to `limit_s` at most.
    ///
    /// # Errors
    /// What ends a flight.
    fn advance_segment(&mut self, limit_s: f64) -> Result<(), PlantError>;

    /// Advances until everything is known at `limit_s`.
    ///
    /// # Errors
    /// What ends a flight.
    fn advance(&mut self, limit_s: f64) -> Result<(), PlantError> {
        while self.ends_by(limit_s) {
            self.spend(None)?;
            self.apply_due()?;
            let next_s = EventKind::ALL.iter().map(|(kind, _)| self.next_event_s(*kind));
            let next_s = next_s.fold(f64::INFINITY, f64::min);
            self.advance_segment(next_s)?;
        }
        Ok(())
    }

    /// Applies what is due at the end of the last segment.
    ///
    /// # Errors
    /// What ends a flight; an event of a kind twice at one time, where only one may come.
    fn apply_due(&mut self) -> Result<(), PlantError> {
        let time_s = self.reached_s();
        for &(kind, name) in &EventKind::ALL {
            while self.is_due(kind)? {
                self.spend(Some(kind))?;
                if !kind.may_repeat() {
                    if self.last().has_come(kind, time_s) {
                        return Err(PlantError::RepeatedEvent { time_s, kind: name });
                    }
                    self.last().of_kind(kind).take(time_s);
                }
                self.apply_event(kind)?;
            }
        }
        Ok(())
    }
}
