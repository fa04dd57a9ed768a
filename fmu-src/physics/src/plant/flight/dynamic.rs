//! Attitude dynamics of the plant: a rigid body with wheels under disturbances, sampled sensors, and either a controller that
//! tracks a command or wheel torques from outside.
//!
//! Sensors and controller are sampled at a fixed rate; motor torques hold over a sample. A sample at t belongs to the step
//! that begins at t and reads that step's inputs. Between two samples, edges of the disturbance grid, ends of dumps and
//! changes of inputs the motion is one [`GyrostatMotion`] segment or a few; communication points only evaluate it.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::attitude::{Attitude, BodyLoad, BodyMotion, DipoleInField, GyrostatMotion};
use crate::loads::{ByEffect, Effect, ForceTorque, Linear, Writer};
use crate::momentum::DumpEvent;
use crate::numerics::spacing::spacing;
use crate::spacecraft::MassProperties;

use super::configured::ConfiguredFlight;
use super::control_loop::{ControlLoop, Sampled};
use super::momentum_dumps::MomentumDumps;
use super::sensing::Sensing;
use crate::momentum::WorkKind;
use crate::plant::disturbances::disturbance_interval::DisturbanceInterval;
use crate::plant::disturbances::evaluation::Evaluation;
use crate::plant::disturbances::plant::Plant;
use crate::plant::mass::MassState;
use crate::plant::motion::panel_motion::PanelMotion;
use crate::plant::settings::configuration::{AttitudeSource, Command};
use crate::plant::settings::dynamics_settings::{
    DynamicsInputs, DynamicsSettings, StartMotion, StartPointing, Tracked,
};
use crate::plant::settings::error::{ManeuverError, PlantError};
use crate::plant::settings::thruster_events::{SchedulePlace, ThrusterEvent};
use crate::plant::sources::Dipoles;
use crate::plant::sources::applied::APPLIED;
use crate::plant::sources::thrusters::THRUSTERS;
use crate::plant::thrusters::reaction_control::Thrusters;

/// Units of work of a segment of the motion with flexible modes, slosh or imbalance; one of a rigid body's is a unit.
const FLEXIBLE_UNITS: u32 = 8;

/// State of the attitude dynamics: body, panels, disturbances, sensors, control, dumps and their schedule.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct AttitudeDynamics {
    pub motion: GyrostatMotion,
    pub mass: MassState,
    panels: PanelMotion,
    disturbance: DisturbanceInterval,
    pub sensing: Sensing,
    pub control: ControlLoop,
    pub dumps: MomentumDumps,
    /// How far the schedule is over.
    pub scheduled: SchedulePlace,
}

/// A step of a flight by torque.
pub(super) struct DynamicStep<'s, 'f> {
    /// Settings; the gyrostat's mass properties are those of the current mass.
    pub settings: &'s mut DynamicsSettings,
    /// The flight that advances.
    pub flight: &'s mut ConfiguredFlight<'f>,
    /// Inputs of the step.
    pub inputs: &'s DynamicsInputs,
}

impl AttitudeDynamics {
    /// At the start of a flight in the attitude after `held`.
    pub(super) fn begin(
        settings: &mut DynamicsSettings,
        flight: &mut ConfiguredFlight<'_>,
        time_s: f64,
        held: &Attitude,
    ) -> Result<Self, PlantError> {
        let scheduled = SchedulePlace::before(time_s);
        flight.context.configuration.thruster_events.check_for_dynamics(scheduled)?;
        let StartMotion { mut attitude, mut rate_body_rad_s, rate_is_pointed, .. } = settings.start;
        if let Some(pointing) = &settings.start.pointing {
            let frame = match pointing {
                StartPointing::Guidance(law) => flight.frame_by(law, time_s)?,
                StartPointing::Command(command) => command.frame_at(time_s),
            };
            attitude = Attitude::from_rotation(&frame.inertial_from_body);
            if rate_is_pointed {
                rate_body_rad_s = frame.rate_body_rad_s;
            }
        }
        attitude = attitude.continuing(&held.unit_quaternion());
        let unit = attitude.unit_quaternion();
        let [momentum_inertial_n_m_s, delta_v_inertial_m_s] = [Vector3::zeros(); 2];
        let body =
            BodyMotion { attitude: unit, rate_body_rad_s, momentum_inertial_n_m_s, delta_v_inertial_m_s };
        let mut mass = flight.context.configuration.wet_mass_properties();
        if settings.panels_have_mass {
            let still = BodyMotion { rate_body_rad_s: Vector3::zeros(), ..body };
            let mut plant = flight.plant_at(time_s, &still);
            let instant = plant.instant(time_s);
            mass = plant.mass_properties(&instant, time_s);
            settings.set_mass_properties(&mass);
        }
        let gyrostat = &settings.gyrostat;
        let wheel_n_m_s = |k: usize| settings.start.wheels_n_m_s.get(k).copied().unwrap_or(0.0);
        let mut begun = Self {
            motion: GyrostatMotion::new(gyrostat, time_s, unit, &rate_body_rad_s, wheel_n_m_s),
            mass: MassState::new(mass),
            panels: PanelMotion::default(),
            disturbance: DisturbanceInterval::before(),
            sensing: Sensing::new(settings, time_s, attitude, rate_body_rad_s),
            control: ControlLoop::new(gyrostat.wheels().len(), time_s, attitude, rate_body_rad_s),
            dumps: MomentumDumps::default(),
            scheduled,
        };
        if settings.panels_have_mass {
            let mut plant = flight.plant_at(time_s, &body);
            let instant = plant.instant(time_s);
            begun.panels = PanelMotion::at_start(plant.hinged(), &instant, time_s);
            let internal = begun.panels.internal(flight.given.prepared.panels, &mass, begun.motion.end_s());
            begun.motion.add_hinges(internal);
        }
        flight.propagator.panel_turns.restart();
        Ok(begun)
    }

    /// Rejects decoded states that no simulation with these numbers of wheels, modal coordinates and panels can produce.
    pub(super) fn is_valid(&self, wheels: usize, oscillators: usize, panels: usize) -> bool {
        self.motion.is_valid(wheels, oscillators)
            && self.mass.is_valid()
            && self.panels.is_valid(panels)
            && self.disturbance.is_valid()
            && self.sensing.is_valid()
            && self.control.is_valid(wheels)
            && self.dumps.is_valid()
    }

    /// Whether it has come to `time_s` and not beyond the segment there.
    pub(super) fn covers(&self, time_s: f64) -> bool {
        let tolerance_s = tolerance_s(time_s);
        self.motion.start_s() <= time_s + tolerance_s && time_s <= self.motion.end_s() + tolerance_s
    }

    /// Something that acts changes at `time_s`; `loads_change` tells whether light and place do.
    pub(super) fn cut(&mut self, time_s: f64, loads_change: bool) {
        if time_s < self.motion.end_s() - tolerance_s(time_s) {
            self.motion.cut(time_s);
        }
        if loads_change {
            self.disturbance.cut(time_s);
        }
    }

    /// Applies the requests of a step from its start on: dumps, pulses, thrust.
    pub(super) fn apply_requests(
        &mut self,
        step: &mut DynamicStep<'_, '_>,
        [start_s, end_s]: [f64; 2],
    ) -> Result<(), PlantError> {
        if step.inputs.maneuver.is_some() {
            return Err(PlantError::Maneuver { time_s: start_s, why: ManeuverError::ByTorque });
        }
        if let Some(target_body_n_m_s) = step.inputs.dump_to_body_n_m_s {
            self.cut(start_s, false);
            self.dump_to(step, target_body_n_m_s);
        }
        let pulses = step.flight.thrusters.command_pulses(
            &step.flight.context.allocator.settings,
            &step.inputs.pulses,
            [start_s, end_s],
        );
        if step.flight.command_thrust(&step.inputs.thrust, start_s) || pulses {
            self.cut(start_s, false);
        }
        Ok(())
    }

    /// Advances until the motion covers `end_s`, within the work that has begun.
    pub(super) fn advance(&mut self, step: &mut DynamicStep<'_, '_>, end_s: f64) -> Result<(), PlantError> {
        self.resume(step.settings, step.flight);
        let units = if step.settings.gyrostat.is_rigid() { 1 } else { FLEXIBLE_UNITS };
        while self.motion.end_s() < end_s - tolerance_s(end_s) {
            let time_s = self.motion.end_s();
            let evaluations = step.flight.context.ephemeris.evaluations();
            step.flight.context.work.spend(WorkKind::Segment, units, evaluations, time_s)?;
            self.process_events(step)?;
            let edge_s = step.flight.next_thruster_edge_s();
            let limit_s = self.sensing.next_s().min(self.disturbance.end_s()).min(edge_s);
            let events = &step.flight.context.configuration.thruster_events;
            let limit_s = limit_s.min(self.dumps.until_s()).min(events.next_s(self.scheduled));
            let external = (step.flight.given.external)(time_s);
            let mut load = self.load(&external, step.flight.thrusters, time_s);
            self.dumps.dipoles = step.flight.dipoles(time_s);
            load.dipole = self.in_field(&self.dumps.dipoles);
            load.internal = self.panels.internal(step.flight.given.prepared.panels, &self.mass.now, time_s);
            self.dumps.torques = self.torques_by_source(&external, time_s);
            self.motion.advance(&step.settings.gyrostat, self.control.wheels.motors(), &load, limit_s);
            step.flight.integrate_thrust(&self.motion, &self.disturbance, self.mass.now.mass_kg)?;
        }
        Ok(())
    }

    /// Attitude of a fork from `time_s` on: the commanded one, followed ideally; without a command the present one, held.
    pub(super) fn ideal_attitude(&self, step: &DynamicStep<'_, '_>, time_s: f64) -> AttitudeSource {
        let guided = step.flight.context.configuration.attitude.guided();
        match (&step.settings.control, step.inputs.tracked, guided) {
            (Some(_), Tracked::Guidance, Some(law)) => AttitudeSource::Guided(*law),
            (Some(_), Tracked::Attitude(command), _) => AttitudeSource::Commanded(command),
            _ => AttitudeSource::Commanded(Command {
                attitude: Attitude::from_unit(self.motion.attitude_at(time_s)),
                rate_body_rad_s: Vector3::zeros(),
                since_s: time_s,
            }),
        }
    }

    /// The body has the mass properties of the present segment, and the whole spacecraft those of the last edge of the grid.
    pub(super) fn resume(&self, settings: &mut DynamicsSettings, flight: &mut ConfiguredFlight<'_>) {
        settings.set_mass_properties(&self.mass.now);
        let context = &mut *flight.context;
        context.current_mass_panels_stowed =
            self.mass.stowed.unwrap_or_else(|| context.configuration.wet_mass_properties());
    }

    /// At the present end of the motion: edges of thrusters, disturbances anew, a dump's end, the sample, where they are due.
    pub(super) fn process_events(&mut self, step: &mut DynamicStep<'_, '_>) -> Result<(), PlantError> {
        let time_s = self.motion.end_s();
        let due_s = time_s + tolerance_s(time_s);
        self.motion.remembered_at(&step.settings.gyrostat, time_s);
        self.dumps.accumulate(&self.motion, self.dumps.is_dumping(step.flight.thrusters, time_s));
        if !step.flight.thrusters.load().law.is_none() {
            let (flight, tanks) = (&*step.flight, &step.flight.context.allocator.settings.tanks);
            let mass = flight.thrusters.propellant.mass_properties_since(&self.mass.now, tanks, time_s);
            self.set_mass(step.settings, mass);
        }
        let settings = &step.flight.context.allocator.settings;
        step.flight.thrusters.accumulate(settings, &self.motion, time_s);
        step.flight.thrusters.process_valve_events(settings, time_s);
        self.dumps.end(due_s);
        self.control.wheels.fail(&step.inputs.wheel_failed);
        if step.settings.control.is_none() {
            self.control.wheels.drive(&step.settings.gyrostat, &step.inputs.wheel_torques_n_m);
        }
        let (sample_due, grid_due) = (self.sensing.next_s() <= due_s, self.disturbance.end_s() <= due_s);
        if grid_due {
            self.begin_interval(step)?;
        }
        self.dump_as_scheduled(step, due_s)?;
        if sample_due {
            self.sample(step)?;
            let settings = &step.flight.context.allocator.settings;
            step.flight.thrusters.process_valve_events(settings, time_s);
        }
        self.turn_mass(step.settings, step.flight);
        let used_kg = step.flight.thrusters.propellant.total_used_kg(time_s);
        self.mass.now.mass_kg = step.flight.context.configuration.mass_kg - used_kg;
        let settings = &step.flight.context.allocator.settings;
        step.flight.thrusters.update_load(settings, &self.mass.now, time_s);
        Ok(())
    }

    /// At an edge of the grid: orbit, mass properties and disturbances anew.
    fn begin_interval(&mut self, step: &mut DynamicStep<'_, '_>) -> Result<(), PlantError> {
        let DynamicStep { settings, flight, .. } = step;
        let time_s = self.motion.end_s();
        let body = self.motion.at(&settings.gyrostat, time_s);
        let context = &mut *flight.context;
        let loaded = context.configuration.wet_mass_properties();
        self.mass.stowed =
            flight.thrusters.mass_properties_stowed(&context.allocator.settings, &loaded, time_s);
        context.current_mass_panels_stowed = self.mass.stowed.unwrap_or(loaded);
        let begins = self.disturbance.is_before();
        if begins || !context.configuration.motion.uses_encke() {
            flight.propagator.cut(&context.configuration, time_s, true);
        } else {
            flight.propagator.sources.cut(time_s);
        }
        let rate_terms_body = self.predicted_rate_terms(settings, flight, &body);
        let has_thrusters = !flight.context.allocator.settings.thrusters.is_empty();
        let mut plant = flight.turning_plant(time_s, &body, rate_terms_body);
        if settings.panels_have_mass
            && let Some(body) = self.track_panel_laws(settings, &mut plant)
        {
            plant = flight.turning_plant(time_s, &body, rate_terms_body);
        }
        let inverse_inertia = settings.gyrostat.inverse_carrier().filter(|_| settings.control.is_none());
        self.disturbance = self.disturbance.next(&mut plant, time_s, settings.grid_s, inverse_inertia)?;
        self.disturbance.deviate(&mut plant)?;
        if settings.panels_have_mass || self.mass.stowed.is_some() || has_thrusters {
            let instant = plant.instant(time_s);
            self.set_known_mass(settings, plant.mass_properties(&instant, time_s));
        }
        if settings.panels_have_mass {
            let was_turning = self.panels.is_turning();
            let hinged = plant.hinged();
            let end_s = hinged.configuration.last_of_panels_s(time_s, self.disturbance.end_s());
            let [now, end] = [time_s, end_s].map(|at_s| plant.instant(at_s));
            self.panels.turn_until(hinged, &now, &end, end_s);
            if was_turning || self.panels.is_turning() {
                self.turn_mass(settings, flight);
                let internal = self.panels.internal(flight.given.prepared.panels, &self.mass.now, time_s);
                self.motion.reorient(&settings.gyrostat, self.motion.attitude_at(time_s), internal);
            }
        }
        Ok(())
    }

    /// First and second term of the rate's series at the end of the motion, body frame, in rad/s2 and rad/s3: by what acts there,
    /// the disturbances as the interval that ends has them.
    fn predicted_rate_terms(
        &self,
        settings: &DynamicsSettings,
        flight: &ConfiguredFlight<'_>,
        body: &BodyMotion,
    ) -> [Vector3<f64>; 2] {
        // A controller's torque lasts for a sample, and holds the rate.
        if settings.control.is_some() {
            return [Vector3::zeros(); 2];
        }
        let (time_s, rate) = (self.motion.end_s(), &body.rate_body_rad_s);
        let [_, [mut torque, mut slope]] = self.disturbance.total_at(time_s);
        let [now, per_s] = (flight.given.external)(time_s);
        torque += now.torque_body_n_m;
        slope += per_s.torque_body_n_m;
        // A pulse that ends before the interval says little of it.
        let steady_until_s = flight.next_thruster_edge_s().min(self.dumps.until_s());
        if steady_until_s >= time_s + settings.grid_s {
            let [turn, turn_slope] = flight.thrusters.load().law.torque_body_n_m;
            torque += self.dumps.torque_body_n_m() + turn;
            slope += turn_slope;
        }
        let dipole = self.in_field(&flight.dipoles(time_s)).filter(|_| !self.disturbance.is_before());
        if let Some(dipole) = dipole {
            let [now, per_s] = dipole.torque_with_slope_n_m(&body.attitude, rate);
            torque += now;
            slope += per_s;
        }
        let gyrostat = &settings.gyrostat;
        let motor_n_m = |k: usize| {
            if gyrostat.wheels()[k].locked { 0.0 } else { self.control.wheels.motors()[k].torque_n_m }
        };
        let momentum_body = body.attitude.body_from_inertial(&body.momentum_inertial_n_m_s);
        gyrostat.rate_terms(rate, &momentum_body, [torque, slope], &gyrostat.along_axes(motor_n_m))
    }

    /// The panels go where their laws have them at the end of the motion; the body after that, where they were elsewhere.
    fn track_panel_laws(
        &mut self,
        settings: &mut DynamicsSettings,
        plant: &mut Plant<'_>,
    ) -> Option<BodyMotion> {
        let time_s = self.motion.end_s();
        let to_sun_m = plant.instant(time_s).geometry.to_sun.position_m;
        let hinged = plant.hinged();
        let attitude = self.panels.track_law(hinged, &mut settings.gyrostat, &self.motion, &to_sun_m)?;
        let mass = self.panels.mass_properties(&hinged.current_mass_panels_stowed, hinged.panels, time_s);
        self.set_known_mass(settings, mass);
        let internal = self.panels.internal(hinged.panels, &mass, time_s);
        self.motion.reorient(&settings.gyrostat, attitude, internal);
        Some(self.motion.at(&settings.gyrostat, time_s))
    }

    /// Panels that turn have the body with the mass properties of the end of the motion.
    fn turn_mass(&mut self, settings: &mut DynamicsSettings, flight: &ConfiguredFlight<'_>) {
        if !self.panels.is_turning() {
            return;
        }
        let time_s = self.motion.end_s();
        let loaded = flight.context.configuration.wet_mass_properties();
        let left = self.mass.stowed.and_then(|_| flight.used_mass(&loaded, time_s)).unwrap_or(loaded);
        self.set_mass(settings, self.panels.mass_properties(&left, flight.given.prepared.panels, time_s));
    }

    fn set_mass(&mut self, settings: &mut DynamicsSettings, mass: MassProperties) {
        self.mass.now = mass;
        settings.set_mass_properties(&mass);
    }

    fn set_known_mass(&mut self, settings: &mut DynamicsSettings, mass: MassProperties) {
        self.mass.known = mass;
        self.set_mass(settings, mass);
    }

    /// Sensors, watch of the momentum, controller.
    fn sample(&mut self, step: &mut DynamicStep<'_, '_>) -> Result<(), PlantError> {
        let DynamicStep { settings, flight, inputs } = step;
        let time_s = self.motion.end_s();
        let body = self.motion.remembered_at(&settings.gyrostat, time_s);
        let number = self.sensing.sample(settings, inputs, time_s, &body, self.disturbance.sun_at(time_s));
        let momentum_body = body.attitude.body_from_inertial(&body.momentum_inertial_n_m_s);
        let is_free = self.dumps.are_over(flight.thrusters) && !self.control.by_thrusters;
        let policy = flight.context.configuration.momentum.policy;
        if is_free && flight.thrusters.burning().is_none() && policy.exceeded(&momentum_body) {
            self.begin_dump(flight, &momentum_body, policy.after(&momentum_body));
            self.dumps.dumps.check()?;
        }
        let allocator = &mut flight.context.allocator;
        flight.thrusters.sample_dump(
            allocator,
            &self.motion,
            &body.momentum_inertial_n_m_s,
            &self.mass.known,
        );
        let Some(control) = &settings.control else { return Ok(()) };
        let sampled = Sampled {
            number,
            gyrostat: &settings.gyrostat,
            motion: &self.motion,
            body: &body,
            estimate: &self.sensing.estimate,
            mass: &self.mass.known,
            dump_body_n_m: self.dumps.torque_body_n_m(),
        };
        let target = self.control.target(flight, inputs.tracked, &sampled)?;
        self.control.control(control, (flight.thrusters, &mut flight.context.allocator), &target, &sampled);
        Ok(())
    }

    /// Thrusters bring the momentum to `target_body_n_m_s` from the wheels' bias, from the present end of the motion on.
    fn dump_to(&mut self, step: &mut DynamicStep<'_, '_>, target_body_n_m_s: Vector3<f64>) {
        let body = self.motion.at(&step.settings.gyrostat, self.motion.end_s());
        let momentum_body = body.attitude.body_from_inertial(&body.momentum_inertial_n_m_s);
        let bias_body_n_m_s = step.flight.context.configuration.momentum.policy.bias_body_n_m_s;
        self.begin_dump(step.flight, &momentum_body, bias_body_n_m_s + target_body_n_m_s);
    }

    /// Begins the dumps of the schedule whose time has come.
    fn dump_as_scheduled(&mut self, step: &mut DynamicStep<'_, '_>, due_s: f64) -> Result<(), PlantError> {
        while let events = &step.flight.context.configuration.thruster_events
            && let Some(event) = events.next(self.scheduled).filter(|event| events.time_s(event) <= due_s)
        {
            // The schedule may be another than at the start.
            events.check_for_dynamics(self.scheduled)?;
            self.scheduled.take(events.time_s(event));
            if let Some(target_body_n_m_s) = events.dump_target_body_n_m_s(event) {
                self.dump_to(step, target_body_n_m_s);
            }
        }
        Ok(())
    }

    fn begin_dump(&mut self, flight: &mut ConfiguredFlight<'_>, before: &Vector3<f64>, after: Vector3<f64>) {
        let time_s = self.motion.end_s();
        let event = DumpEvent { time_s, before_body_n_m_s: *before, after_body_n_m_s: after };
        if self.dumps.begin(event, flight, &self.motion, &self.mass.known) {
            (flight.log)(&ThrusterEvent::Dump(event));
        }
    }

    /// Force, torque and mass flow on the body from `time_s` on.
    fn load(&self, [now, slope]: &[ForceTorque; 2], thrusters: &Thrusters, time_s: f64) -> BodyLoad {
        let [[force, force_slope], [torque, torque_slope]] = self.disturbance.total_at(time_s);
        let dump = self.dumps.torque_body_n_m();
        let thrusters = thrusters.load();
        let [thrust, thrust_slope] = thrusters.law.force_body_n;
        let [turn, turn_slope] = thrusters.law.torque_body_n_m;
        BodyLoad {
            torque_body_n_m: [
                torque + now.torque_body_n_m + dump + turn,
                torque_slope + slope.torque_body_n_m + turn_slope,
            ],
            force_body_n: [
                force + now.force_body_n + thrust,
                force_slope + slope.force_body_n + thrust_slope,
            ],
            mass_kg: thrusters.mass_kg,
            flow_kg_s: thrusters.law.flow_kg_s,
            mass_flow: (!thrusters.law.is_none()).then_some(thrusters.mass_flow),
            dipole: None,
            internal: None,
        }
    }

    /// The sum of these dipoles in the field from the end of the motion on, where there is one.
    fn in_field(&self, dipoles: &Dipoles) -> Option<DipoleInField> {
        let dipole_body_a_m2 = dipoles
            .iter()
            .flatten()
            .copied()
            .reduce(|[sum, sum_rate], [dipole, rate]| [sum + dipole, sum_rate + rate])?;
        let field_inertial_t = self.disturbance.field_at(self.motion.end_s());
        (dipole_body_a_m2 != [Vector3::zeros(); 2])
            .then_some(DipoleInField { dipole_body_a_m2, field_inertial_t })
    }

    /// Torque by effect from `time_s` on.
    fn torques_by_source(&self, external: &[ForceTorque; 2], time_s: f64) -> ByEffect<Option<Linear>> {
        ByEffect::from_fn(|effect| match effect {
            APPLIED => Some(external.map(|load| load.torque_body_n_m)),
            effect if effect.row().momentum_apart => self.disturbance.torque_at(effect, time_s),
            _ => None,
        })
    }

    /// Geometry, attitude and loads at `time_s`, as the motion integrates them.
    pub(super) fn evaluation(
        &self,
        settings: &DynamicsSettings,
        flight: &mut ConfiguredFlight<'_>,
        body: &BodyMotion,
        time_s: f64,
    ) -> Evaluation {
        let loaded = flight.context.configuration.wet_mass_properties();
        flight.context.current_mass_panels_stowed = flight.used_mass(&loaded, time_s).unwrap_or(loaded);
        let mass_kg = loaded.mass_kg - flight.thrusters.propellant.total_used_kg(time_s);
        let mut plant = flight.plant_at(time_s, body);
        let instant = plant.instant(time_s);
        let mass = MassProperties { mass_kg, ..plant.mass_properties(&instant, time_s) };
        let panels_body_n_m_s = plant.panel_momentum_body_n_m_s(&instant, &mass, time_s);
        let air_and_field = plant.air_and_field(time_s);
        let mut loads = self.disturbance.loads_at(time_s);
        for (row, dipole) in Effect::FIELD.into_iter().zip(flight.dipoles(time_s)) {
            if let Some([dipole_body_a_m2, _]) = dipole.filter(|[now, _]| *now != Vector3::zeros()) {
                let [field_inertial_t, _] = self.disturbance.field_at(time_s);
                loads[row].torque_body_n_m = dipole_body_a_m2.cross(&(instant.to_body * field_inertial_t));
            }
        }
        for row in Effect::ALL {
            match row.row().writer {
                Writer::Source(_) => {}
                Writer::Rotors => {
                    let [torque_body_n_m, force_body_n] =
                        self.motion.imbalance_load(&settings.gyrostat, time_s, body);
                    loads[row] = ForceTorque { force_body_n, torque_body_n_m };
                }
                Writer::Propellant => loads[row].torque_body_n_m = self.motion.swing_torque_n_m(time_s),
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

fn tolerance_s(time_s: f64) -> f64 {
    4.0 * spacing(time_s)
}
