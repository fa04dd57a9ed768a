//! Attitude dynamics of the plant: a rigid body with wheels under disturbances, sampled sensors, and either a controller that
//! tracks a command or wheel torques from outside.
//!
//! Sensors and controller are sampled at a fixed rate; motor torques hold over a sample. A sample at t belongs to the step
//! that begins at t and reads that step's inputs. Between two samples, edges of the disturbance grid, ends of dumps and
//! changes of inputs the motion is one [`GyrostatMotion`] segment or a few; communication points only evaluate it.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use crate::attitude::control::{
    Allocation, ControlTarget, ControllerSettings, ControllerState, Estimate, EstimatorState, SensorHealth,
    SensorSettings, SunSensor, WheelAllocator, sensed_sun,
};
use crate::attitude::{Attitude, BodyLoad, BodyMotion, Gyrostat, GyrostatMotion, Motor, MovingFrame};
use crate::environment::ephemeris::Ephemeris;
use crate::momentum::{DumpEvent, DumpPolicy, DumpSpacing, Dumps, TorqueModel};
use crate::numerics::chebyshev::GREATEST_IN_STATE;
use crate::numerics::intervals::next_multiple_s;
use crate::numerics::spacing::spacing;
use crate::radiation::{Effect, ForceTorque};

use super::configuration::{AttitudeSource, Command, Configuration, DynamicAttitude};
use super::disturbance_interval::DisturbanceInterval;
use super::error::PlantError;
use super::evaluation::{Evaluation, ExternalLoad, Plant, PreparedSpacecraft};
use super::propagator_state::PropagatorState;
use super::radiation_solver::RadiationSolver;
use super::work::{Cost, WorkExceeded};

/// Guidance is sampled at whole multiples of this, in s.
const GUIDANCE_INTERVAL_S: f64 = 1.0;
/// Segments of motion that cost about a microsecond.
const SEGMENTS_A_UNIT: u32 = 1;

/// What parameters say about dynamics and control.
#[derive(Clone, Debug)]
pub struct DynamicsSettings {
    /// Body and wheels.
    pub gyrostat: Gyrostat,
    /// Samples of sensors and controller a second.
    pub rate_hz: f64,
    /// Star tracker and gyros.
    pub sensors: SensorSettings,
    /// Sun sensors.
    pub sun_sensors: Vec<SunSensor>,
    /// The controller; absent where wheel torques come from outside.
    pub control: Option<Control>,
    /// Thresholds and what a dump leaves.
    pub dump: DumpPolicy,
    /// Greatest component of the thrusters' torque during a dump, body frame, in N m.
    pub dump_torque_n_m: f64,
    /// Edges of the disturbance grid are multiples of this, in s.
    pub grid_s: f64,
    /// Whether panels that turn have a mass: the inertia then follows them from one edge of the grid to the next.
    pub panels_have_mass: bool,
    /// Units of about a microsecond that a step may take.
    pub work_limit: u32,
}

/// The controller and how its torque reaches the wheels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Control {
    /// Gains and limits.
    pub controller: ControllerSettings,
    /// How torque is spread over the wheels.
    pub allocation: Allocation,
    /// Time constant with which the wheels' momenta are brought to the same distribution, in s; infinite = not at all.
    pub balance_time_s: f64,
    /// Whether the motors make up for the wheels' known friction.
    pub compensates_friction: bool,
}

/// What is commanded to the controller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tracked {
    /// The orbit phase's own guidance.
    Guidance,
    /// An attitude, turning on at a constant rate.
    Attitude(Command),
    /// A body rate alone, in rad/s.
    Rate(Vector3<f64>),
}

/// What the inputs of a step say.
pub struct DynamicsInputs<'i> {
    /// What the controller tracks.
    pub tracked: Tracked,
    /// Torque that wheel k (0-based) is commanded in free flight, in N m.
    pub wheel_torque_n_m: &'i dyn Fn(usize) -> f64,
    /// Whether wheel k (0-based) failed.
    pub wheel_failed: &'i dyn Fn(usize) -> bool,
    /// Whether Sun sensor k (0-based) failed.
    pub sun_sensor_failed: &'i dyn Fn(usize) -> bool,
    /// Which of star tracker and gyros work.
    pub health: SensorHealth,
    /// Force and torque from outside at a time, body frame, and how they change per second.
    pub external: &'i dyn Fn(f64) -> [ExternalLoad; 2],
}

/// Where the body flies: everything that its loads follow from.
pub struct Flight<'f> {
    /// The spacecraft.
    pub prepared: PreparedSpacecraft<'f>,
    /// What flies, where; its attitude is set here.
    pub configuration: &'f mut Configuration,
    /// Orbit, light and heat.
    pub propagator: &'f mut PropagatorState,
    /// Planets.
    pub ephemeris: &'f mut Ephemeris,
    /// Light and heat beyond direct sunlight.
    pub light: Option<&'f mut RadiationSolver>,
    /// Force and torque from outside at a time, body frame, by which an orbit goes that forces act on.
    pub external: &'f dyn Fn(f64) -> ExternalLoad,
}

impl Flight<'_> {
    /// Frame and rate that the orbit phase's own guidance commands where the flight begins; `None` without it.
    ///
    /// # Errors
    /// What ends a flight.
    pub fn guided_start(&mut self, time_s: f64, work_limit: u32) -> Result<Option<MovingFrame>, PlantError> {
        let mut plant = Plant::new(
            self.prepared,
            self.configuration,
            self.propagator,
            self.ephemeris,
            self.light.as_deref_mut(),
            self.external,
            work_limit,
        );
        plant.prepare(time_s, time_s)?;
        Ok(plant.guided_frame(time_s))
    }

    /// Inertia with the panels as they stand where the flight begins in this attitude, in kg m2.
    pub fn inertia_at_start(&mut self, time_s: f64, attitude: Attitude) -> Matrix3<f64> {
        let body = BodyMotion {
            attitude: attitude.unit_quaternion(),
            rate_body_rad_s: Vector3::zeros(),
            momentum_inertial_n_m_s: Vector3::zeros(),
            delta_v_inertial_m_s: Vector3::zeros(),
        };
        let mut plant = self.plant(time_s, &body, u32::MAX);
        let instant = plant.instant(time_s);
        plant.mass_properties(&instant).inertia_body_kg_m2
    }

    /// The plant with the body as it turns now.
    fn plant(
        &mut self,
        time_s: f64,
        body: &BodyMotion,
        work_limit: u32,
    ) -> Plant<'_, &dyn Fn(f64) -> ExternalLoad> {
        let motion = Command {
            attitude: Attitude::from_unit(body.attitude),
            rate_body_rad_s: body.rate_body_rad_s,
            since_s: time_s,
        };
        let guided = self.configuration.attitude.guided().copied();
        self.configuration.attitude = AttitudeSource::Dynamic(DynamicAttitude { motion, guided });
        Plant::new(
            self.prepared,
            self.configuration,
            self.propagator,
            self.ephemeris,
            self.light.as_deref_mut(),
            self.external,
            work_limit,
        )
    }
}

/// A dump that lasts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct ActiveDump {
    torque_body_n_m: Vector3<f64>,
    until_s: f64,
}

/// State of the attitude dynamics: body, wheels, sensors, controller, dumps.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct AttitudeDynamics {
    motion: GyrostatMotion,
    /// Inertia of body and rotors since the last edge of the grid, in kg m2.
    inertia_body_kg_m2: Matrix3<f64>,
    disturbance: DisturbanceInterval,
    /// Number of the next sample and its time, in s.
    next_sample: (i64, f64),
    sampled_s: f64,
    estimator: EstimatorState,
    estimate: Estimate,
    sun_sensed_body: Option<Vector3<f64>>,
    controller: ControllerState,
    /// What guidance commanded last.
    guidance: Option<Command>,
    /// When guidance is sampled next, in s.
    next_guidance_s: f64,
    motors: Vec<Motor>,
    /// Whether the wheels could not give the torque that was asked for.
    torque_limited: bool,
    dump: Option<ActiveDump>,
    dumps: Dumps,
    spacing: DumpSpacing,
    #[serde(skip)]
    allocator: Option<CachedAllocator>,
}

/// The distribution over the wheels that work; a cache.
#[derive(Clone, Debug)]
struct CachedAllocator {
    works: Vec<bool>,
    allocator: Option<WheelAllocator>,
    shares: Vec<f64>,
    balance: Vec<f64>,
}

impl AttitudeDynamics {
    /// At the start of a flight, in this attitude and at this rate, the wheels holding these momenta, in N m s.
    pub fn new(
        settings: &DynamicsSettings,
        time_s: f64,
        attitude: Attitude,
        rate_body_rad_s: Vector3<f64>,
        wheels_n_m_s: impl Fn(usize) -> f64,
    ) -> Self {
        let unit = attitude.unit_quaternion();
        let number = (time_s * settings.rate_hz).floor() as i64;
        Self {
            motion: GyrostatMotion::new(&settings.gyrostat, time_s, unit, &rate_body_rad_s, wheels_n_m_s),
            inertia_body_kg_m2: *settings.gyrostat.inertia_body_kg_m2(),
            disturbance: DisturbanceInterval::before(),
            next_sample: (number, time_s),
            sampled_s: time_s,
            estimator: EstimatorState::new(&settings.sensors, attitude),
            estimate: Estimate { attitude, is_valid: true, rate_body_rad_s: Some(rate_body_rad_s) },
            sun_sensed_body: None,
            controller: ControllerState::new(attitude, rate_body_rad_s),
            guidance: None,
            next_guidance_s: time_s,
            motors: vec![Motor::default(); settings.gyrostat.wheels().len()],
            torque_limited: false,
            dump: None,
            dumps: Dumps::default(),
            spacing: DumpSpacing::default(),
            allocator: None,
        }
    }

    /// Whether its numbers can come from a flight of a body with so many wheels; bytes from elsewhere may hold anything.
    pub fn is_sound(&self, wheels: usize) -> bool {
        let sound = |x: &f64| x.abs() <= GREATEST_IN_STATE;
        let vector = |vector: &Vector3<f64>| vector.iter().all(sound);
        let Estimate { attitude, rate_body_rad_s, .. } = &self.estimate;
        self.motion.is_sound(wheels)
            && self.inertia_body_kg_m2.iter().all(sound)
            && self.disturbance.is_sound()
            && [self.next_sample.1, self.sampled_s, self.next_guidance_s].iter().all(sound)
            && self.next_sample.0.unsigned_abs() < 1 << 60
            && self.estimator.is_sound()
            && attitude.is_rotation()
            && rate_body_rad_s.as_ref().is_none_or(vector)
            && self.sun_sensed_body.as_ref().is_none_or(vector)
            && self.controller.is_sound()
            && self.guidance.as_ref().is_none_or(Command::is_sound)
            && self.motors.len() == wheels
            && self.motors.iter().all(|motor| sound(&motor.torque_n_m))
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
        settings.gyrostat.set_inertia(self.inertia_body_kg_m2);
        let mut left = settings.work_limit;
        while self.motion.end_s() < end_s - tolerance_s(end_s) {
            let time_s = self.motion.end_s();
            left = left.checked_sub(SEGMENTS_A_UNIT).ok_or(WorkExceeded {
                limit: settings.work_limit,
                reached_s: time_s,
                most: Cost::Segment,
            })?;
            self.take_due(settings, flight, inputs, left, &mut report)?;
            let mut limit_s = self.next_sample.1.min(self.disturbance.end_s());
            if let Some(dump) = &self.dump {
                limit_s = limit_s.min(dump.until_s);
            }
            let load = self.load(flight.configuration.mass_kg, inputs, time_s);
            self.motion.advance(&settings.gyrostat, &self.motors, &load, limit_s);
        }
        Ok(())
    }

    /// At the present end of the motion: disturbances anew, a dump's end, the sample, where they are due.
    pub fn take_due(
        &mut self,
        settings: &mut DynamicsSettings,
        flight: &mut Flight<'_>,
        inputs: &DynamicsInputs<'_>,
        work_limit: u32,
        report: &mut impl FnMut(&DumpEvent),
    ) -> Result<(), PlantError> {
        let time_s = self.motion.end_s();
        let due_s = time_s + tolerance_s(time_s);
        if self.dump.is_some_and(|dump| dump.until_s <= due_s) {
            self.dump = None;
        }
        let (sample_due, grid_due) = (self.next_sample.1 <= due_s, self.disturbance.end_s() <= due_s);
        for (k, motor) in self.motors.iter_mut().enumerate() {
            motor.failed = (inputs.wheel_failed)(k);
            if settings.control.is_none() {
                let most_n_m = settings.gyrostat.wheels()[k].max_torque_n_m;
                motor.torque_n_m = (inputs.wheel_torque_n_m)(k).clamp(-most_n_m, most_n_m);
            }
            if motor.failed {
                motor.torque_n_m = 0.0;
            }
        }
        if !(sample_due || grid_due) {
            return Ok(());
        }
        let body = self.motion.at(&settings.gyrostat, time_s);
        if grid_due {
            let limit_s = next_multiple_s(time_s, settings.grid_s);
            let configuration = &*flight.configuration;
            flight.propagator.cut(configuration, time_s, true);
            let mut plant = flight.plant(time_s, &body, work_limit);
            self.disturbance = DisturbanceInterval::build(&mut plant, time_s, limit_s)?;
            if settings.panels_have_mass {
                let instant = plant.instant(time_s);
                self.inertia_body_kg_m2 = plant.mass_properties(&instant).inertia_body_kg_m2;
                settings.gyrostat.set_inertia(self.inertia_body_kg_m2);
            }
        }
        if sample_due {
            self.sample(settings, flight, inputs, &body, work_limit, report)?;
        }
        Ok(())
    }

    /// Sensors, watch of the momentum, controller.
    fn sample(
        &mut self,
        settings: &DynamicsSettings,
        flight: &mut Flight<'_>,
        inputs: &DynamicsInputs<'_>,
        body: &BodyMotion,
        work_limit: u32,
        report: &mut impl FnMut(&DumpEvent),
    ) -> Result<(), PlantError> {
        let (number, time_s) = (self.next_sample.0, self.motion.end_s());
        let next = (time_s * settings.rate_hz + 1e-6).floor() as i64 + 1;
        self.next_sample = (next, next as f64 / settings.rate_hz);
        self.sampled_s = time_s;
        let attitude = Attitude::from_unit(body.attitude);
        self.estimate = self.estimator.sample(
            &settings.sensors,
            inputs.health,
            &attitude,
            &body.rate_body_rad_s,
            number as u64,
        );
        let (to_sun, lit_fraction) = self.disturbance.sun_at(time_s);
        self.sun_sensed_body = sensed_sun(
            &settings.sun_sensors,
            inputs.sun_sensor_failed,
            &body.attitude.body_from_inertial(&to_sun),
            lit_fraction,
            settings.sensors.seed,
            number as u64,
        );
        let momentum_body = body.attitude.body_from_inertial(&body.momentum_inertial_n_m_s);
        if self.dump.is_none() && settings.dump.exceeded(&momentum_body) {
            let event = DumpEvent {
                time_s,
                before_body_n_m_s: momentum_body,
                after_body_n_m_s: settings.dump.after(&momentum_body),
            };
            self.begin_dump(settings, event);
            report(&event);
            self.dumps.check()?;
        }
        let Some(control) = &settings.control else { return Ok(()) };
        let tracked = match inputs.tracked {
            Tracked::Guidance => Tracked::Attitude(self.guided(flight, body, time_s, work_limit)),
            tracked => tracked,
        };
        self.control(settings, control, tracked, body, time_s);
        Ok(())
    }

    /// The command of internal guidance, sampled anew where that is due.
    fn guided(
        &mut self,
        flight: &mut Flight<'_>,
        body: &BodyMotion,
        time_s: f64,
        work_limit: u32,
    ) -> Command {
        if let Some(command) = self.guidance
            && time_s < self.next_guidance_s - tolerance_s(time_s)
        {
            return command;
        }
        self.next_guidance_s = next_multiple_s(time_s + tolerance_s(time_s), GUIDANCE_INTERVAL_S);
        let frame = flight.plant(time_s, body, work_limit).guided_frame(time_s);
        let held =
            Command { attitude: self.estimate.attitude, rate_body_rad_s: Vector3::zeros(), since_s: time_s };
        let command = frame.map_or(held, |frame| Command {
            attitude: Attitude::from_rotation(&frame.inertial_from_body),
            rate_body_rad_s: frame.rate_body_rad_s,
            since_s: time_s,
        });
        *self.guidance.insert(command)
    }

    /// The torque the controller asks for, and what the motors give of it.
    fn control(
        &mut self,
        settings: &DynamicsSettings,
        control: &Control,
        tracked: Tracked,
        body: &BodyMotion,
        time_s: f64,
    ) {
        let gyrostat = &settings.gyrostat;
        let target = match tracked {
            Tracked::Rate(rate_body_rad_s) => ControlTarget::RateOnly { rate_body_rad_s },
            Tracked::Attitude(command) => ControlTarget::Attitude {
                attitude: command.attitude_at(time_s),
                rate_body_rad_s: command.rate_body_rad_s,
            },
            // Replaced by what guidance commands.
            Tracked::Guidance => return,
        };
        let momentum = |k: usize| self.motion.rotor_n_m_s(gyrostat, k, time_s, body);
        let axial = |k: usize| {
            let wheel = &gyrostat.wheels()[k];
            let carried = if wheel.locked { 0.0 } else { wheel.carried_n_m_s(&body.rate_body_rad_s) };
            momentum(k) + carried
        };
        let rotors_body_n_m_s = gyrostat.along_axes(axial);
        let external_body_n_m = self.dump.map_or(Vector3::zeros(), |dump| dump.torque_body_n_m);
        let torque_body_n_m = self.controller.sample(
            &control.controller,
            gyrostat.carrier_body_kg_m2(),
            &target,
            &self.estimate,
            &rotors_body_n_m_s,
            &external_body_n_m,
        );
        let motors = &self.motors;
        let is_known = self.allocator.as_ref().is_some_and(|cached| {
            cached.works.iter().zip(motors).all(|(works, motor)| *works != motor.failed)
        });
        if !is_known {
            let works: Vec<bool> = motors.iter().map(|motor| !motor.failed).collect();
            let axes: Vec<_> = gyrostat.wheels().iter().map(|wheel| wheel.axis_body).collect();
            let can_turn = |k: usize| works[k] && !gyrostat.wheels()[k].locked;
            self.allocator = Some(CachedAllocator {
                allocator: WheelAllocator::new(&axes, can_turn),
                shares: vec![0.0; works.len()],
                balance: vec![0.0; works.len()],
                works,
            });
        }
        let Some(CachedAllocator { allocator, shares, balance, .. }) = &mut self.allocator else { return };
        let Some(allocator) = allocator else {
            self.motors.iter_mut().for_each(|motor| motor.torque_n_m = 0.0);
            self.torque_limited = true;
            self.controller.limited(&Vector3::zeros());
            return;
        };
        // The body feels the opposite of what the motors exert on the rotors.
        allocator.distribute(control.allocation, &-torque_body_n_m, shares);
        let turns = |k: usize| !self.motors[k].failed && !gyrostat.wheels()[k].locked;
        let working_body_n_m_s = gyrostat.along_axes(|k| if turns(k) { momentum(k) } else { 0.0 });
        allocator.distribute(control.allocation, &working_body_n_m_s, balance);
        let mut given = 1.0_f64;
        for (k, wheel) in gyrostat.wheels().iter().enumerate() {
            let friction = if control.compensates_friction { wheel.friction_n_m(momentum(k)) } else { 0.0 };
            // Motor torque without the share that is asked for: friction and balance.
            balance[k] =
                if turns(k) { friction + (balance[k] - momentum(k)) / control.balance_time_s } else { 0.0 };
            balance[k] = balance[k].clamp(-wheel.max_torque_n_m, wheel.max_torque_n_m);
            let most = wheel.max_torque_n_m - balance[k] * shares[k].signum();
            if shares[k].abs() > most {
                given = given.min(most / shares[k].abs());
            }
        }
        for (motor, (share, other)) in self.motors.iter_mut().zip(shares.iter().zip(balance.iter())) {
            motor.torque_n_m = share * given + other;
        }
        self.torque_limited = given < 1.0;
        if self.torque_limited {
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
        let impulse_body_n_m_s = event.impulse_body_n_m_s();
        let duration_s = impulse_body_n_m_s.amax() / settings.dump_torque_n_m;
        self.dumps = self.dumps.with(event);
        self.spacing.dumped(&event);
        if duration_s > 0.0 {
            let torque_body_n_m = impulse_body_n_m_s / duration_s;
            self.dump = Some(ActiveDump { torque_body_n_m, until_s: event.time_s + duration_s });
        }
    }

    /// What acts from `time_s` on.
    fn load(&self, mass_kg: f64, inputs: &DynamicsInputs<'_>, time_s: f64) -> BodyLoad {
        let [[force, force_slope], [torque, torque_slope]] = self.disturbance.total_at(time_s);
        let [now, slope] = (inputs.external)(time_s);
        let dump = self.dump.map_or(Vector3::zeros(), |dump| dump.torque_body_n_m);
        BodyLoad {
            torque_body_n_m: [torque + now.torque_body_n_m + dump, torque_slope + slope.torque_body_n_m],
            force_body_n: [force + now.force_body_n, force_slope + slope.force_body_n],
            mass_kg,
            flow_kg_s: [0.0; 2],
        }
    }

    /// The body at `time_s`.
    pub fn body(&self, settings: &DynamicsSettings, time_s: f64) -> BodyMotion {
        self.motion.at(&settings.gyrostat, time_s)
    }

    /// Where everything is and what acts at `time_s`, as the motion takes it.
    pub fn evaluation(
        &self,
        flight: &mut Flight<'_>,
        body: &BodyMotion,
        external: ExternalLoad,
        time_s: f64,
    ) -> Evaluation {
        let mut plant = flight.plant(time_s, body, u32::MAX);
        let instant = plant.instant(time_s);
        let mass = plant.mass_properties(&instant);
        let mut loads = self.disturbance.loads_at(time_s);
        loads[Effect::Applied] =
            ForceTorque { force_body_n: external.force_body_n, torque_body_n_m: external.torque_body_n_m };
        Evaluation { instant, loads, mass }
    }

    /// Momentum of wheel `k` (0-based) relative to the body, in N m s.
    pub fn wheel_n_m_s(&self, settings: &DynamicsSettings, k: usize, time_s: f64, body: &BodyMotion) -> f64 {
        self.motion.rotor_n_m_s(&settings.gyrostat, k, time_s, body)
    }

    /// Torque of the motor of wheel `k` (0-based), in N m.
    pub fn motor_n_m(&self, k: usize) -> f64 {
        self.motors[k].torque_n_m
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

    /// Whether the wheels could not give the torque asked for at the last sample.
    pub fn is_torque_limited(&self) -> bool {
        self.torque_limited
    }

    /// Dumps so far.
    pub fn dumps(&self) -> &Dumps {
        &self.dumps
    }

    /// Time between dumps.
    pub fn spacing(&self) -> &DumpSpacing {
        &self.spacing
    }

    /// The torque with `others_body_n_m` of everything else, in N m, while thrusters are dumping.
    pub fn with_dump_body_n_m(&self, others_body_n_m: &Vector3<f64>) -> Vector3<f64> {
        self.dump.map_or(*others_body_n_m, |dump| others_body_n_m + dump.torque_body_n_m)
    }

    /// Whether thrusters are dumping.
    pub fn is_dumping(&self, time_s: f64) -> bool {
        self.dump.is_some_and(|dump| time_s < dump.until_s)
    }
}

fn tolerance_s(time_s: f64) -> f64 {
    4.0 * spacing(time_s)
}
