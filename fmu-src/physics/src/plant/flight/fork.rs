//! A fork of a flight: the same spacecraft simulated on from a copy of its state, in an attitude that is followed ideally, nothing
//! of the flight changing.
//!
//! It has no dumps, scheduled ones neither. Of the events ahead it sees maneuvers, without their errors and propellant, and places of
//! the centre of mass.

use nalgebra::{Rotation3, Vector3};

use super::configured::{ConfiguredFlight, DownlinkForecast, StepContext, SunSelectionStart};
use super::ideal::Ideal;
use crate::attitude::{Attitude, Quaternion};
use crate::guidance::{Guided, SelectedSunDirections};
use crate::loads::ForceTorque;
use crate::momentum::Totals;
use crate::plant::disturbances::evaluation::External;
use crate::plant::disturbances::simulation_context::ForkScratch;
use crate::plant::events::{EventKind, Eventful, LastEvents};
use crate::plant::settings::attitude_source::{AttitudeSource, Turning};
use crate::plant::settings::configuration::Configuration;
use crate::plant::settings::error::PlantError;
use crate::plant::settings::thruster_events::LastEvent;
use crate::plant::state::ideal_state::IdealState;
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

/// Forecasts from `start` on the momentum at `times_s`, which do not descend; about `step_s` apart. The flight continues in default
/// attitudes (the Sun on -Y in downlinks and in science that unloads), without dumps, under the load that acts from outside there.
///
/// # Errors
/// What ends a flight.
pub fn forecast(
    start: &mut DownlinkForecast<'_, '_>,
    mut times_s: impl Iterator<Item = f64>,
    step_s: f64,
    mut visit: impl FnMut(ForecastMomentum),
) -> Result<(), PlantError> {
    let DownlinkForecast { flight, law, begin: SunSelectionStart { totals, time_s, .. }, .. } = start;
    let attitude = AttitudeSource::Guided(Guided { managed: false, ..*law });
    let [applied, _] = (flight.given.external)(*time_s);
    let held = |_: f64| [applied, ForceTorque::zero()];
    let mut fork = Fork::new(flight, &held, attitude, *totals, *time_s)?;
    // No direction of the Sun was selected.
    fork.ideal.flight.propagator.sun_choice.selected = SelectedSunDirections::default();
    fork.coarsen(*time_s, step_s);
    times_s.try_for_each(|at_s| {
        fork.ideal.advance(at_s)?;
        visit(fork.momentum_at(at_s));
        Ok(())
    })
}

/// A fork: copies of settings and state, which it changes for itself, and the flight's models.
pub(crate) struct Fork<'f> {
    pub(super) ideal: Ideal<'f>,
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

impl<'f> Fork<'f> {
    /// Begins at `time_s`, where the flight is, in this attitude, under the load `external` from outside.
    ///
    /// # Errors
    /// A fork of a fork.
    pub(super) fn new(
        flight: &'f mut ConfiguredFlight<'_>,
        external: &'f External<'f>,
        attitude: AttitudeSource,
        totals: Totals,
        time_s: f64,
    ) -> Result<Self, PlantError> {
        let scratch = flight.scratch.as_deref_mut().ok_or(PlantError::OtherMode)?;
        let ForkScratch { configuration, current_mass_panels_stowed, ideal, states } = scratch;
        let [propagator, first, second] = states;
        configuration.copy_from(flight.configuration);
        configuration.attitude = attitude;
        *current_mass_panels_stowed = *flight.current_mass_panels_stowed;
        propagator.copy_from(flight.propagator);
        let state = ideal.insert(IdealState::new(time_s, &Attitude::from_unit(Quaternion::IDENTITY), totals));
        // Those of this time are over.
        *state.last.of_kind(EventKind::Schedule) = LastEvent::until(time_s);
        let flight = ConfiguredFlight {
            given: StepContext { external, planner: &|_| Ok(None), log: &|_| {}, ..flight.given },
            configuration,
            current_mass_panels_stowed,
            models: flight.models,
            allocator: flight.allocator,
            scratch: None,
            propagator,
            thrusters: flight.thrusters,
            turning: Turning::still(),
        };
        let ideal = Ideal { state, flight, is_fork: true, prepared: None };
        Ok(Self { ideal, waypoints: [(None, first), (None, second)] })
    }

    /// Discards what the flight computed ahead of `time_s`, where other loads begin to act.
    pub(super) fn cut(&mut self, time_s: f64) {
        let ConfiguredFlight { propagator, configuration, .. } = &mut self.ideal.flight;
        propagator.cut(configuration, time_s);
    }

    /// Is evaluated about every `step_s` from a time in s on, without dumps; tolerances shorten what is too coarse.
    pub(super) fn coarsen(&mut self, time_s: f64, step_s: f64) {
        let configuration = &mut *self.ideal.flight.configuration;
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
        let scheduled_s = self.ideal.next_event_s(EventKind::Schedule);
        let until_s = self.ideal.flight.plant().orbit_and_light(time_s)?.min(limit_s);
        if scheduled_s <= until_s {
            self.ideal.event_of_fork(scheduled_s)?;
        }
        Ok(until_s.min(scheduled_s))
    }

    /// Keeps `time_s`, where the fork has come, as a waypoint if the last one is more than `apart_s` back.
    pub(super) fn checkpoint(&mut self, time_s: f64, apart_s: f64) {
        if matches!(&self.waypoints[1].0, Some(last) if time_s - last.time_s <= apart_s) {
            return;
        }
        self.waypoints.swap(0, 1);
        let (waypoint, propagator) = &mut self.waypoints[1];
        let Ideal { state, flight, .. } = &self.ideal;
        propagator.copy_from(flight.propagator);
        let current_mass_panels_stowed = *flight.current_mass_panels_stowed;
        *waypoint = Some(Waypoint { time_s, last: state.last.clone(), current_mass_panels_stowed });
    }

    /// Goes back to the last waypoint up to `time_s` and gives its time; `None` without one.
    pub(super) fn restore(&mut self, time_s: f64) -> Option<f64> {
        let is_up_to = |waypoint: &Option<Waypoint>| waypoint.as_ref().is_some_and(|it| it.time_s <= time_s);
        let (waypoint, propagator) = self.waypoints.iter_mut().rfind(|(waypoint, _)| is_up_to(waypoint))?;
        let Ideal { state, flight, .. } = &mut self.ideal;
        core::mem::swap(flight.propagator, *propagator);
        let Waypoint { time_s, last, current_mass_panels_stowed } = waypoint.take()?;
        (state.last, *flight.current_mass_panels_stowed) = (last, current_mass_panels_stowed);
        Some(time_s)
    }

    /// Momentum and geometry at `time_s`, where the fork has come.
    pub(super) fn momentum_at(&mut self, time_s: f64) -> ForecastMomentum {
        let instant = self.ideal.flight.plant().instant(time_s);
        let Configuration { light, momentum, .. } = &*self.ideal.flight.configuration;
        let totals = self.ideal.state.integrator.totals(time_s);
        let inertial_from_body = instant.law.frame.inertial_from_body;
        ForecastMomentum {
            time_s,
            downlink: instant.is_in_downlink(),
            to_sun: instant.geometry.to_sun.position_m.normalize(),
            to_earth: instant.geometry.to_earth.position_m.try_normalize(0.0),
            pressure_pa: light.pressure_pa(instant.sun_distance_m),
            momentum_body_n_m_s: totals.momentum_body_n_m_s(momentum.convention, &inertial_from_body),
            momentum_inertial_n_m_s: totals.momentum_inertial_n_m_s,
            body_from_inertial: inertial_from_body.inverse(),
        }
    }
}
