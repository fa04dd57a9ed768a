//! A fork of a flight: the same spacecraft simulated on from a copy of its state, in an attitude that is followed ideally, nothing
//! of the flight changing.
//!
//! It has no dumps, scheduled ones neither. Of the events ahead it sees maneuvers, without their errors and propellant, and places of
//! the centre of mass.

use nalgebra::{Rotation3, Vector3};

use crate::guidance::timeline::TimelineManeuver;
use crate::loads::ForceTorque;
use crate::momentum::{MomentumIntegrator, Settings, Stop, StopTimes, Totals};
use crate::plant::disturbances::plant::Plant;
use crate::plant::disturbances::simulation_context::SimulationContext;
use crate::plant::motion::approaches::ClosestApproach;
use crate::plant::motion::geometry::Geometry;
use crate::plant::settings::configuration::AttitudeSource;
use crate::plant::settings::error::PlantError;
use crate::plant::settings::prepared_spacecraft::PreparedSpacecraft;
use crate::plant::settings::radiation_settings::RadiationSettings;
use crate::plant::settings::thruster_events::SchedulePlace;
use crate::plant::state::propagator_state::PropagatorState;
use crate::spacecraft::MassProperties;

/// Greatest last Chebyshev term of a forecast's totals, in N m s and m/s: far below any threshold.
const FORECAST_TOLERANCE: f64 = 1e-6;

/// Momentum at a time ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForecastMomentum {
    /// When, in s.
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

/// A fork. It borrows the configuration, which it changes for itself and restores when it is dropped: a step allocates nothing.
pub(crate) struct Fork<'f> {
    prepared: PreparedSpacecraft<'f>,
    context: &'f mut SimulationContext,
    propagator: PropagatorState,
    integrator: MomentumIntegrator,
    /// Applied from outside, with its rate.
    applied: [ForceTorque<f64>; 2],
    /// How far the schedule is over.
    scheduled: SchedulePlace,
    /// The last two waypoints.
    waypoints: [(Option<Waypoint>, PropagatorState); 2],
    flight: (AttitudeSource, Settings, RadiationSettings, MassProperties),
}

/// Time, schedule and mass of a fork at a checkpoint; its propagator is kept next to it.
#[derive(Clone, Copy, Debug)]
struct Waypoint {
    time_s: f64,
    scheduled: SchedulePlace,
    current_mass_panels_stowed: MassProperties,
}

impl<'f> Fork<'f> {
    /// Begins at a time in s in this attitude with these totals, where the flight is.
    pub(super) fn new(
        prepared: PreparedSpacecraft<'f>,
        context: &'f mut SimulationContext,
        propagator: &PropagatorState,
        (attitude, applied): (AttitudeSource, [ForceTorque<f64>; 2]),
        (time_s, totals): (f64, Totals),
    ) -> Self {
        let [mut own, first, second] = core::mem::take(&mut context.fork_scratch);
        own.copy_from(propagator);
        let configuration = &mut context.configuration;
        let attitude = core::mem::replace(&mut configuration.attitude, attitude);
        let flight = (
            attitude,
            configuration.momentum,
            configuration.light_and_heat,
            context.current_mass_panels_stowed,
        );
        // Those of this time are over.
        let scheduled = SchedulePlace::until(time_s);
        let integrator = MomentumIntegrator::new(time_s, totals);
        let waypoints = [(None, first), (None, second)];
        Self { prepared, context, propagator: own, integrator, applied, scheduled, waypoints, flight }
    }

    /// Discards what the flight computed ahead of `time_s`, where other loads begin to act.
    pub(super) fn cut(&mut self, time_s: f64) {
        self.propagator.cut(&self.context.configuration, time_s, true);
    }

    /// Is evaluated about every `step_s` from a time in s on, without dumps; tolerances shorten what is too coarse.
    pub(super) fn coarsen(&mut self, time_s: f64, step_s: f64) {
        let configuration = &mut self.context.configuration;
        configuration.momentum.grid_s = configuration.momentum.grid_s.max(step_s);
        configuration.light_and_heat.grid_s = configuration.light_and_heat.grid_s.max(step_s);
        configuration.momentum.tolerance = configuration.momentum.tolerance.max(FORECAST_TOLERANCE);
        configuration.momentum.policy.threshold_body_n_m_s = Vector3::repeat(f64::INFINITY);
        self.cut(time_s);
    }

    /// Advances until everything is known at `time_s`.
    ///
    /// # Errors
    /// What ends a flight.
    pub(super) fn advance(&mut self, time_s: f64) -> Result<(), PlantError> {
        let settings = self.context.configuration.momentum;
        loop {
            let scheduled_s = self.context.configuration.thruster_events.next_s(self.scheduled);
            let external = |_: f64| self.applied;
            let mut plant = Plant::new(self.prepared, self.context, &mut self.propagator, &external);
            let times = StopTimes { scheduled_s, dumped_s: None };
            match self.integrator.advance_to_stop(&mut plant, &settings, time_s, times)? {
                Stop::Scheduled { at_s } => {
                    self.integrator.cut(at_s);
                    let delta_v_inertial_m_s = self.apply_event(at_s)?;
                    self.integrator.push(&delta_v_inertial_m_s);
                }
                // No threshold, and nothing is chosen.
                Stop::Reached | Stop::Dump(_) | Stop::Choice { .. } => return Ok(()),
            }
        }
    }

    /// Advances the orbit alone from `time_s`, where the fork has come: to the next event, which is over then, or as far as the
    /// orbit is known there, at most to `limit_s`; gives how far it came.
    ///
    /// # Errors
    /// What ends a flight.
    pub(super) fn advance_orbit(&mut self, time_s: f64, limit_s: f64) -> Result<f64, PlantError> {
        let scheduled_s = self.context.configuration.thruster_events.next_s(self.scheduled);
        let external = |_: f64| self.applied;
        let mut plant = Plant::new(self.prepared, self.context, &mut self.propagator, &external);
        let until_s = plant.orbit_and_light(time_s)?.min(limit_s);
        if scheduled_s <= until_s {
            self.apply_event(scheduled_s)?;
        }
        Ok(until_s.min(scheduled_s))
    }

    /// The time at an epoch in s past J2000 TDB, in s.
    pub(super) fn time_at_epoch_s(&self, epoch_s: f64) -> f64 {
        epoch_s - self.context.configuration.epoch_minus_time_s
    }

    /// Keeps `time_s`, where the fork has come, as a waypoint if the last one is more than `apart_s` back.
    pub(super) fn checkpoint(&mut self, time_s: f64, apart_s: f64) {
        if matches!(&self.waypoints[1].0, Some(last) if time_s - last.time_s <= apart_s) {
            return;
        }
        self.waypoints.swap(0, 1);
        let (waypoint, propagator) = &mut self.waypoints[1];
        propagator.copy_from(&self.propagator);
        *waypoint = Some(Waypoint {
            time_s,
            scheduled: self.scheduled,
            current_mass_panels_stowed: self.context.current_mass_panels_stowed,
        });
    }

    /// Goes back to the last waypoint up to `time_s` and gives its time; `None` without one.
    pub(super) fn restore(&mut self, time_s: f64) -> Option<f64> {
        let is_up_to = |waypoint: &Option<Waypoint>| waypoint.is_some_and(|it| it.time_s <= time_s);
        let (waypoint, propagator) = self.waypoints.iter_mut().rfind(|(waypoint, _)| is_up_to(waypoint))?;
        core::mem::swap(&mut self.propagator, propagator);
        let Waypoint { time_s, scheduled, current_mass_panels_stowed } = waypoint.take()?;
        (self.scheduled, self.context.current_mass_panels_stowed) = (scheduled, current_mass_panels_stowed);
        Some(time_s)
    }

    /// Executes the scheduled event at `time_s`, the end of the fork; returns its velocity change, EME2000, in m/s.
    fn apply_event(&mut self, time_s: f64) -> Result<Vector3<f64>, PlantError> {
        let Self { context, propagator, .. } = self;
        let configuration = &context.configuration;
        let next = configuration.thruster_events.next(self.scheduled).copied();
        let Some(event) = next else { return Ok(Vector3::zeros()) };
        self.scheduled.take(configuration.thruster_events.time_s(&event));
        if let Some(place_body_m) = event.center_of_mass_body_m {
            let before = propagator.center_of_mass.mass_properties(configuration);
            propagator.center_of_mass.place(configuration, place_body_m);
            let after = propagator.center_of_mass.mass_properties(configuration);
            context.current_mass_panels_stowed.center_of_mass_body_m +=
                after.center_of_mass_body_m - before.center_of_mass_body_m;
            propagator.cut(configuration, time_s, true);
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
        self.propagator.trajectory.approach_after(time_s)
    }

    /// Sun, planet and Earth at `time_s` as the spacecraft sees them, where the orbit is known.
    pub(super) fn geometry_at(&mut self, time_s: f64) -> Geometry {
        let SimulationContext { configuration, ephemeris, .. } = &mut *self.context;
        let spacecraft = self.propagator.trajectory.state_at(configuration, time_s);
        Geometry::at(configuration, ephemeris, time_s, spacecraft)
    }

    /// Momentum and geometry at `time_s`, where the fork has come.
    pub(super) fn momentum_at(&mut self, time_s: f64) -> ForecastMomentum {
        let external = |_: f64| self.applied;
        let mut plant = Plant::new(self.prepared, self.context, &mut self.propagator, &external);
        let instant = plant.instant(time_s);
        let pressure_pa = plant.kinematics.configuration.light.pressure_pa(instant.sun_distance_m);
        let convention = plant.kinematics.configuration.momentum.convention;
        let (totals, inertial_from_body) = (self.integrator.totals(time_s), instant.frame.inertial_from_body);
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

impl Drop for Fork<'_> {
    fn drop(&mut self) {
        let [(_, first), (_, second)] = &mut self.waypoints;
        self.context.fork_scratch = [&mut self.propagator, first, second].map(core::mem::take);
        let configuration = &mut self.context.configuration;
        (
            configuration.attitude,
            configuration.momentum,
            configuration.light_and_heat,
            self.context.current_mass_panels_stowed,
        ) = self.flight;
    }
}
