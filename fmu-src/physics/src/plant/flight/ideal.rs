//! Flight in an attitude that is followed ideally: momentum, dumps whose thrusters take propellant and push at once, and maneuvers.
//!
//! Equations of a dump: t = S dH by the thrusters' selection S; dv = sum F t / m; du = sum q t from each tank, nominal thrust and no
//! shortest pulse. Centre of mass and inertia are those with the remaining propellant from there on. Where no thrusters give torque
//! both ways about each axis through the centre of mass a dump is as one of a spacecraft without thrusters.
//! A maneuver is an impulse through the centre of mass: the velocity jumps and the momentum stays
//! ([`crate::plant::settings::thruster_events`]).

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::attitude::Attitude;
use crate::momentum::{DumpEvent, DumpSpacing, MomentumIntegrator, Stop, StopTimes, TorqueModel, Totals};

use super::configured::ConfiguredFlight;
use super::downlink_forecast::StartMomentum;
use crate::plant::settings::dynamics_settings::DynamicsInputs;
use crate::plant::settings::error::{ManeuverError, PlantError};
use crate::plant::settings::thruster_events::{Maneuver, SchedulePlace, ThrusterEvent};
use crate::plant::thrusters::at_once::DumpAtOnce;

/// Maneuvers so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Maneuvers {
    /// How many.
    pub count: i32,
    /// When the last one was, in s, and the delta-v that it executed, EME2000, in m/s.
    pub last: Option<(f64, Vector3<f64>)>,
}

/// Momentum, dumps and maneuvers of a flight in an attitude that is followed ideally.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct IdealFlight {
    /// Momentum and velocity change so far.
    pub integrator: MomentumIntegrator,
    /// Time between dumps.
    pub spacing: DumpSpacing,
    /// Velocity change of the last dump, EME2000, in m/s.
    pub dump_delta_v_inertial_m_s: Vector3<f64>,
    /// Maneuvers so far.
    pub maneuvers: Maneuvers,
    /// How far the schedule is over.
    pub scheduled: SchedulePlace,
}

impl IdealFlight {
    /// From `time_s` on with these totals, the quaternion continuing that of `attitude`; what the schedule has before is over.
    pub(super) fn new(time_s: f64, attitude: &Attitude, totals: Totals) -> Self {
        Self {
            integrator: MomentumIntegrator::after(time_s, attitude.unit_quaternion(), totals),
            spacing: DumpSpacing::default(),
            dump_delta_v_inertial_m_s: Vector3::zeros(),
            maneuvers: Maneuvers::default(),
            scheduled: SchedulePlace::before(time_s),
        }
    }

    /// Whether a simulation can produce it.
    pub(super) fn is_valid(&self) -> bool {
        self.integrator.is_valid() && self.spacing.is_valid() && self.maneuvers.count >= 0
    }

    /// At the start of a flight in the attitude after `held`, where the system has this momentum from the wheels' bias, body frame,
    /// in N m s.
    pub(super) fn begin(
        flight: &mut ConfiguredFlight<'_>,
        time_s: f64,
        held: &Attitude,
        from_bias_n_m_s: Vector3<f64>,
    ) -> Result<Self, PlantError> {
        let bias_body_n_m_s = flight.context.configuration.momentum.policy.bias_body_n_m_s;
        let momentum_body_n_m_s = bias_body_n_m_s + from_bias_n_m_s;
        flight.context.begin_work(flight.given.work_limit);
        let frame = flight.plant().instant(time_s).frame;
        let totals = Totals::at_start(momentum_body_n_m_s, &frame.inertial_from_body);
        flight.select_sun_direction(time_s, &totals, StartMomentum::Body(momentum_body_n_m_s), true)?;
        flight.context.begin_work(flight.given.work_limit);
        let mut plant = flight.plant();
        plant.prepare(time_s, time_s)?;
        let frame = plant.instant(time_s).frame;
        let totals = Totals::at_start(momentum_body_n_m_s, &frame.inertial_from_body);
        let mut begun = Self::new(time_s, held, totals);
        flight.context.begin_work(flight.given.work_limit);
        flight.propagator.panel_turns.restart();
        begun.advance(flight, time_s)?;
        Ok(begun)
    }

    /// Applies the requests of a step from `start_s` on: a maneuver, a dump.
    pub(super) fn apply_requests(
        &mut self,
        flight: &mut ConfiguredFlight<'_>,
        inputs: &DynamicsInputs,
        start_s: f64,
    ) -> Result<(), PlantError> {
        let mut target = inputs.dump_to_body_n_m_s;
        if let Some(maneuver) = &inputs.maneuver {
            self.maneuver(flight, start_s, maneuver)?;
            let requested = flight.context.configuration.thruster_events.requested_body_n_m_s;
            target = target.or(maneuver.dumps.then_some(requested));
        }
        if let Some(target_body_n_m_s) = target {
            self.dump_to(flight, start_s, target_body_n_m_s);
        }
        Ok(())
    }

    /// Dumps to this momentum, body frame, from the wheels' bias, in N m s, at `time_s` on request.
    fn dump_to(&mut self, flight: &mut ConfiguredFlight<'_>, time_s: f64, target_body_n_m_s: Vector3<f64>) {
        let settings = flight.context.configuration.momentum;
        let target_body_n_m_s = settings.policy.bias_body_n_m_s + target_body_n_m_s;
        let event = self.integrator.request(&mut flight.plant(), &settings, time_s, target_body_n_m_s);
        self.dump(flight, &event);
    }

    /// The maneuver, at `time_s`.
    fn maneuver(
        &mut self,
        flight: &mut ConfiguredFlight<'_>,
        time_s: f64,
        maneuver: &Maneuver,
    ) -> Result<(), PlantError> {
        let refused = |why: ManeuverError| PlantError::Maneuver { time_s, why };
        let found_m_s = maneuver.delta_v_inertial_m_s;
        if !found_m_s.iter().all(|it| it.is_finite()) {
            return Err(refused(ManeuverError::NotFinite { found_m_s: found_m_s.into() }));
        }
        let configuration = &flight.context.configuration;
        let number = u64::from(self.maneuvers.count.unsigned_abs());
        let executed_m_s = configuration.thruster_events.executed_m_s(&found_m_s, number);
        if let Some(set) = maneuver.thrusters {
            let mass_kg = flight.context.current_mass_panels_stowed.mass_kg;
            let given = flight.thrusters.at_once(&mut flight.context.allocator, time_s).delta_v(
                set,
                executed_m_s.norm(),
                mass_kg,
            );
            given.map_err(refused)?;
        }
        let moved = flight.propagator.maneuver(configuration, time_s, &executed_m_s);
        moved.map_err(|error| refused(error.into()))?;
        self.integrator.cut(time_s);
        self.integrator.push(&executed_m_s);
        self.maneuvers.count = self.maneuvers.count.saturating_add(1);
        self.maneuvers.last = Some((time_s, executed_m_s));
        let event = ThrusterEvent::Maneuver { time_s, requested_m_s: found_m_s, executed_m_s };
        self.move_center_of_mass(flight, time_s);
        self.set_mass(flight, time_s);
        (flight.log)(&event);
        Ok(())
    }

    /// Executes the scheduled event at `time_s`, the end of the integrated momentum.
    fn scheduled_event(&mut self, flight: &mut ConfiguredFlight<'_>, time_s: f64) -> Result<(), PlantError> {
        let configuration = &flight.context.configuration;
        let Some(event) = configuration.thruster_events.next(self.scheduled).copied() else { return Ok(()) };
        self.scheduled.take(configuration.thruster_events.time_s(&event));
        if let Some(place_body_m) = event.center_of_mass_body_m {
            flight.propagator.center_of_mass.place(configuration, place_body_m);
            self.integrator.cut(time_s);
            flight.propagator.cut(&flight.context.configuration, time_s, true);
            self.set_mass(flight, time_s);
        }
        let events = &flight.context.configuration.thruster_events;
        let (maneuver, target) = (events.maneuver(&event), events.dump_target_body_n_m_s(&event));
        if let Some(maneuver) = maneuver {
            self.maneuver(flight, time_s, &maneuver)?;
        }
        if let Some(target_body_n_m_s) = target {
            self.dump_to(flight, time_s, target_body_n_m_s);
        }
        Ok(())
    }

    /// Advances until the momentum is known at `time_s`, within the work that has begun.
    pub(super) fn advance(
        &mut self,
        flight: &mut ConfiguredFlight<'_>,
        time_s: f64,
    ) -> Result<(), PlantError> {
        let settings = flight.context.configuration.momentum;
        let mut dumped_s = None;
        loop {
            let scheduled_s = flight.context.configuration.thruster_events.next_s(self.scheduled);
            let times = StopTimes { scheduled_s, dumped_s };
            let stop = self.integrator.advance_to_stop(&mut flight.plant(), &settings, time_s, times)?;
            let at_s = match stop {
                Stop::Reached => return Ok(()),
                Stop::Choice { at_s } => at_s,
                Stop::Scheduled { at_s } => {
                    self.scheduled_event(flight, at_s)?;
                    at_s
                }
                Stop::Dump(event) => {
                    self.dump(flight, &event);
                    self.integrator.dumps().check()?;
                    dumped_s = Some(event.time_s);
                    event.time_s
                }
            };
            let totals = self.integrator.totals(at_s);
            let momentum = StartMomentum::from_totals(&totals, settings.convention);
            flight.select_sun_direction(at_s, &totals, momentum, false)?;
        }
    }

    /// Dumps as far as the tanks feed the thrusters: momentum, propellant, push and mass properties after it. A dump that nothing
    /// feeds is none.
    fn dump(&mut self, flight: &mut ConfiguredFlight<'_>, due: &DumpEvent) {
        let time_s = due.time_s;
        let mut dump = DumpAtOnce { event: *due, push_body_n_s: None };
        let mut pushed = None;
        if !flight.context.allocator.settings.thrusters.is_empty() {
            let mut plant = flight.plant();
            let instant = plant.instant(time_s);
            let mass = plant.mass_properties(&instant, time_s);
            let mut at_once = flight.thrusters.at_once(&mut flight.context.allocator, time_s);
            let given = at_once.dump(due, &mass.center_of_mass_body_m);
            let Some(given) = given else { return };
            dump = given;
            let inertial_from_body = instant.frame.inertial_from_body;
            pushed =
                dump.push_body_n_s.map(|push_body_n_s| inertial_from_body * push_body_n_s / mass.mass_kg);
            self.dump_delta_v_inertial_m_s = pushed.unwrap_or_default();
        }
        self.integrator.dump(&mut flight.plant(), &dump.event);
        self.spacing.dumped(&dump.event);
        if let Some(delta_v_inertial_m_s) = &pushed {
            self.integrator.push(delta_v_inertial_m_s);
            self.set_mass(flight, time_s);
            flight.propagator.cut_with_jump(
                &flight.context.configuration,
                time_s,
                true,
                delta_v_inertial_m_s,
            );
        }
        if self.move_center_of_mass(flight, time_s) {
            self.set_mass(flight, time_s);
        }
        (flight.log)(&ThrusterEvent::Dump(dump.event));
    }

    /// A thruster event is over: the centre of mass is elsewhere, where that is simulated.
    fn move_center_of_mass(&mut self, flight: &mut ConfiguredFlight<'_>, time_s: f64) -> bool {
        let configuration = &flight.context.configuration;
        let events = [self.integrator.dumps().count, self.maneuvers.count].map(i32::unsigned_abs);
        let number: u64 = events.map(u64::from).iter().sum();
        let shift = configuration.thruster_events.shift_body_m(number.saturating_sub(1));
        if shift.is_some() {
            flight.propagator.center_of_mass.shift_body_m = shift;
            flight.propagator.cut(configuration, time_s, true);
        }
        shift.is_some()
    }

    /// Mass properties of what is left at `time_s`.
    fn set_mass(&self, flight: &mut ConfiguredFlight<'_>, time_s: f64) {
        let loaded = flight.propagator.center_of_mass.mass_properties(&flight.context.configuration);
        flight.context.current_mass_panels_stowed = flight.used_mass(&loaded, time_s).unwrap_or(loaded);
    }
}
