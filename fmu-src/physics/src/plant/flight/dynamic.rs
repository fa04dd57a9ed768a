//! Attitude dynamics of the plant: a rigid body with wheels under disturbances, sampled sensors, and either a controller that
//! tracks a command or wheel torques from outside.
//!
//! Sensors and controller are sampled at a fixed rate; motor torques hold over a sample. A sample at t belongs to the step
//! that begins at t and reads that step's inputs. Between two samples, edges of the disturbance grid, ends of dumps and
//! changes of inputs the motion is one [`crate::attitude::GyrostatMotion`] segment or a few; communication points only evaluate it.

use nalgebra::Vector3;

use crate::attitude::control::ControlTarget;
use crate::attitude::{Attitude, BodyMotion, MotionAt};
use crate::loads::{Effect, ForceTorque, Writer};
use crate::momentum::{DumpEvent, Totals, WorkKind};
use crate::numerics::Span;
use crate::plant::thrusters::reaction_control::Thrusters;

use super::configured::{ConfiguredFlight, StartMomentum, SunSelectionStart};
use super::grid_edge;
use super::reached::Reached;
use super::report::dynamic_totals;
use super::simulated::Simulated;
use crate::plant::control::control_loop::Sampled;
use crate::plant::control::wheel_control::WheelDistribution;
use crate::plant::disturbances::disturbance_interval::loads_at;
use crate::plant::disturbances::evaluation::Evaluation;
use crate::plant::events::{EventKind, Eventful, LastEvents};
use crate::plant::settings::attitude_source::{AttitudeSource, Command};
use crate::plant::settings::dynamics_settings::{DynamicsSettings, Tracked};
use crate::plant::settings::error::{ManeuverError, PlantError};
use crate::plant::settings::reaction_control_settings::Feed;
use crate::plant::settings::thruster_events::ThrusterEvent;
use crate::plant::sources::applied::APPLIED;
use crate::plant::sources::thrusters::THRUSTERS;
use crate::plant::state::dynamic_state::{DynamicState, tolerance_s};

/// Units of work of a segment of the motion with flexible modes, slosh or imbalance; one of a rigid body's is a unit.
const FLEXIBLE_UNITS: u32 = 8;

/// A flight by torque, in one step.
pub(super) struct Dynamic<'f> {
    /// State.
    pub state: &'f mut DynamicState,
    /// Settings; the gyrostat's mass properties are those of the current mass.
    pub settings: &'f mut DynamicsSettings,
    /// The flight that advances.
    pub flight: ConfiguredFlight<'f>,
    /// The distribution of torque over the wheels.
    pub distribution: &'f mut WheelDistribution,
    /// How far it has come.
    pub reached: Reached,
}

impl Eventful for Dynamic<'_> {
    fn last(&mut self) -> &mut LastEvents {
        &mut self.state.last
    }

    fn reached_s(&self) -> f64 {
        self.state.motion.end_s()
    }

    fn ends_by(&self, limit_s: f64) -> bool {
        self.state.motion.end_s() < limit_s - tolerance_s(limit_s)
    }

    fn next_event_s(&self, kind: EventKind) -> f64 {
        let Self { state, flight, .. } = self;
        match kind {
            EventKind::Valves => flight.thrusters.next_edge_s(&flight.allocator.settings),
            EventKind::DumpEnd => state.dumps.until_s(),
            EventKind::Grid => state.disturbance.span.end_s,
            EventKind::Schedule => flight.configuration.thruster_events.next_s(state.last.scheduled()),
            EventKind::Sample => state.sensing.next_s(),
            _ => f64::INFINITY,
        }
    }

    #[inline]
    fn is_due(&mut self, kind: EventKind) -> Result<bool, PlantError> {
        let time_s = self.reached_s();
        let comes_by = |next_s: f64| next_s < f64::INFINITY && next_s <= time_s + tolerance_s(time_s);
        let sampled = |it: &DynamicState| comes_by(it.sensing.next_s()) && !it.last.has_come(kind, time_s);
        Ok(match kind {
            // Every segment ends with these.
            EventKind::Accounts | EventKind::Valves | EventKind::Load => self.reached.is_next(kind),
            EventKind::SunDirection => sampled(self.state) && self.samples_guidance(time_s),
            EventKind::Threshold => sampled(self.state) && self.exceeds_threshold(),
            kind => comes_by(self.next_event_s(kind)),
        })
    }

    fn spend(&mut self, kind: Option<EventKind>) -> Result<(), PlantError> {
        if kind.is_some() {
            return Ok(());
        }
        let units = if self.settings.gyrostat.is_rigid() { 1 } else { FLEXIBLE_UNITS };
        let time_s = self.reached_s();
        Ok(self.flight.models.spend(WorkKind::Segment, units, time_s)?)
    }

    fn apply_event(&mut self, kind: EventKind) -> Result<(), PlantError> {
        let time_s = self.reached_s();
        if matches!(kind, EventKind::Accounts | EventKind::Valves | EventKind::Load) {
            self.reached.applied = Some(kind);
        }
        match kind {
            EventKind::Accounts => self.close_accounts(time_s),
            EventKind::Valves => self.process_valves(time_s),
            EventKind::DumpEnd => self.state.dumps.end(time_s + tolerance_s(time_s)),
            EventKind::Grid => {
                self.reached.at = None;
                self.complete();
                grid_edge::begin_interval(self.state, self.settings, &mut self.flight)?;
            }
            EventKind::Schedule => self.dump_as_scheduled()?,
            EventKind::SunDirection => self.select_sun_direction()?,
            EventKind::Threshold => {
                let policy = self.flight.configuration.momentum.policy;
                self.begin_dump(|before_body_n_m_s| policy.after(before_body_n_m_s));
                self.state.dumps.dumps.check()?;
            }
            EventKind::Sample => self.sample(),
            EventKind::Load => {
                if self.state.last.has_come(EventKind::Sample, time_s) {
                    self.process_valves(time_s);
                }
                self.update_load(time_s);
            }
        }
        Ok(())
    }

    fn advance_segment(&mut self, limit_s: f64) -> Result<(), PlantError> {
        let Self { state, settings, flight, reached, .. } = self;
        let time_s = state.motion.end_s();
        reached.applied = None;
        let end = reached.at(state, settings, time_s);
        let external = (flight.given.external)(time_s);
        let dipoles = flight.dipoles(time_s);
        let load = state.load(&external, &dipoles, flight.thrusters, flight.given.prepared.panels, time_s);
        state.dumps.begin_segment(&state.disturbance, &external, dipoles, time_s);
        let motors = &state.control.wheels.motors;
        state.motion.advance_from(end, &settings.gyrostat, motors, &load, limit_s);
        reached.at = None;
        flight.integrate_thrust(&state.motion, &state.disturbance, state.mass.now.mass_kg)
    }
}

impl<'f> Simulated<'f> for Dynamic<'f> {
    fn flight(&mut self) -> &mut ConfiguredFlight<'f> {
        &mut self.flight
    }

    /// The body has the mass properties of the present segment, and the whole spacecraft those of the last edge of the grid.
    fn resume(&mut self) {
        let Self { state, settings, flight, .. } = self;
        settings.set_mass_properties(&state.mass.now);
        *flight.current_mass_panels_stowed = state.mass.stowed.unwrap_or(flight.configuration.wet_mass);
    }

    fn apply_requests(&mut self, step: Span) -> Result<(), PlantError> {
        let (inputs, start_s) = (self.flight.given.inputs, step.start_s);
        if inputs.maneuver.is_some() {
            return Err(PlantError::Maneuver { time_s: start_s, why: ManeuverError::ByTorque });
        }
        if let Some(target_body_n_m_s) = inputs.dump_to_body_n_m_s {
            self.state.cut(start_s);
            self.dump_to(target_body_n_m_s);
        }
        let ConfiguredFlight { thrusters, allocator, .. } = &mut self.flight;
        let (settings, is_dumping) = (&allocator.settings, thrusters.is_dumping());
        let Thrusters { valves, propellant, .. } = &mut **thrusters;
        let pulses = valves.command_pulses(&settings.thrusters, &inputs.pulses, step, is_dumping);
        let feed = Feed { settings, propellant, time_s: start_s };
        if valves.command_thrust(&feed, &inputs.thrust) || pulses {
            self.state.cut(start_s);
        }
        Ok(())
    }

    /// The commanded attitude, followed ideally; without a command the present one, held.
    fn fork_attitude(&self, time_s: f64) -> Option<AttitudeSource> {
        let guided = self.flight.configuration.attitude.guided();
        Some(match (&self.settings.control, self.flight.given.inputs.tracked, guided) {
            (Some(_), Tracked::Guidance, Some(law)) => AttitudeSource::Guided(*law),
            (Some(_), Tracked::Attitude(command), _) => AttitudeSource::Commanded(command),
            _ => AttitudeSource::Commanded(Command {
                attitude: Attitude::from_unit(self.state.motion.attitude_at(time_s)),
                rate_body_rad_s: Vector3::zeros(),
                since_s: time_s,
            }),
        })
    }

    fn frame(&mut self, time_s: f64) -> Evaluation {
        self.resume();
        let body = self.at(time_s).body;
        let flight = &mut self.flight;
        let loaded = flight.configuration.wet_mass;
        *flight.current_mass_panels_stowed = flight.used_mass(&loaded, time_s);
        let mass_kg = loaded.mass_kg - flight.thrusters.propellant.total_used_kg(time_s);
        let mut evaluation = flight.plant_at(time_s, &body).evaluate_without_loads(time_s);
        evaluation.mass.mass_kg = mass_kg;
        evaluation.instant.law.degenerate = self.state.control.is_degenerate;
        evaluation
    }

    fn totals(&mut self, time_s: f64) -> Totals {
        dynamic_totals(&self.at(time_s))
    }

    /// As the motion integrates them.
    fn rows(&mut self, Evaluation { instant, loads, .. }: &mut Evaluation, applied: ForceTorque) {
        let MotionAt { time_s, body, .. } = self.at(instant.time_s);
        let Self { state, settings, flight, .. } = self;
        *loads = loads_at(&state.disturbance, &flight.dipoles(time_s), instant);
        for row in Effect::ALL {
            match row.row().writer {
                Writer::Source(_) => {}
                Writer::Rotors => {
                    let [torque_body_n_m, force_body_n] =
                        state.motion.imbalance_load(&settings.gyrostat, time_s, &body);
                    loads[row] = ForceTorque { force_body_n, torque_body_n_m };
                }
                Writer::Propellant => loads[row].torque_body_n_m = state.motion.swing_torque_n_m(time_s),
            }
        }
        loads[APPLIED] = applied;
        let thrusters = &flight.thrusters.load;
        loads[THRUSTERS] = ForceTorque {
            force_body_n: thrusters.law.force_at_n(time_s),
            torque_body_n_m: thrusters.torque_at_n_m(time_s, &body.rate_body_rad_s),
        };
    }

    fn complete(&mut self) {
        self.reached.complete(self.state, self.settings, self.flight.given.inputs);
    }
}

impl Dynamic<'_> {
    /// The motion at `time_s`, where it has come.
    pub(super) fn at(&mut self, time_s: f64) -> MotionAt {
        *self.reached.at(self.state, self.settings, time_s)
    }

    /// The motion at its end.
    fn end(&mut self) -> MotionAt {
        self.at(self.state.motion.end_s())
    }

    /// Closes the accounts of the segment that ends: momentum by effect, mass, impulse and propellant; and takes the wheels' inputs.
    fn close_accounts(&mut self, time_s: f64) {
        let Self { state, settings, flight, reached, .. } = self;
        let end = reached.at(state, settings, time_s);
        state.dumps.accumulate(&state.motion, end, state.dumps.is_dumping(flight.thrusters, time_s));
        let thruster_settings = &flight.allocator.settings;
        if !flight.thrusters.load.law.is_none() {
            let tanks = &thruster_settings.tanks;
            let mass = flight.thrusters.propellant.mass_properties_since(&state.mass.now, tanks, time_s);
            grid_edge::set_mass(state, settings, mass);
        }
        flight.thrusters.accumulate(thruster_settings, &state.motion, time_s);
        state.control.wheels.fail(&flight.given.inputs.wheel_failed);
        if settings.control.is_none() {
            state.control.wheels.drive(&settings.gyrostat, &flight.given.inputs.wheel_torques_n_m);
        }
    }

    /// Updates mass and the thrusters' load from the end of the motion on.
    fn update_load(&mut self, time_s: f64) {
        let Self { state, settings, flight, .. } = self;
        grid_edge::turn_mass(state, settings, flight);
        let used_kg = flight.thrusters.propellant.total_used_kg(time_s);
        state.mass.now.mass_kg = flight.configuration.wet_mass.mass_kg - used_kg;
        flight.thrusters.update_load(&flight.allocator.settings, &state.mass.now, time_s);
    }

    /// Opens and closes the valves whose time has come.
    fn process_valves(&mut self, time_s: f64) {
        let ConfiguredFlight { thrusters: Thrusters { valves, propellant, .. }, allocator, .. } =
            &mut self.flight;
        valves.process_events(&Feed { settings: &allocator.settings, propellant, time_s });
    }

    /// Sensors, controller.
    fn sample(&mut self) {
        let at @ MotionAt { time_s, body, .. } = self.end();
        let Self { state, settings, flight, reached, .. } = self;
        let number = state.sensing.sample(settings, flight.given.inputs, time_s, &body);
        reached.number = Some(number);
        flight.thrusters.sample_dump(
            flight.allocator,
            &state.motion,
            &body.momentum_inertial_n_m_s,
            &state.mass.known,
        );
        if self.settings.control.is_none() {
            return;
        }
        let target = self.target(time_s, &body);
        let Self { state, settings, flight, distribution, reached } = self;
        let Some(control) = &settings.control else { return };
        let sampled = Sampled {
            number,
            gyrostat: &settings.gyrostat,
            motion: &state.motion,
            at: &at,
            estimate: &state.sensing.estimate,
            mass: &state.mass.known,
            dump_body_n_m: state.dumps.torque_body_n_m(),
            thrusters: flight.thrusters,
            allocator: flight.allocator,
            distribution,
        };
        if state.control.control(control, &target, sampled) {
            reached.tracked = Some((target, state.sensing.estimate.attitude));
        }
    }

    /// Returns the attitude and rate that the controller tracks at the end of the motion; internal guidance is sampled anew where that is
    /// due.
    fn target(&mut self, time_s: f64, body: &BodyMotion) -> ControlTarget {
        let Self { state: DynamicState { control, sensing, .. }, flight, .. } = self;
        let command = match flight.given.inputs.tracked {
            Tracked::Rate(rate_body_rad_s) => return ControlTarget::RateOnly { rate_body_rad_s },
            Tracked::Attitude(command) => command,
            Tracked::Guidance => control.guidance_at(time_s).unwrap_or_else(|| {
                let guided = flight.plant_at(time_s, body).path.guided_attitude(time_s);
                control.guide(time_s, guided.as_ref(), &sensing.estimate)
            }),
        };
        let rate_body_rad_s = command.rate_body_rad_s;
        ControlTarget::Attitude { attitude: command.attitude_at(time_s), rate_body_rad_s }
    }

    /// Selects the Sun's direction where guidance is sampled.
    fn select_sun_direction(&mut self) -> Result<(), PlantError> {
        let (end, is_first) = (self.end(), self.state.control.guidance.is_none());
        let momentum = StartMomentum::Inertial(end.body.momentum_inertial_n_m_s);
        let (time_s, totals) = (end.time_s, dynamic_totals(&end));
        self.flight.select_sun_direction(&SunSelectionStart { time_s, totals, momentum, is_first })
    }

    /// Whether guidance is sampled anew with a sample at `time_s`.
    fn samples_guidance(&self, time_s: f64) -> bool {
        self.settings.control.is_some()
            && matches!(self.flight.given.inputs.tracked, Tracked::Guidance)
            && self.state.control.guidance_at(time_s).is_none()
    }

    /// Thrusters bring the momentum to `target_body_n_m_s` from the wheels' bias, from the present end of the motion on.
    fn dump_to(&mut self, target_body_n_m_s: Vector3<f64>) {
        let bias_body_n_m_s = self.flight.configuration.momentum.policy.bias_body_n_m_s;
        self.begin_dump(|_| bias_body_n_m_s + target_body_n_m_s);
    }

    /// Whether no dump and no thrust lasts at the end of the motion, and the momentum there is beyond a threshold.
    fn exceeds_threshold(&mut self) -> bool {
        let momentum_body_n_m_s = self.momentum_body_n_m_s();
        let Self { state, flight, .. } = self;
        state.dumps.are_over(flight.thrusters)
            && !state.control.by_thrusters
            && flight.thrusters.valves.burning().is_none()
            && flight.configuration.momentum.policy.exceeded(&momentum_body_n_m_s)
    }

    /// Momentum at the end of the motion, body frame, in N m s.
    fn momentum_body_n_m_s(&mut self) -> Vector3<f64> {
        let body = self.end().body;
        body.attitude.body_from_inertial(&body.momentum_inertial_n_m_s)
    }

    /// Begins the dump of the schedule that is due.
    fn dump_as_scheduled(&mut self) -> Result<(), PlantError> {
        let events = &self.flight.configuration.thruster_events;
        // The schedule may be another than at the start.
        events.check_for_dynamics(self.state.last.scheduled())?;
        let taken = self.state.last.pop_scheduled(events);
        if let Some(target_body_n_m_s) = taken.and_then(|event| events.dump_target_body_n_m_s(&event)) {
            self.dump_to(target_body_n_m_s);
        }
        Ok(())
    }

    /// Begins a dump at the end of the motion, to the momentum that follows from the one there.
    fn begin_dump(&mut self, after_body_n_m_s: impl FnOnce(&Vector3<f64>) -> Vector3<f64>) {
        let before_body_n_m_s = self.momentum_body_n_m_s();
        let after_body_n_m_s = after_body_n_m_s(&before_body_n_m_s);
        let Self { state, flight, .. } = self;
        let event = DumpEvent { time_s: state.motion.end_s(), before_body_n_m_s, after_body_n_m_s };
        if state.dumps.begin(event, flight.thrusters, flight.allocator, &state.motion, &state.mass.known) {
            (flight.given.log)(&ThrusterEvent::Dump(event));
        }
    }
}
