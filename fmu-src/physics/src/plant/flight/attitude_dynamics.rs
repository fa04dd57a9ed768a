//! Attitude dynamics of the plant: a rigid body with wheels under disturbances, sampled sensors, and either a controller that
//! tracks a command or wheel torques from outside.
//!
//! Sensors and controller are sampled at a fixed rate; motor torques hold over a sample. A sample at t belongs to the step
//! that begins at t and reads that step's inputs. Between two samples, edges of the disturbance grid, ends of dumps and
//! changes of inputs the motion is one [`GyrostatMotion`] segment or a few; communication points only evaluate it.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::attitude::control::{
    AccelerometerState, ControlTarget, ControllerState, Estimate, EstimatorState, sensed_sun,
};
use crate::attitude::{Appendages, Attitude, BodyLoad, BodyMotion, GyrostatMotion, Quaternion};
use crate::momentum::{DumpEvent, DumpSpacing, Dumps, SOURCES, SourceMomenta, Totals};
use crate::numerics::chebyshev::GREATEST_IN_STATE;
use crate::numerics::intervals::next_multiple_s;
use crate::numerics::spacing::spacing;
use crate::propulsion::PropellantState;
use crate::radiation::{Effect, ForceTorque};
use crate::spacecraft::MassProperties;

use super::current::Flight;
use super::outlook::StartMomentum;
use super::wheel_control::WheelControl;
use crate::plant::disturbances::disturbance_interval::{DisturbanceInterval, Linear};
use crate::plant::disturbances::evaluation::{Evaluation, ExternalLoad, Plant, PreparedSpacecraft};
use crate::plant::motion::panel_motion::PanelMotion;
use crate::plant::settings::configuration::Command;
use crate::plant::settings::dynamics_settings::{Control, DynamicsInputs, DynamicsSettings, Tracked};
use crate::plant::settings::error::PlantError;
use crate::plant::settings::work::{Cost, Work};
use crate::plant::thrusters::reaction_control::ReactionControl;

/// Guidance is sampled at whole multiples of this, in s.
const GUIDANCE_INTERVAL_S: f64 = 1.0;
/// Units of work of a segment of the motion with flexible modes, slosh or imbalance; one of a rigid body's is a unit.
const FLEXIBLE_UNITS: u32 = 8;

/// A dump by a constant torque, of a spacecraft without thrusters that give torque all ways.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct ConstantDump {
    torque_body_n_m: Vector3<f64>,
    until_s: f64,
}

/// State of the attitude dynamics: body, wheels, sensors, controller, thrusters, dumps.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct AttitudeDynamics {
    motion: GyrostatMotion,
    /// Mass properties at the last edge of the grid, with the panels as they stood then: what the controller knows.
    mass: MassProperties,
    /// The same at the start of the present segment: without the propellant that flowed since.
    segment_mass: MassProperties,
    /// The same with every panel at angle 0; absent while no propellant is used.
    left: Option<MassProperties>,
    panels: PanelMotion,
    disturbance: DisturbanceInterval,
    /// Number of the next sample and its time, in s.
    next_sample: (i64, f64),
    sampled_s: f64,
    /// Attitude and velocity change at the last sample.
    sampled: (Quaternion, Vector3<f64>),
    estimator: EstimatorState,
    estimate: Estimate,
    sun_sensed_body: Option<Vector3<f64>>,
    accelerometer: AccelerometerState,
    controller: ControllerState,
    /// What guidance commanded last.
    guidance: Option<Command>,
    /// When guidance is sampled next, in s.
    next_guidance_s: f64,
    wheels: WheelControl,
    thrusters: ReactionControl,
    /// Whether thrusters control the attitude, and whether they could not give the torque asked for.
    by_thrusters: bool,
    thrusters_limited: bool,
    dump: Option<ConstantDump>,
    dumps: Dumps,
    spacing: DumpSpacing,
    /// What each effect did to the momentum from the last dump up to the present segment.
    by_source: SourceMomenta,
    /// Torque by effect from the start of that segment on.
    source_torques: [Linear; SOURCES.len()],
}

impl AttitudeDynamics {
    /// At the start of a flight with this mass, in this attitude and at this rate, the wheels holding these momenta, in N m s.
    pub fn new(
        settings: &DynamicsSettings,
        mass: MassProperties,
        time_s: f64,
        attitude: Attitude,
        rate_body_rad_s: Vector3<f64>,
        wheels_n_m_s: impl Fn(usize) -> f64,
    ) -> Self {
        let unit = attitude.unit_quaternion();
        let number = (time_s * settings.rate_hz).floor() as i64;
        Self {
            motion: GyrostatMotion::new(&settings.gyrostat, time_s, unit, &rate_body_rad_s, wheels_n_m_s),
            mass,
            segment_mass: mass,
            left: None,
            panels: PanelMotion::default(),
            disturbance: DisturbanceInterval::before(),
            next_sample: (number, time_s),
            sampled_s: time_s,
            sampled: (unit, Vector3::zeros()),
            estimator: EstimatorState::new(&settings.sensors, attitude),
            estimate: Estimate { attitude, is_valid: true, rate_body_rad_s: Some(rate_body_rad_s) },
            sun_sensed_body: None,
            accelerometer: AccelerometerState::new(&settings.accelerometer),
            controller: ControllerState::new(attitude, rate_body_rad_s),
            guidance: None,
            next_guidance_s: time_s,
            wheels: WheelControl::new(settings.gyrostat.wheels().len()),
            thrusters: ReactionControl::new(&settings.thrusters, time_s),
            by_thrusters: false,
            thrusters_limited: false,
            dump: None,
            dumps: Dumps::default(),
            spacing: DumpSpacing::default(),
            by_source: SourceMomenta::default(),
            source_torques: [[Vector3::zeros(); 2]; SOURCES.len()],
        }
    }

    /// The same with panels that turn.
    #[must_use]
    pub fn with_panels(mut self, prepared: &PreparedSpacecraft<'_>, panels: PanelMotion) -> Self {
        self.motion.add_hinges(panels.internal(prepared.panels, &self.mass, self.motion.end_s()));
        self.panels = panels;
        self
    }

    /// Whether its numbers can come from a flight of a body with so many wheels, thrusters, modal coordinates and panels; bytes
    /// from elsewhere may hold anything.
    pub fn is_sound(&self, wheels: usize, thrusters: usize, oscillators: usize, panels: usize) -> bool {
        let sound = |x: &f64| x.abs() <= GREATEST_IN_STATE;
        let vector = |vector: &Vector3<f64>| vector.iter().all(sound);
        let mass = |mass: &MassProperties| {
            mass.mass_kg > 0.0
                && sound(&mass.mass_kg)
                && vector(&mass.center_of_mass_body_m)
                && mass.inertia_body_kg_m2.iter().all(sound)
        };
        let Estimate { attitude, rate_body_rad_s, .. } = &self.estimate;
        let norm: f64 = self.sampled.0.0.iter().map(|x| x * x).sum();
        self.motion.is_sound(wheels, oscillators)
            && mass(&self.mass)
            && mass(&self.segment_mass)
            && self.left.as_ref().is_none_or(mass)
            && self.panels.is_sound(panels)
            && self.disturbance.is_sound()
            && self.by_source.is_sound()
            && self.source_torques.iter().flatten().all(vector)
            && [self.next_sample.1, self.sampled_s, self.next_guidance_s].iter().all(sound)
            && self.next_sample.0.unsigned_abs() < 1 << 60
            && (norm - 1.0).abs() < 1e-9
            && vector(&self.sampled.1)
            && self.estimator.is_sound()
            && attitude.is_rotation()
            && rate_body_rad_s.as_ref().is_none_or(vector)
            && self.sun_sensed_body.as_ref().is_none_or(vector)
            && self.accelerometer.is_sound()
            && self.controller.is_sound()
            && self.guidance.as_ref().is_none_or(Command::is_sound)
            && self.wheels.is_sound(wheels)
            && self.thrusters.is_sound(thrusters)
            && self.dump.as_ref().is_none_or(|dump| vector(&dump.torque_body_n_m) && sound(&dump.until_s))
            && self.dumps.is_sound()
            && self.spacing.is_sound()
    }

    /// Whether it has come to `time_s` and not beyond the segment there.
    pub fn covers(&self, time_s: f64) -> bool {
        let tolerance_s = tolerance_s(time_s);
        self.motion.start_s() <= time_s + tolerance_s && time_s <= self.motion.end_s() + tolerance_s
    }

    /// Something that acts changes at `time_s`; `loads_change` tells whether light and place do.
    pub fn cut(&mut self, time_s: f64, loads_change: bool) {
        if time_s < self.motion.end_s() - tolerance_s(time_s) {
            self.motion.cut(time_s);
        }
        if loads_change {
            self.disturbance.cut(time_s);
        }
    }

    /// Takes what a step from `start_s` to `end_s` commands to the thrusters.
    pub fn command_thrusters(
        &mut self,
        settings: &DynamicsSettings,
        inputs: &DynamicsInputs<'_>,
        start_s: f64,
        end_s: f64,
    ) {
        let thrusters = &settings.thrusters;
        let pulses = self.thrusters.command_pulses(thrusters, inputs.pulse, start_s, end_s);
        if self.thrusters.command_thrust(thrusters, &inputs.thrust, start_s) || pulses {
            self.cut(start_s, false);
        }
    }

    /// Advances until the motion covers `end_s`.
    ///
    /// # Errors
    /// What ends the flight.
    pub fn advance(
        &mut self,
        settings: &mut DynamicsSettings,
        flight: &mut Flight<'_>,
        inputs: &DynamicsInputs<'_>,
        end_s: f64,
        mut report: impl FnMut(&DumpEvent),
    ) -> Result<(), PlantError> {
        self.go_on(settings, flight);
        let mut work = flight.begin_work(settings.work_limit);
        let units = if settings.gyrostat.is_rigid() { 1 } else { FLEXIBLE_UNITS };
        while self.motion.end_s() < end_s - tolerance_s(end_s) {
            let time_s = self.motion.end_s();
            work.spend(Cost::Segment, units, flight.ephemeris.evaluations(), time_s)?;
            self.take_due(settings, flight, inputs, &mut work, &mut report)?;
            let edge_s = self.thrusters.next_edge_s(&settings.thrusters, flight.propellant);
            let mut limit_s = self.next_sample.1.min(self.disturbance.end_s()).min(edge_s);
            if let Some(dump) = &self.dump {
                limit_s = limit_s.min(dump.until_s);
            }
            let mut load = self.load(inputs, time_s);
            load.internal = self.panels.internal(flight.prepared.panels, &self.segment_mass, time_s);
            self.source_torques = self.torques_by_source(inputs, time_s);
            self.motion.advance(&settings.gyrostat, self.wheels.motors(), &load, limit_s);
            flight.take_thrust(self.thrusters.load(), &self.motion)?;
        }
        Ok(())
    }

    /// The body has the mass properties of the present segment, and what flies those of the last edge of the grid.
    fn go_on(&self, settings: &mut DynamicsSettings, flight: &mut Flight<'_>) {
        settings.set_mass_properties(&self.segment_mass);
        flight.configuration.left = self.left;
    }

    /// At the present end of the motion: edges of thrusters, disturbances anew, a dump's end, the sample, where they are due.
    pub fn take_due(
        &mut self,
        settings: &mut DynamicsSettings,
        flight: &mut Flight<'_>,
        inputs: &DynamicsInputs<'_>,
        work: &mut Work,
        report: &mut impl FnMut(&DumpEvent),
    ) -> Result<(), PlantError> {
        let time_s = self.motion.end_s();
        let due_s = time_s + tolerance_s(time_s);
        self.by_source.add(&self.motion.impulses_inertial_n_m_s(&self.source_torques, time_s));
        self.source_torques = [[Vector3::zeros(); 2]; SOURCES.len()];
        if self.is_dumping(time_s) {
            self.by_source = SourceMomenta::default();
        }
        if !self.thrusters.load().law.is_none() {
            let tanks = &settings.thrusters.tanks;
            self.segment_mass = flight.propellant.mass_properties_since(&self.segment_mass, tanks, time_s);
            settings.set_mass_properties(&self.segment_mass);
        }
        self.thrusters.settle(&self.motion, flight.propellant, time_s);
        self.thrusters.take_edges(&settings.thrusters, flight.propellant, time_s);
        if self.dump.is_some_and(|dump| dump.until_s <= due_s) {
            self.dump = None;
        }
        self.wheels.fail(inputs.wheel_failed);
        if settings.control.is_none() {
            self.wheels.drive(&settings.gyrostat, inputs.wheel_torque_n_m);
        }
        let (sample_due, grid_due) = (self.next_sample.1 <= due_s, self.disturbance.end_s() <= due_s);
        if sample_due || grid_due {
            let body = self.motion.at(&settings.gyrostat, time_s);
            if grid_due {
                self.begin_interval(settings, flight, &body, work)?;
            }
            // Panels with a mass may have turned the body at once.
            let body =
                if settings.panels_have_mass { self.motion.at(&settings.gyrostat, time_s) } else { body };
            if sample_due {
                self.sample(settings, flight, inputs, &body, work, report)?;
                self.thrusters.take_edges(&settings.thrusters, flight.propellant, time_s);
            }
        }
        self.turn_mass(settings, flight, time_s);
        self.segment_mass.mass_kg = flight.configuration.mass_kg - flight.propellant.total_used_kg(time_s);
        self.thrusters.exert(&settings.thrusters, flight.propellant, &self.segment_mass, time_s);
        Ok(())
    }

    /// At an edge of the grid: orbit, mass properties and disturbances anew.
    fn begin_interval(
        &mut self,
        settings: &mut DynamicsSettings,
        flight: &mut Flight<'_>,
        body: &BodyMotion,
        work: &mut Work,
    ) -> Result<(), PlantError> {
        let time_s = self.motion.end_s();
        let used_kg = flight.propellant.total_used_kg(time_s);
        self.left = (used_kg > 0.0).then(|| {
            let loaded = flight.configuration.loaded();
            flight.propellant.mass_properties(&loaded, &settings.thrusters.tanks, time_s)
        });
        flight.configuration.left = self.left;
        flight.propagator.cut(flight.configuration, time_s, true);
        // A controller's torque lasts for a sample, and holds the rate.
        let rate_terms_body = match &settings.control {
            Some(_) => [Vector3::zeros(); 2],
            None => {
                let momentum_body = body.attitude.body_from_inertial(&body.momentum_inertial_n_m_s);
                settings.gyrostat.torque_free_rate_terms(&body.rate_body_rad_s, &momentum_body)
            }
        };
        let mut plant = flight.turning_plant(time_s, body, rate_terms_body, *work);
        let displaced =
            if settings.panels_have_mass { self.follow_panels(settings, &mut plant) } else { None };
        if let Some(body) = &displaced {
            plant = flight.turning_plant(time_s, body, rate_terms_body, *work);
        }
        self.disturbance = self.disturbance.next(&mut plant, time_s, settings.grid_s)?;
        *work = plant.work(time_s)?;
        if settings.panels_have_mass || self.left.is_some() || !settings.thrusters.thrusters.is_empty() {
            let instant = plant.instant(time_s);
            self.mass = plant.mass_properties(&instant, time_s);
            self.segment_mass = self.mass;
            settings.set_mass_properties(&self.mass);
        }
        if settings.panels_have_mass {
            let was_turning = self.panels.is_turning();
            let end_s = self.disturbance.end_s();
            let [now, end] = [time_s, end_s].map(|at_s| plant.instant(at_s));
            self.panels.turn_until(plant.hinged(), &now, &end, end_s);
            if was_turning || self.panels.is_turning() {
                self.turn_mass(settings, flight, time_s);
                let internal = self.panels.internal(flight.prepared.panels, &self.segment_mass, time_s);
                self.motion.displace(&settings.gyrostat, self.motion.attitude_at(time_s), internal);
            }
        }
        Ok(())
    }

    /// The panels go where their laws have them at the end of the motion; the body after that, where they were elsewhere.
    fn follow_panels<L: Fn(f64) -> ExternalLoad>(
        &mut self,
        settings: &mut DynamicsSettings,
        plant: &mut Plant<'_, L>,
    ) -> Option<BodyMotion> {
        let time_s = self.motion.end_s();
        let to_sun = plant.instant(time_s).geometry.to_sun.position_m.normalize();
        let hinged = plant.hinged();
        let attitude = self.panels.follow(hinged, &mut settings.gyrostat, &self.motion, &to_sun)?;
        self.mass = self.panels.mass_properties(&hinged.configuration.mass_at_zero(), hinged.panels, time_s);
        self.segment_mass = self.mass;
        settings.set_mass_properties(&self.mass);
        let internal = self.panels.internal(hinged.panels, &self.mass, time_s);
        self.motion.displace(&settings.gyrostat, attitude, internal);
        Some(self.motion.at(&settings.gyrostat, time_s))
    }

    /// Panels that turn have the body with the mass properties of `time_s`.
    fn turn_mass(&mut self, settings: &mut DynamicsSettings, flight: &Flight<'_>, time_s: f64) {
        if !self.panels.is_turning() {
            return;
        }
        let loaded = flight.configuration.loaded();
        let at_zero = match self.left {
            Some(_) => flight.propellant.mass_properties(&loaded, &settings.thrusters.tanks, time_s),
            None => loaded,
        };
        self.segment_mass = self.panels.mass_properties(&at_zero, flight.prepared.panels, time_s);
        settings.set_mass_properties(&self.segment_mass);
    }

    /// Sensors, watch of the momentum, controller.
    fn sample(
        &mut self,
        settings: &DynamicsSettings,
        flight: &mut Flight<'_>,
        inputs: &DynamicsInputs<'_>,
        body: &BodyMotion,
        work: &mut Work,
        report: &mut impl FnMut(&DumpEvent),
    ) -> Result<(), PlantError> {
        let (number, time_s) = (self.next_sample.0, self.motion.end_s());
        let next = (time_s * settings.rate_hz + 1e-6).floor() as i64 + 1;
        self.next_sample = (next, next as f64 / settings.rate_hz);
        self.measure(settings, inputs, body, number);
        let momentum_body = body.attitude.body_from_inertial(&body.momentum_inertial_n_m_s);
        let is_free = self.dump.is_none() && !self.thrusters.is_dumping() && !self.by_thrusters;
        if is_free && self.thrusters.burning().is_none() && settings.dump.exceeded(&momentum_body) {
            let event = DumpEvent {
                time_s,
                before_body_n_m_s: momentum_body,
                after_body_n_m_s: settings.dump.after(&momentum_body),
            };
            self.begin_dump(settings, event);
            report(&event);
            self.dumps.check()?;
        }
        self.thrusters.sample_dump(
            &settings.thrusters,
            flight.propellant,
            &self.motion,
            &body.momentum_inertial_n_m_s,
            &self.mass,
            time_s,
        );
        let Some(control) = &settings.control else { return Ok(()) };
        let tracked = match inputs.tracked {
            Tracked::Guidance => Tracked::Attitude(self.guided(flight, body, time_s, work)?),
            tracked => tracked,
        };
        let target = match tracked {
            Tracked::Rate(rate_body_rad_s) => ControlTarget::RateOnly { rate_body_rad_s },
            Tracked::Attitude(command) => ControlTarget::Attitude {
                attitude: command.attitude_at(time_s),
                rate_body_rad_s: command.rate_body_rad_s,
            },
            // Replaced by what guidance commands.
            Tracked::Guidance => return Ok(()),
        };
        self.control(settings, control, flight.propellant, &target, body, number);
        Ok(())
    }

    /// Star tracker, gyros, accelerometers, Sun sensors.
    fn measure(
        &mut self,
        settings: &DynamicsSettings,
        inputs: &DynamicsInputs<'_>,
        body: &BodyMotion,
        number: i64,
    ) {
        let (time_s, number) = (self.motion.end_s(), number as u64);
        let interval_s = time_s - self.sampled_s;
        if interval_s > 0.0 {
            let (before, velocity_m_s) = self.sampled;
            let increment = body.delta_v_inertial_m_s - velocity_m_s;
            let increment_body_m_s = before.halfway(&body.attitude).body_from_inertial(&increment);
            self.accelerometer.sample(&settings.accelerometer, &increment_body_m_s, interval_s, number);
        }
        self.sampled_s = time_s;
        self.sampled = (body.attitude, body.delta_v_inertial_m_s);
        let attitude = Attitude::from_unit(body.attitude);
        let rate = &body.rate_body_rad_s;
        self.estimate = self.estimator.sample(&settings.sensors, inputs.health, &attitude, rate, number);
        let (to_sun, lit_fraction) = self.disturbance.sun_at(time_s);
        self.sun_sensed_body = sensed_sun(
            &settings.sun_sensors,
            inputs.sun_sensor_failed,
            &body.attitude.body_from_inertial(&to_sun),
            lit_fraction,
            settings.sensors.seed,
            number,
        );
    }

    /// The command of internal guidance, sampled anew where that is due.
    fn guided(
        &mut self,
        flight: &mut Flight<'_>,
        body: &BodyMotion,
        time_s: f64,
        work: &mut Work,
    ) -> Result<Command, PlantError> {
        if let Some(command) = self.guidance
            && time_s < self.next_guidance_s - tolerance_s(time_s)
        {
            return Ok(command);
        }
        self.next_guidance_s = next_multiple_s(time_s + tolerance_s(time_s), GUIDANCE_INTERVAL_S);
        let totals = Totals {
            momentum_inertial_n_m_s: body.momentum_inertial_n_m_s,
            torque_integral_body_n_m_s: Vector3::zeros(),
            delta_v_inertial_m_s: body.delta_v_inertial_m_s,
        };
        let momentum = StartMomentum::Inertial(body.momentum_inertial_n_m_s);
        flight.choose_sun_place(time_s, &totals, momentum, self.guidance.is_none(), work)?;
        let guided = flight.plant(time_s, body, *work).guided_attitude(time_s);
        let held =
            Command { attitude: self.estimate.attitude, rate_body_rad_s: Vector3::zeros(), since_s: time_s };
        let command = guided.map_or(held, |guided| Command {
            attitude: Attitude::from_rotation(&guided.frame.inertial_from_body),
            rate_body_rad_s: guided.frame.rate_body_rad_s,
            since_s: time_s,
        });
        Ok(*self.guidance.insert(command))
    }

    /// The torque the controller asks for, and what wheels or thrusters give of it.
    fn control(
        &mut self,
        settings: &DynamicsSettings,
        control: &Control,
        propellant: &PropellantState,
        target: &ControlTarget,
        body: &BodyMotion,
        number: i64,
    ) {
        let (gyrostat, time_s) = (&settings.gyrostat, self.motion.end_s());
        let burning = self.thrusters.burning();
        let lacks_wheels = !self.wheels.spans(gyrostat);
        let by_thrusters =
            (burning.is_some() || lacks_wheels) && self.thrusters.spans(&settings.thrusters, &self.mass);
        let is_new = by_thrusters != self.by_thrusters;
        if is_new {
            self.by_thrusters = by_thrusters;
            self.thrusters_limited = false;
            self.controller.change_actuators();
        }
        let motion = &self.motion;
        let momentum = |k: usize| motion.rotor_n_m_s(gyrostat, k, time_s, body);
        let every = control.thrusters.samples;
        if by_thrusters {
            self.wheels.coast(&control.wheels, gyrostat, momentum);
            if !is_new && number.rem_euclid(every) != 0 {
                return;
            }
        }
        let axial = |k: usize| {
            let wheel = &gyrostat.wheels()[k];
            let carried = if wheel.locked { 0.0 } else { wheel.carried_n_m_s(&body.rate_body_rad_s) };
            momentum(k) + carried
        };
        let rotors_body_n_m_s = gyrostat.along_axes(axial);
        let constant_body_n_m = self.dump.map_or(Vector3::zeros(), |dump| dump.torque_body_n_m);
        let mut known_body_n_m = constant_body_n_m + self.thrusters.dump_torque_body_n_m();
        if let Some(set) = burning {
            let [_, torque] = settings.thrusters.nominal_thrust(set, &self.mass.center_of_mass_body_m);
            known_body_n_m += torque;
        }
        let limits = if by_thrusters { &control.thrusters.controller } else { &control.controller };
        let torque_body_n_m = self.controller.sample(
            limits,
            gyrostat.carrier_body_kg_m2(),
            target,
            &self.estimate,
            &rotors_body_n_m_s,
            &known_body_n_m,
        );
        let given = if by_thrusters {
            let period_s = limits.interval_s();
            let thrusters = &settings.thrusters;
            let given =
                self.thrusters.give(thrusters, propellant, &torque_body_n_m, &self.mass, period_s, time_s);
            self.thrusters_limited = given != Some(1.0);
            given.unwrap_or(0.0)
        } else {
            self.wheels.give(&control.wheels, gyrostat, &torque_body_n_m, momentum)
        };
        if given < 1.0 {
            self.controller.limited(&(torque_body_n_m * given));
        }
    }

    /// Thrusters bring the momentum to `target_body_n_m_s` from the present end of the motion on.
    pub fn dump_to(&mut self, settings: &DynamicsSettings, target_body_n_m_s: Vector3<f64>) -> DumpEvent {
        let time_s = self.motion.end_s();
        let body = self.motion.at(&settings.gyrostat, time_s);
        let event = DumpEvent {
            time_s,
            before_body_n_m_s: body.attitude.body_from_inertial(&body.momentum_inertial_n_m_s),
            after_body_n_m_s: target_body_n_m_s,
        };
        self.begin_dump(settings, event);
        event
    }

    fn begin_dump(&mut self, settings: &DynamicsSettings, event: DumpEvent) {
        let time_s = event.time_s;
        self.dumps = self.dumps.with(event);
        self.spacing.dumped(&event);
        self.by_source = SourceMomenta::default();
        let impulse_body_n_m_s = event.impulse_body_n_m_s();
        let center = &self.mass.center_of_mass_body_m;
        let by_thrusters = !settings.thrusters.thrusters.is_empty()
            && self.thrusters.serves_dump(&settings.thrusters, center);
        if !by_thrusters {
            let duration_s = impulse_body_n_m_s.amax() / settings.thrusters.dump_torque_n_m;
            if duration_s > 0.0 {
                let torque_body_n_m = impulse_body_n_m_s / duration_s;
                self.dump = Some(ConstantDump { torque_body_n_m, until_s: time_s + duration_s });
            }
        } else {
            let body = self.motion.at(&settings.gyrostat, time_s);
            let target = body.attitude.inertial_from_body(&event.after_body_n_m_s);
            self.thrusters.begin_dump(&self.motion, target, time_s);
        }
    }

    /// What acts from `time_s` on.
    fn load(&self, inputs: &DynamicsInputs<'_>, time_s: f64) -> BodyLoad {
        let [[force, force_slope], [torque, torque_slope]] = self.disturbance.total_at(time_s);
        let [now, slope] = (inputs.external)(time_s);
        let dump = self.dump.map_or(Vector3::zeros(), |dump| dump.torque_body_n_m);
        let thrusters = self.thrusters.load();
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
            internal: None,
        }
    }

    /// Torque by effect from `time_s` on.
    fn torques_by_source(&self, inputs: &DynamicsInputs<'_>, time_s: f64) -> [Linear; SOURCES.len()] {
        SOURCES.map(|effect| match effect {
            Effect::Applied => (inputs.external)(time_s).map(|load| load.torque_body_n_m),
            effect => self.disturbance.torque_at(effect, time_s),
        })
    }

    /// What each effect did to the momentum since the end of the last dump, at `time_s`.
    pub fn by_source(&self, time_s: f64) -> SourceMomenta {
        let mut momenta = self.by_source;
        momenta.add(&self.motion.impulses_inertial_n_m_s(&self.source_torques, time_s));
        momenta
    }

    /// The body at `time_s`.
    pub fn body(&self, settings: &DynamicsSettings, time_s: f64) -> BodyMotion {
        self.motion.at(&settings.gyrostat, time_s)
    }

    /// Where everything is and what acts at `time_s`, as the motion takes it.
    pub fn evaluation(
        &self,
        settings: &DynamicsSettings,
        flight: &mut Flight<'_>,
        body: &BodyMotion,
        external: ExternalLoad,
        time_s: f64,
    ) -> Evaluation {
        let used_kg = flight.propellant.total_used_kg(time_s);
        let left_kg = flight.configuration.mass_kg - used_kg;
        flight.configuration.left = (used_kg > 0.0).then(|| {
            let loaded = flight.configuration.loaded();
            flight.propellant.mass_properties(&loaded, &settings.thrusters.tanks, time_s)
        });
        let mut plant = flight.plant_at(time_s, body);
        let instant = plant.instant(time_s);
        let mass = MassProperties { mass_kg: left_kg, ..plant.mass_properties(&instant, time_s) };
        let panels_body_n_m_s = plant.panel_momentum_body_n_m_s(&instant, &mass, time_s);
        let mut loads = self.disturbance.loads_at(time_s);
        let [torque_body_n_m, force_body_n] = self.motion.swinging_load(&settings.gyrostat, time_s, body);
        loads[Effect::Applied] = ForceTorque {
            force_body_n: external.force_body_n + force_body_n,
            torque_body_n_m: external.torque_body_n_m + torque_body_n_m,
        };
        let thrusters = self.thrusters.load();
        loads[Effect::Thrusters] = ForceTorque {
            force_body_n: thrusters.law.force_at_n(time_s),
            torque_body_n_m: thrusters.torque_at_n_m(time_s, &body.rate_body_rad_s),
        };
        Evaluation { instant, loads, mass, panels_body_n_m_s }
    }

    /// Momentum of wheel `k` (0-based) relative to the body, in N m s.
    pub fn wheel_n_m_s(&self, settings: &DynamicsSettings, k: usize, time_s: f64, body: &BodyMotion) -> f64 {
        self.motion.rotor_n_m_s(&settings.gyrostat, k, time_s, body)
    }

    /// Displacement of flexible mode `k` (0-based), in sqrt(kg) m.
    pub fn mode_sqrt_kg_m(&self, k: usize, time_s: f64, body: &BodyMotion) -> f64 {
        self.motion.oscillator(k, time_s, body)[0]
    }

    /// Angles of slosh pendulum `k` (0-based), in rad.
    pub fn slosh_rad(
        &self,
        settings: &DynamicsSettings,
        k: usize,
        time_s: f64,
        body: &BodyMotion,
    ) -> [f64; 2] {
        let Appendages { modes, sloshes, .. } = settings.gyrostat.appendages();
        [0, 1].map(|axis| {
            let [displacement, _] = self.motion.oscillator(modes.len() + 2 * k + axis, time_s, body);
            sloshes[k].angle_rad(displacement)
        })
    }

    /// Torque of the motor of wheel `k` (0-based) that acts at `time_s`, in N m.
    pub fn motor_n_m(&self, settings: &DynamicsSettings, k: usize, time_s: f64) -> f64 {
        self.motion.motor_n_m(&settings.gyrostat, &self.wheels.motors()[k], k, time_s)
    }

    /// Thrusters of the flight.
    pub fn thrusters(&self) -> &ReactionControl {
        &self.thrusters
    }

    /// Angular impulse of the last dump by thrusters, in the body frame at its start, in N m s, and its velocity change,
    /// EME2000, in m/s.
    pub fn dumped_at(&self, time_s: f64) -> Option<[Vector3<f64>; 2]> {
        self.thrusters.dumped_at(&self.motion, time_s)
    }

    /// Sum of the accelerometers' increments along the body axes at the last sample, in m/s.
    pub fn accelerometer_body_m_s(&self) -> &Vector3<f64> {
        self.accelerometer.delta_v_body_m_s()
    }

    /// The last estimate, propagated to `time_s`.
    pub fn estimate_at(&self, time_s: f64) -> Estimate {
        let rate_body_rad_s = self.estimate.rate_body_rad_s.unwrap_or_default();
        let attitude = self.estimate.attitude.propagated(rate_body_rad_s, time_s - self.sampled_s);
        Estimate { attitude, ..self.estimate }
    }

    /// The Sun in the body frame as last sensed.
    pub fn sun_sensed_body(&self) -> Option<Vector3<f64>> {
        self.sun_sensed_body
    }

    /// Angle between estimated and commanded attitude at the last sample, in rad.
    pub fn control_error_rad(&self) -> f64 {
        self.controller.attitude_error_rad()
    }

    /// Whether the reference has come to the command.
    pub fn is_settled(&self) -> bool {
        self.controller.is_settled()
    }

    /// Whether wheels or thrusters could not give the torque asked for at the last sample.
    pub fn is_torque_limited(&self) -> bool {
        if self.by_thrusters { self.thrusters_limited } else { self.wheels.is_limited() }
    }

    /// Dumps so far.
    pub fn dumps(&self) -> &Dumps {
        &self.dumps
    }

    /// Time between dumps.
    pub fn spacing(&self) -> &DumpSpacing {
        &self.spacing
    }

    /// The torque with `others_body_n_m` of everything else, in N m, where a dump is a constant torque.
    pub fn with_dump_body_n_m(&self, others_body_n_m: &Vector3<f64>) -> Vector3<f64> {
        self.dump.map_or(*others_body_n_m, |dump| others_body_n_m + dump.torque_body_n_m)
    }

    /// Whether a dump lasts.
    pub fn is_dumping(&self, time_s: f64) -> bool {
        self.dump.is_some_and(|dump| time_s < dump.until_s) || self.thrusters.is_dumping()
    }
}

fn tolerance_s(time_s: f64) -> f64 {
    4.0 * spacing(time_s)
}
