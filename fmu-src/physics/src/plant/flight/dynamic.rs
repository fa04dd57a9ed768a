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
use crate::spacecraft::MassProperties;

use super::configured::ConfiguredFlight;
use super::downlink_forecast::StartMomentum;
use super::grid_edge;
use crate::plant::control::control_loop::{Actuators, Sampled};
use crate::plant::control::wheel_control::WheelDistribution;
use crate::plant::disturbances::evaluation::Evaluation;
use crate::plant::settings::configuration::{AttitudeSource, Command};
use crate::plant::settings::dynamics_settings::{DynamicsInputs, DynamicsSettings, Tracked};
use crate::plant::settings::error::{ManeuverError, PlantError};
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
    /// Inputs of the step.
    pub inputs: &'f DynamicsInputs,
    /// The flight that advances.
    pub flight: ConfiguredFlight<'f>,
    /// The distribution of torque over the wheels.
    pub distribution: &'f mut WheelDistribution,
}

impl Dynamic<'_> {
    /// Applies the requests of a step from its start on: dumps, pulses, thrust.
    pub(super) fn apply_requests(&mut self, [start_s, end_s]: [f64; 2]) -> Result<(), PlantError> {
        if self.inputs.maneuver.is_some() {
            return Err(PlantError::Maneuver { time_s: start_s, why: ManeuverError::ByTorque });
        }
        if let Some(target_body_n_m_s) = self.inputs.dump_to_body_n_m_s {
            self.state.cut(start_s, false);
            self.dump_to(target_body_n_m_s);
        }
        let Self { inputs, flight, .. } = self;
        let settings = &flight.context.allocator.settings;
        let pulses = flight.thrusters.command_pulses(settings, &inputs.pulses, [start_s, end_s]);
        if flight.command_thrust(&inputs.thrust, start_s) || pulses {
            self.state.cut(start_s, false);
        }
        Ok(())
    }

    /// Advances until the motion covers `end_s`, within the work that has begun.
    pub(super) fn advance(&mut self, end_s: f64) -> Result<(), PlantError> {
        self.resume();
        let units = if self.settings.gyrostat.is_rigid() { 1 } else { FLEXIBLE_UNITS };
        while self.state.motion.end_s() < end_s - tolerance_s(end_s) {
            let time_s = self.state.motion.end_s();
            let evaluations = self.flight.context.ephemeris.evaluations();
            self.flight.context.work.spend(WorkKind::Segment, units, evaluations, time_s)?;
            let body = self.process_events()?;
            let Self { state, settings, flight, .. } = self;
            let edge_s = flight.next_thruster_edge_s();
            let limit_s = state.sensing.next_s().min(state.disturbance.end_s()).min(edge_s);
            let events = &flight.context.configuration.thruster_events;
            let limit_s = limit_s.min(state.dumps.until_s()).min(events.next_s(state.scheduled));
            let external = (flight.given.external)(time_s);
            let mut load = state.load(&external, flight.thrusters, time_s);
            state.dumps.dipoles = flight.dipoles(time_s);
            load.dipole = state.in_field(&state.dumps.dipoles);
            load.internal = state.panels.internal(flight.given.prepared.panels, &state.mass.now, time_s);
            state.dumps.torques = state.torques_by_source(&external, time_s);
            let motors = state.control.wheels.motors();
            state.motion.advance_from(&body, &settings.gyrostat, motors, &load, limit_s);
            flight.integrate_thrust(&state.motion, &state.disturbance, state.mass.now.mass_kg)?;
        }
        Ok(())
    }

    /// Attitude of a fork from `time_s` on: the commanded one, followed ideally; without a command the present one, held.
    pub(super) fn ideal_attitude(&self, time_s: f64) -> AttitudeSource {
        let guided = self.flight.context.configuration.attitude.guided();
        match (&self.settings.control, self.inputs.tracked, guided) {
            (Some(_), Tracked::Guidance, Some(law)) => AttitudeSource::Guided(*law),
            (Some(_), Tracked::Attitude(command), _) => AttitudeSource::Commanded(command),
            _ => AttitudeSource::Commanded(Command {
                attitude: Attitude::from_unit(self.state.motion.attitude_at(time_s)),
                rate_body_rad_s: Vector3::zeros(),
                since_s: time_s,
            }),
        }
    }

    /// The body has the mass properties of the present segment, and the whole spacecraft those of the last edge of the grid.
    pub(super) fn resume(&mut self) {
        let Self { state, settings, flight, .. } = self;
        settings.set_mass_properties(&state.mass.now);
        let context = &mut *flight.context;
        context.current_mass_panels_stowed =
            state.mass.stowed.unwrap_or_else(|| context.configuration.wet_mass_properties());
    }

    /// At the present end of the motion: edges of thrusters, disturbances anew, a dump's end, the sample, where they are due; the body
    /// there.
    pub(super) fn process_events(&mut self) -> Result<BodyMotion, PlantError> {
        let Self { state, settings, flight, inputs, .. } = self;
        let time_s = state.motion.end_s();
        let due_s = time_s + tolerance_s(time_s);
        let mut end = state.motion.evaluated_at(&settings.gyrostat, time_s);
        state.dumps.accumulate(&state.motion, &end, state.dumps.is_dumping(flight.thrusters, time_s));
        let thruster_settings = &flight.context.allocator.settings;
        if !flight.thrusters.load().law.is_none() {
            let tanks = &thruster_settings.tanks;
            let mass = flight.thrusters.propellant.mass_properties_since(&state.mass.now, tanks, time_s);
            grid_edge::set_mass(state, settings, mass);
        }
        flight.thrusters.accumulate(thruster_settings, &state.motion, time_s);
        flight.thrusters.process_valve_events(thruster_settings, time_s);
        state.dumps.end(due_s);
        state.control.wheels.fail(&inputs.wheel_failed);
        if settings.control.is_none() {
            state.control.wheels.drive(&settings.gyrostat, &inputs.wheel_torques_n_m);
        }
        let sample_due = state.sensing.next_s() <= due_s;
        if state.disturbance.end_s() <= due_s {
            grid_edge::begin_interval(state, settings, flight)?;
            end = state.motion.evaluated_at(&settings.gyrostat, time_s);
        }
        self.dump_as_scheduled(due_s)?;
        if sample_due {
            self.sample(&end)?;
            let Self { flight, .. } = self;
            flight.thrusters.process_valve_events(&flight.context.allocator.settings, time_s);
        }
        let Self { state, settings, flight, .. } = self;
        grid_edge::turn_mass(state, settings, flight);
        let used_kg = flight.thrusters.propellant.total_used_kg(time_s);
        state.mass.now.mass_kg = flight.context.configuration.mass_kg - used_kg;
        flight.thrusters.update_load(&flight.context.allocator.settings, &state.mass.now, time_s);
        Ok(end.body)
    }

    /// Sensors, watch of the momentum, controller; the body being like that at the end of the motion.
    fn sample(&mut self, end: &MotionAt) -> Result<(), PlantError> {
        let MotionAt { time_s, body, .. } = *end;
        let Self { state, settings, flight, inputs, .. } = self;
        let sun = state.disturbance.sun_at(time_s);
        let number = state.sensing.sample(settings, inputs, time_s, &body, sun);
        let momentum_body = body.attitude.body_from_inertial(&body.momentum_inertial_n_m_s);
        let is_free = state.dumps.are_over(flight.thrusters) && !state.control.by_thrusters;
        let policy = flight.context.configuration.momentum.policy;
        if is_free && flight.thrusters.burning().is_none() && policy.exceeded(&momentum_body) {
            self.begin_dump(&momentum_body, policy.after(&momentum_body));
            self.state.dumps.dumps.check()?;
        }
        let Self { state, flight, .. } = self;
        flight.thrusters.sample_dump(
            &mut flight.context.allocator,
            &state.motion,
            &body.momentum_inertial_n_m_s,
            &state.mass.known,
        );
        if self.settings.control.is_none() {
            return Ok(());
        }
        let target = self.target(time_s, &body)?;
        let Self { state, settings, flight, distribution, .. } = self;
        let Some(control) = &settings.control else { return Ok(()) };
        let sampled = Sampled {
            number,
            gyrostat: &settings.gyrostat,
            motion: &state.motion,
            body: &body,
            estimate: &state.sensing.estimate,
            mass: &state.mass.known,
            dump_body_n_m: state.dumps.torque_body_n_m(),
        };
        let thrusters = &mut *flight.thrusters;
        let actuators = Actuators { thrusters, allocator: &mut flight.context.allocator, distribution };
        state.control.control(control, actuators, &target, &sampled);
        Ok(())
    }

    /// Returns the attitude and rate that the controller tracks at the end of the motion.
    fn target(&mut self, time_s: f64, body: &BodyMotion) -> Result<ControlTarget, PlantError> {
        let command = match self.inputs.tracked {
            Tracked::Rate(rate_body_rad_s) => return Ok(ControlTarget::RateOnly { rate_body_rad_s }),
            Tracked::Attitude(command) => command,
            Tracked::Guidance => self.guided(time_s, body)?,
        };
        Ok(ControlTarget::Attitude {
            attitude: command.attitude_at(time_s),
            rate_body_rad_s: command.rate_body_rad_s,
        })
    }

    /// The command of internal guidance, sampled anew where that is due.
    fn guided(&mut self, time_s: f64, body: &BodyMotion) -> Result<Command, PlantError> {
        let Self { state: DynamicState { control, sensing, .. }, flight, .. } = self;
        if let Some(command) = control.guidance_at(time_s) {
            return Ok(command);
        }
        let totals = Totals {
            momentum_inertial_n_m_s: body.momentum_inertial_n_m_s,
            torque_integral_body_n_m_s: Vector3::zeros(),
            delta_v_inertial_m_s: body.delta_v_inertial_m_s,
        };
        let momentum = StartMomentum::Inertial(body.momentum_inertial_n_m_s);
        flight.select_sun_direction(time_s, &totals, momentum, control.is_unguided())?;
        let guided = flight.plant_at(time_s, body).kinematics.guided_attitude(time_s);
        Ok(control.guide(time_s, guided.as_ref(), &sensing.estimate))
    }

    /// Thrusters bring the momentum to `target_body_n_m_s` from the wheels' bias, from the present end of the motion on.
    fn dump_to(&mut self, target_body_n_m_s: Vector3<f64>) {
        let body = self.state.motion.at(&self.settings.gyrostat, self.state.motion.end_s());
        let momentum_body = body.attitude.body_from_inertial(&body.momentum_inertial_n_m_s);
        let bias_body_n_m_s = self.flight.context.configuration.momentum.policy.bias_body_n_m_s;
        self.begin_dump(&momentum_body, bias_body_n_m_s + target_body_n_m_s);
    }

    /// Begins the dumps of the schedule whose time has come.
    fn dump_as_scheduled(&mut self, due_s: f64) -> Result<(), PlantError> {
        while let events = &self.flight.context.configuration.thruster_events
            && let Some(event) =
                events.next(self.state.scheduled).filter(|event| events.time_s(event) <= due_s)
        {
            // The schedule may be another than at the start.
            events.check_for_dynamics(self.state.scheduled)?;
            self.state.scheduled.take(events.time_s(event));
            if let Some(target_body_n_m_s) = events.dump_target_body_n_m_s(event) {
                self.dump_to(target_body_n_m_s);
            }
        }
        Ok(())
    }

    fn begin_dump(&mut self, before: &Vector3<f64>, after: Vector3<f64>) {
        let Self { state, flight, .. } = self;
        let time_s = state.motion.end_s();
        let event = DumpEvent { time_s, before_body_n_m_s: *before, after_body_n_m_s: after };
        let allocator = &mut flight.context.allocator;
        if state.dumps.begin(event, flight.thrusters, allocator, &state.motion, &state.mass.known) {
            (flight.given.log)(&ThrusterEvent::Dump(event));
        }
    }

    /// Geometry, attitude and loads where the body is like that, as the motion integrates them.
    pub(super) fn evaluation(&mut self, at: &MotionAt) -> Evaluation {
        let MotionAt { time_s, body, .. } = *at;
        let Self { state, settings, flight, .. } = self;
        let loaded = flight.context.configuration.wet_mass_properties();
        flight.context.current_mass_panels_stowed = flight.used_mass(&loaded, time_s).unwrap_or(loaded);
        let mass_kg = loaded.mass_kg - flight.thrusters.propellant.total_used_kg(time_s);
        let mut plant = flight.plant_at(time_s, &body);
        let instant = plant.instant(time_s);
        let mass = MassProperties { mass_kg, ..plant.mass_properties(&instant, time_s) };
        let panels_body_n_m_s = plant.panel_momentum_body_n_m_s(&instant, &mass, time_s);
        let air_and_field = plant.air_and_field(time_s);
        let mut loads = state.disturbance.loads_at(time_s);
        for (row, dipole) in Effect::FIELD.into_iter().zip(flight.dipoles(time_s)) {
            if let Some([dipole_body_a_m2, _]) = dipole.filter(|[now, _]| *now != Vector3::zeros()) {
                let [field_inertial_t, _] = state.disturbance.field_at(time_s);
                loads[row].torque_body_n_m = dipole_body_a_m2.cross(&(instant.to_body * field_inertial_t));
            }
        }
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
        [loads[APPLIED], _] = (flight.given.external)(time_s);
        let thrusters = flight.thrusters.load();
        loads[THRUSTERS] = ForceTorque {
            force_body_n: thrusters.law.force_at_n(time_s),
            torque_body_n_m: thrusters.torque_at_n_m(time_s, &body.rate_body_rad_s),
        };
        Evaluation { instant, loads, mass, panels_body_n_m_s, air_and_field }
    }
}
