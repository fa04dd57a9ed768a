//! A fork of a flight: the same spacecraft simulated on from a copy of its state, in an attitude that is followed ideally, nothing
//! of the flight changing.
//!
//! It has no dumps, scheduled ones neither. Of the events ahead it sees maneuvers, without their errors and propellant, and places of
//! the centre of mass.

use nalgebra::{Rotation3, Vector3};

use crate::guidance::SelectedSunDirections;
use crate::guidance::timeline::TimelineManeuver;
use crate::loads::ForceTorque;
use crate::momentum::{MomentumIntegrator, TorqueModel, Totals, WorkKind};
use crate::plant::disturbances::evaluation::External;
use crate::plant::disturbances::plant::{Plant, PlantSettings};
use crate::plant::disturbances::simulation_context::{ForkScratch, SimulationContext};
use crate::plant::disturbances::simulation_models::SimulationModels;
use crate::plant::events::{EventKind, Eventful, LastEvents};
use crate::plant::motion::approaches::ClosestApproach;
use crate::plant::motion::geometry::{Geometry, SimulationEphemeris};
use crate::plant::settings::attitude_source::{AttitudeSource, Turning};
use crate::plant::settings::configuration::Configuration;
use crate::plant::settings::error::PlantError;
use crate::plant::settings::prepared_spacecraft::PreparedSpacecraft;
use crate::plant::settings::thruster_events::LastEvent;
use crate::plant::state::propagator_state::PropagatorState;
use crate::spacecraft::MassProperties;

/// Greatest last Chebyshev term of a forecast's totals, in N m s and m/s: far below any threshold.
const FORECAST_TOLERANCE: f64 = 1e-6;

/// Momentum at a time ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForecastMomentum {
    /// Time at which the fork begins, in s.
    pub time_s: f64,
    /// Whether a downlink lasts then.
    pub downlink: bool,
    /// Unit vector to the Sun, EME2000.
    pub to_sun: Vector3<f64>,
    /// Unit vector to the Earth, EME2000; `None` where its place is not known.
    pub to_earth: Option<Vector3<f64>>,
    /// Pressure of sunlight, in Pa, without a shadow.
    pub pressure_pa: f64,
    /// By the flight's convention, body frame, in N m s.
    pub momentum_body_n_m_s: Vector3<f64>,
    /// The whole, EME2000, in N m s.
    pub momentum_inertial_n_m_s: Vector3<f64>,
    /// Components in the body frame of a vector in EME2000.
    pub body_from_inertial: Rotation3<f64>,
}

/// Flight from which a fork begins.
pub(super) struct ForkOrigin<'f> {
    pub prepared: PreparedSpacecraft<'f>,
    pub context: &'f mut SimulationContext,
    pub propagator: &'f PropagatorState,
    /// Applied from outside; the fork holds it.
    pub applied: ForceTorque<f64>,
}

/// A fork: copies of settings and state, which it changes for itself, and the flight's models.
pub(crate) struct Fork<'f> {
    prepared: PreparedSpacecraft<'f>,
    models: &'f mut SimulationModels,
    configuration: &'f mut Configuration,
    current_mass_panels_stowed: MassProperties,
    propagator: &'f mut PropagatorState,
    integrator: MomentumIntegrator,
    /// Applied from outside, with its rate.
    applied: [ForceTorque<f64>; 2],
    /// The last event of each kind.
    last: LastEvents,
    /// The last two waypoints.
    waypoints: [(Option<Waypoint>, &'f mut PropagatorState); 2],
}

/// Time, events and mass of a fork at a checkpoint; its propagator is kept next to it.
#[derive(Clone, Debug)]
struct Waypoint {
    time_s: f64,
    last: LastEvents,
    current_mass_panels_stowed: MassProperties,
}

impl Eventful for Fork<'_> {
    fn last(&mut self) -> &mut LastEvents {
        &mut self.last
    }

    fn reached_s(&self) -> f64 {
        self.integrator.end_s()
    }

    fn ends_by(&self, limit_s: f64) -> bool {
        self.integrator.ends_by(limit_s)
    }

    fn next_event_s(&self, kind: EventKind) -> f64 {
        match kind {
            EventKind::Schedule => self.configuration.thruster_events.next_s(self.last.scheduled()),
            _ => f64::INFINITY,
        }
    }

    fn is_due(&mut self, kind: EventKind) -> Result<bool, PlantError> {
        Ok(self.next_event_s(kind) <= self.reached_s())
    }

    fn spend(&mut self, kind: Option<EventKind>) -> Result<(), PlantError> {
        let (time_s, applied) = (self.reached_s(), self.applied);
        match kind {
            Some(_) => self.plant(&|_| applied).0.spend(WorkKind::Dump, time_s),
            None => Ok(()),
        }
    }

    fn apply_event(&mut self, _kind: EventKind) -> Result<(), PlantError> {
        let time_s = self.reached_s();
        self.integrator.cut(time_s);
        let delta_v_inertial_m_s = self.scheduled_event(time_s)?;
        self.integrator.push(&delta_v_inertial_m_s);
        Ok(())
    }

    fn advance_segment(&mut self, limit_s: f64) -> Result<(), PlantError> {
        let (settings, applied) = (self.configuration.momentum, self.applied);
        let external = |_: f64| applied;
        let (mut plant, integrator) = self.plant(&external);
        let prepared = integrator.prepare(&mut plant, &settings, limit_s)?;
        integrator.advance_segment(&mut plant, &settings, &prepared)
    }
}

impl<'f> Fork<'f> {
    /// Begins at `time_s`, where the flight is, in this attitude.
    pub(super) fn new(
        flight: &'f mut ForkOrigin<'_>,
        attitude: AttitudeSource,
        totals: Totals,
        time_s: f64,
    ) -> Self {
        let SimulationContext { configuration, current_mass_panels_stowed, models, fork, .. } =
            &mut *flight.context;
        let ForkScratch { configuration: own_configuration, states: [propagator, first, second] } =
            &mut **fork;
        own_configuration.copy_from(configuration);
        own_configuration.attitude = attitude;
        propagator.copy_from(flight.propagator);
        let mut last = LastEvents::before(time_s);
        // Those of this time are over.
        *last.of_kind(EventKind::Schedule) = LastEvent::until(time_s);
        Self {
            prepared: flight.prepared,
            models,
            configuration: own_configuration,
            current_mass_panels_stowed: *current_mass_panels_stowed,
            propagator,
            integrator: MomentumIntegrator::new(time_s, totals),
            applied: [flight.applied, ForceTorque::zero()],
            last,
            waypoints: [(None, first), (None, second)],
        }
    }

    /// Discards what the flight computed ahead of `time_s`, where other loads begin to act.
    pub(super) fn cut(&mut self, time_s: f64) {
        self.propagator.cut(self.configuration, time_s);
    }

    /// Takes default attitudes: no direction of the Sun was selected.
    pub(super) fn deselect_sun_directions(&mut self) {
        self.propagator.sun_choice.selected = SelectedSunDirections::default();
    }

    /// Is evaluated about every `step_s` from a time in s on, without dumps; tolerances shorten what is too coarse.
    pub(super) fn coarsen(&mut self, time_s: f64, step_s: f64) {
        let configuration = &mut *self.configuration;
        configuration.momentum.grid_s = configuration.momentum.grid_s.max(step_s);
        configuration.light_and_heat.grid_s = configuration.light_and_heat.grid_s.max(step_s);
        configuration.momentum.tolerance = configuration.momentum.tolerance.max(FORECAST_TOLERANCE);
        configuration.momentum.policy.threshold_body_n_m_s = Vector3::repeat(f64::INFINITY);
        self.cut(time_s);
    }

    /// Advances the orbit alone from `time_s`, where the fork has come: to the next event, which is over then, or as far as the
    /// orbit is known there, at most to `limit_s`; gives how far it came.
    ///
    /// # Errors
    /// What ends a flight.
    pub(super) fn advance_orbit(&mut self, time_s: f64, limit_s: f64) -> Result<f64, PlantError> {
        let scheduled_s = self.next_event_s(EventKind::Schedule);
        let applied = self.applied;
        let external = |_: f64| applied;
        let (mut plant, _) = self.plant(&external);
        let until_s = plant.orbit_and_light(time_s)?.min(limit_s);
        if scheduled_s <= until_s {
            self.scheduled_event(scheduled_s)?;
        }
        Ok(until_s.min(scheduled_s))
    }

    /// The time at an epoch in s past J2000 TDB, in s.
    pub(super) fn time_at_epoch_s(&self, epoch_s: f64) -> f64 {
        epoch_s - self.configuration.epoch_minus_time_s
    }

    /// Keeps `time_s`, where the fork has come, as a waypoint if the last one is more than `apart_s` back.
    pub(super) fn checkpoint(&mut self, time_s: f64, apart_s: f64) {
        if matches!(&self.waypoints[1].0, Some(last) if time_s - last.time_s <= apart_s) {
            return;
        }
        self.waypoints.swap(0, 1);
        let (waypoint, propagator) = &mut self.waypoints[1];
        propagator.copy_from(self.propagator);
        *waypoint = Some(Waypoint {
            time_s,
            last: self.last.clone(),
            current_mass_panels_stowed: self.current_mass_panels_stowed,
        });
    }

    /// Goes back to the last waypoint up to `time_s` and gives its time; `None` without one.
    pub(super) fn restore(&mut self, time_s: f64) -> Option<f64> {
        let is_up_to = |waypoint: &Option<Waypoint>| waypoint.as_ref().is_some_and(|it| it.time_s <= time_s);
        let (waypoint, propagator) = self.waypoints.iter_mut().rfind(|(waypoint, _)| is_up_to(waypoint))?;
        core::mem::swap(self.propagator, *propagator);
        let Waypoint { time_s, last, current_mass_panels_stowed } = waypoint.take()?;
        (self.last, self.current_mass_panels_stowed) = (last, current_mass_panels_stowed);
        Some(time_s)
    }

    /// The plant of the fork, and what integrates its momentum.
    fn plant<'a>(&'a mut self, external: &'a External<'a>) -> (Plant<'a>, &'a mut MomentumIntegrator) {
        let Self { prepared, models, configuration, current_mass_panels_stowed, propagator, .. } = self;
        let (current_mass_panels_stowed, turning) = (*current_mass_panels_stowed, Turning::still());
        let settings = PlantSettings { configuration, current_mass_panels_stowed, turning };
        (Plant::new(*prepared, settings, models, propagator, external), &mut self.integrator)
    }

    /// Executes the scheduled event at `time_s`, the end of the fork; returns its velocity change, EME2000, in m/s.
    fn scheduled_event(&mut self, time_s: f64) -> Result<Vector3<f64>, PlantError> {
        let Self { configuration, current_mass_panels_stowed, propagator, last, .. } = self;
        let taken = last.pop_scheduled(&configuration.thruster_events);
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

    /// The closest approach to the encounter's body beyond `time_s`, as far as the orbit is known.
    pub(super) fn approach_after(&self, time_s: f64) -> Option<ClosestApproach> {
        self.propagator.trajectory.approaches.after(time_s)
    }

    /// Sun, planet and Earth at `time_s` as the spacecraft sees them, where the orbit is known.
    pub(super) fn geometry_at(&mut self, time_s: f64) -> Geometry {
        let spacecraft = self.propagator.trajectory.state_at(self.configuration, time_s);
        let (configuration, ephemeris) = (&*self.configuration, &mut self.models.ephemeris);
        SimulationEphemeris { configuration, ephemeris }.geometry(time_s, spacecraft)
    }

    /// Momentum and geometry at `time_s`, where the fork has come.
    pub(super) fn momentum_at(&mut self, time_s: f64) -> ForecastMomentum {
        let applied = self.applied;
        let external = |_: f64| applied;
        let (mut plant, integrator) = self.plant(&external);
        let instant = plant.instant(time_s);
        let pressure_pa = plant.path.kinematics.configuration.light.pressure_pa(instant.sun_distance_m);
        let convention = plant.path.kinematics.configuration.momentum.convention;
        let (totals, inertial_from_body) = (integrator.totals(time_s), instant.frame.inertial_from_body);
        ForecastMomentum {
            time_s,
            downlink: instant.regime.downlink,
            to_sun: instant.geometry.to_sun.position_m.normalize(),
            to_earth: instant.geometry.to_earth.position_m.try_normalize(0.0),
            pressure_pa,
            momentum_body_n_m_s: totals.momentum_body_n_m_s(convention, &inertial_from_body),
            momentum_inertial_n_m_s: totals.momentum_inertial_n_m_s,
            body_from_inertial: inertial_from_body.inverse(),
        }
    }
}
