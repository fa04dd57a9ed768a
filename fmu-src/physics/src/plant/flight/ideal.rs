//! Flight in an attitude that is followed ideally: momentum, dumps whose thrusters take propellant and push at once, and maneuvers.
//!
//! Equations of a dump: t = S dH by the thrusters' selection S; dv = sum F t / m; du = sum q t from each tank, nominal thrust and no
//! shortest pulse. Centre of mass and inertia are those with the remaining propellant from there on. Where no thrusters give torque
//! both ways about each axis through the centre of mass a dump is as one of a spacecraft without thrusters.
//! A maneuver is an impulse through the centre of mass: the velocity jumps and the momentum stays
//! ([`crate::plant::settings::thruster_events`]).

use nalgebra::Vector3;

use crate::attitude::Attitude;
use crate::guidance::timeline::TimelineManeuver;
use crate::loads::ForceTorque;
use crate::momentum::{DumpEvent, PreparedSegment, TorqueModel, Totals, WorkKind};

use super::configured::{ConfiguredFlight, StartMomentum, SunSelectionStart};
use super::simulated::Simulated;
use crate::numerics::Span;
use crate::plant::disturbances::evaluation::Evaluation;
use crate::plant::events::{EventKind, Eventful, LastEvents};
use crate::plant::settings::error::{ManeuverError, PlantError};
use crate::plant::settings::mode_settings::IdealSettings;
use crate::plant::settings::thruster_events::{Maneuver, ThrusterEvent};
use crate::plant::state::ideal_state::IdealState;
use crate::plant::thrusters::at_once::{AtOnce, DumpAtOnce};

/// A flight in an attitude that is followed ideally, in one step.
pub(super) struct Ideal<'f> {
    /// State.
    pub state: &'f mut IdealState,
    /// The flight that advances.
    pub flight: ConfiguredFlight<'f>,
    /// Whether it is a fork, whose maneuvers have no errors and take no propellant; it has no dumps.
    pub is_fork: bool,
    /// The segment that begins next.
    pub prepared: Option<PreparedSegment>,
}

impl Eventful for Ideal<'_> {
    fn last(&mut self) -> &mut LastEvents {
        &mut self.state.last
    }

    fn reached_s(&self) -> f64 {
        self.state.integrator.end_s()
    }

    fn ends_by(&self, limit_s: f64) -> bool {
        self.state.integrator.ends_by(limit_s)
    }

    fn next_event_s(&self, kind: EventKind) -> f64 {
        match kind {
            EventKind::Schedule => {
                self.flight.configuration.thruster_events.next_s(self.state.last.scheduled())
            }
            _ => f64::INFINITY,
        }
    }

    fn is_due(&mut self, kind: EventKind) -> Result<bool, PlantError> {
        let time_s = self.reached_s();
        Ok(match kind {
            EventKind::SunDirection => self.flight.plant().must_choose(time_s),
            EventKind::Threshold => {
                let settings = self.flight.configuration.momentum;
                let limit_s = self.next_event_s(EventKind::Schedule);
                let prepared = self.state.integrator.prepare(&mut self.flight.plant(), &settings, limit_s)?;
                let has_come = self.state.last.has_come(kind, time_s);
                self.prepared.insert(prepared).due.is_some() && !has_come
            }
            kind => self.next_event_s(kind) <= time_s,
        })
    }

    fn spend(&mut self, kind: Option<EventKind>) -> Result<(), PlantError> {
        let time_s = self.reached_s();
        match kind {
            Some(EventKind::Schedule | EventKind::Threshold) => {
                self.flight.plant().spend(WorkKind::Dump, time_s)
            }
            // A segment of momentum counts what it takes itself.
            _ => Ok(()),
        }
    }

    fn apply_event(&mut self, kind: EventKind) -> Result<(), PlantError> {
        let time_s = self.reached_s();
        if kind == EventKind::Schedule && self.is_fork {
            self.state.integrator.cut(time_s);
            let delta_v_inertial_m_s = self.event_of_fork(time_s)?;
            self.state.integrator.push(&delta_v_inertial_m_s);
        } else if kind == EventKind::Schedule {
            self.scheduled_event(time_s)?;
        }
        if let Some(due) = self.prepared.take().and_then(|it| it.due).filter(|_| kind == EventKind::Threshold)
        {
            self.dump(&due);
            self.state.integrator.dumps().check()?;
        }
        self.select_sun_direction(time_s)
    }

    fn advance_segment(&mut self, _limit_s: f64) -> Result<(), PlantError> {
        let settings = self.flight.configuration.momentum;
        let Some(prepared) = self.prepared.take() else { return Ok(()) };
        self.state.integrator.advance_segment(&mut self.flight.plant(), &settings, &prepared)
    }
}

impl<'f> Simulated<'f> for Ideal<'f> {
    fn flight(&mut self) -> &mut ConfiguredFlight<'f> {
        &mut self.flight
    }

    fn apply_requests(&mut self, step: Span) -> Result<(), PlantError> {
        let (inputs, start_s) = (self.flight.given.inputs, step.start_s);
        let mut target = inputs.dump_to_body_n_m_s;
        if let Some(maneuver) = inputs.maneuver {
            self.maneuver(start_s, &maneuver)?;
            let requested = self.flight.configuration.thruster_events.requested_body_n_m_s;
            target = target.or(maneuver.dumps.then_some(requested));
        }
        if let Some(target_body_n_m_s) = target {
            self.dump_to(start_s, target_body_n_m_s);
        }
        Ok(())
    }

    fn frame(&mut self, time_s: f64) -> Evaluation {
        self.flight.plant().evaluate_without_loads(time_s)
    }

    fn totals(&mut self, time_s: f64) -> Totals {
        self.state.integrator.totals(time_s)
    }

    fn rows(&mut self, evaluation: &mut Evaluation, applied: ForceTorque) {
        self.flight.plant().write_loads(evaluation, applied);
    }
}

impl<'f> Ideal<'f> {
    /// State at the start of a flight in the attitude after `held`.
    pub(super) fn begin(
        settings: &IdealSettings,
        mut flight: ConfiguredFlight<'f>,
        time_s: f64,
        held: &Attitude,
    ) -> Result<IdealState, PlantError> {
        let bias_body_n_m_s = flight.configuration.momentum.policy.bias_body_n_m_s;
        let momentum_body_n_m_s = bias_body_n_m_s + settings.start_momentum_body_n_m_s;
        flight.models.begin_work(flight.given.work_limit);
        let frame = flight.plant().instant(time_s).law.frame;
        let totals = Totals::at_start(momentum_body_n_m_s, &frame.inertial_from_body);
        let momentum = StartMomentum::Body(momentum_body_n_m_s);
        flight.select_sun_direction(&SunSelectionStart { time_s, totals, momentum, is_first: true })?;
        flight.models.begin_work(flight.given.work_limit);
        let mut plant = flight.plant();
        plant.prepare(time_s, time_s)?;
        let frame = plant.instant(time_s).law.frame;
        let totals = Totals::at_start(momentum_body_n_m_s, &frame.inertial_from_body);
        let mut begun = IdealState::new(time_s, held, totals);
        flight.models.begin_work(flight.given.work_limit);
        flight.propagator.panel_turns.restart();
        let mut ideal = Ideal { state: &mut begun, flight, is_fork: false, prepared: None };
        ideal.advance(time_s)?;
        Ok(begun)
    }

    /// Dumps to this momentum, body frame, from the wheels' bias, in N m s, at `time_s` on request.
    fn dump_to(&mut self, time_s: f64, target_body_n_m_s: Vector3<f64>) {
        let settings = self.flight.configuration.momentum;
        let target_body_n_m_s = settings.policy.bias_body_n_m_s + target_body_n_m_s;
        let event =
            self.state.integrator.request(&mut self.flight.plant(), &settings, time_s, target_body_n_m_s);
        self.dump(&event);
    }

    /// The maneuver, at `time_s`.
    fn maneuver(&mut self, time_s: f64, maneuver: &Maneuver) -> Result<(), PlantError> {
        let refused = |why: ManeuverError| PlantError::Maneuver { time_s, why };
        let found_m_s = maneuver.delta_v_inertial_m_s;
        if !found_m_s.iter().all(|it| it.is_finite()) {
            return Err(refused(ManeuverError::NotFinite { found_m_s: found_m_s.into() }));
        }
        let number = u64::from(self.state.maneuvers.count.unsigned_abs());
        let events = &self.flight.configuration.thruster_events;
        let executed_m_s = events.executed_m_s(&found_m_s, number);
        if let Some(set) = maneuver.thrusters {
            let mass_kg = self.flight.current_mass_panels_stowed.mass_kg;
            self.at_once(time_s).delta_v(set, executed_m_s.norm(), mass_kg).map_err(refused)?;
        }
        let configuration = &self.flight.configuration;
        let moved = self.flight.propagator.maneuver(configuration, time_s, &executed_m_s);
        moved.map_err(|error| refused(error.into()))?;
        self.state.integrator.cut(time_s);
        self.state.integrator.push(&executed_m_s);
        self.state.maneuvers.count = self.state.maneuvers.count.saturating_add(1);
        self.state.maneuvers.last = Some((time_s, executed_m_s));
        let event = ThrusterEvent::Maneuver { time_s, requested_m_s: found_m_s, executed_m_s };
        self.move_center_of_mass(time_s);
        (self.flight.given.log)(&event);
        Ok(())
    }

    /// Executes the event of the timeline that is due.
    fn scheduled_event(&mut self, time_s: f64) -> Result<(), PlantError> {
        let configuration = &self.flight.configuration;
        let taken = self.state.last.pop_scheduled(&configuration.thruster_events);
        let Some(event) = taken else { return Ok(()) };
        if let Some(place_body_m) = event.center_of_mass_body_m {
            self.flight.propagator.center_of_mass.place(configuration, place_body_m);
            self.state.integrator.cut(time_s);
            self.flight.propagator.cut(self.flight.configuration, time_s);
            self.set_mass(time_s);
        }
        let events = &self.flight.configuration.thruster_events;
        let (maneuver, target) = (events.maneuver(&event), events.dump_target_body_n_m_s(&event));
        if let Some(maneuver) = maneuver {
            self.maneuver(time_s, &maneuver)?;
        }
        if let Some(target_body_n_m_s) = target {
            self.dump_to(time_s, target_body_n_m_s);
        }
        Ok(())
    }

    /// Executes the scheduled event at `time_s`, the end of a fork, without error, propellant and dump; returns its velocity change,
    /// EME2000, in m/s.
    pub(super) fn event_of_fork(&mut self, time_s: f64) -> Result<Vector3<f64>, PlantError> {
        let ConfiguredFlight { configuration, current_mass_panels_stowed, propagator, .. } = &mut self.flight;
        let taken = self.state.last.pop_scheduled(&configuration.thruster_events);
        let Some(event) = taken else { return Ok(Vector3::zeros()) };
        if let Some(place_body_m) = event.center_of_mass_body_m {
            let before = propagator.center_of_mass.mass_properties(configuration);
            propagator.center_of_mass.place(configuration, place_body_m);
            let after = propagator.center_of_mass.mass_properties(configuration);
            current_mass_panels_stowed.center_of_mass_body_m +=
                after.center_of_mass_body_m - before.center_of_mass_body_m;
            propagator.cut(configuration, time_s);
        }
        let Some(TimelineManeuver { delta_v_inertial_m_s, .. }) = event.maneuver else {
            return Ok(Vector3::zeros());
        };
        let moved = propagator.maneuver(configuration, time_s, &delta_v_inertial_m_s);
        moved.map_err(|error| PlantError::Maneuver { time_s, why: error.into() })?;
        Ok(delta_v_inertial_m_s)
    }

    /// Selects the Sun's direction where that is due, or anew where the momentum has changed since at that time.
    fn select_sun_direction(&mut self, time_s: f64) -> Result<(), PlantError> {
        let totals = self.state.integrator.totals(time_s);
        let convention = self.flight.configuration.momentum.convention;
        let momentum = StartMomentum::from_totals(&totals, convention);
        self.flight.select_sun_direction(&SunSelectionStart { time_s, totals, momentum, is_first: false })
    }

    /// Dumps as far as the tanks feed the thrusters: momentum, propellant, push and mass properties after it. A dump that nothing
    /// feeds is none.
    fn dump(&mut self, due: &DumpEvent) {
        let time_s = due.time_s;
        let mut dump = DumpAtOnce { event: *due, push_body_n_s: None };
        let mut pushed = None;
        if !self.flight.allocator.settings.thrusters.is_empty() {
            let mut plant = self.flight.plant();
            let instant = plant.instant(time_s);
            let mass = plant.mass_properties(&instant);
            let Some(given) = self.at_once(time_s).dump(due, &mass.center_of_mass_body_m) else { return };
            dump = given;
            let inertial_from_body = instant.law.frame.inertial_from_body;
            pushed =
                dump.push_body_n_s.map(|push_body_n_s| inertial_from_body * push_body_n_s / mass.mass_kg);
            self.state.dump_delta_v_inertial_m_s = pushed.unwrap_or_default();
        }
        self.state.integrator.dump(&mut self.flight.plant(), &dump.event);
        self.state.spacing.dumped(&dump.event);
        if let Some(delta_v_inertial_m_s) = &pushed {
            self.state.integrator.push(delta_v_inertial_m_s);
            let configuration = &*self.flight.configuration;
            self.flight.propagator.cut_with_jump(configuration, time_s, delta_v_inertial_m_s);
            self.flight.propagator.sources.cut(time_s);
        }
        self.move_center_of_mass(time_s);
        (self.flight.given.log)(&ThrusterEvent::Dump(dump.event));
    }

    /// Impulsive dumps and velocity changes at `time_s`.
    fn at_once(&mut self, time_s: f64) -> AtOnce<'_> {
        let ConfiguredFlight { thrusters, allocator, .. } = &mut self.flight;
        AtOnce { thrusters, allocator, time_s }
    }

    /// A thruster event is over: propellant is used, and the centre of mass is elsewhere, where that is simulated.
    fn move_center_of_mass(&mut self, time_s: f64) {
        let configuration = &self.flight.configuration;
        let events = [self.state.integrator.dumps().count, self.state.maneuvers.count].map(i32::unsigned_abs);
        let number: u64 = events.map(u64::from).iter().sum();
        let shift = configuration.thruster_events.shift_body_m(number.saturating_sub(1));
        if shift.is_some() {
            self.flight.propagator.center_of_mass.shift_body_m = shift;
            self.flight.propagator.cut(configuration, time_s);
        }
        self.set_mass(time_s);
    }

    /// Mass properties of what is left at `time_s`.
    fn set_mass(&mut self, time_s: f64) {
        let flight = &mut self.flight;
        let loaded = flight.propagator.center_of_mass.mass_properties(flight.configuration);
        *flight.current_mass_panels_stowed = flight.used_mass(&loaded, time_s);
    }
}
