//! Report of a flight at one time, alike for every source of its attitude.

use nalgebra::Vector3;

use crate::attitude::control::{Estimate, sample_number, sensed_sun};
use crate::attitude::{Appendages, Attitude, MotionAt, motor_power_w};
use crate::environment::CartesianState;
use crate::environment::orbit::BPlane;
use crate::guidance::DownlinkStatus;
use crate::momentum::{DumpSpacing, Dumps, MomentumIntegrator, SourceMomenta, Totals};
use crate::plant::disturbances::evaluation::Evaluation;
use crate::plant::motion::osculating_orbit::OsculatingOrbit;
use crate::plant::settings::configuration::Configuration;
use crate::plant::settings::dynamics_settings::{DynamicsInputs, DynamicsSettings};
use crate::plant::settings::mode_settings::IdealSettings;
use crate::plant::settings::reaction_control_settings::ReactionControlSettings;
use crate::plant::state::dynamic_state::DynamicState;
use crate::plant::state::flight_state::EncounterPrediction;
use crate::plant::state::ideal_state::{IdealState, Maneuvers};
use crate::plant::state::propagator_state::PropagatorState;
use crate::plant::thrusters::reaction_control::Thrusters;

/// State that a flight has come to, as far as a step judges it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReachedState {
    /// Whether momentum and velocity change are finite numbers.
    pub totals_are_finite: bool,
    /// Whether a substitute stands in for a target of the attitude law on one line with the other.
    pub is_degenerate: bool,
}

/// Everything about a flight at one time.
pub struct Report<'a> {
    /// When, in s.
    pub time_s: f64,
    /// The spacecraft, and where it is.
    pub configuration: &'a Configuration,
    /// Settings of thrusters and tanks.
    pub reaction_control: &'a ReactionControlSettings,
    /// Orbit, directions of the Sun that were selected, turns of the panels.
    pub propagator: &'a PropagatorState,
    /// Thrusters and tanks.
    pub thrusters: &'a Thrusters,
    /// Time since the last periapsis, in s; 0 where the flight waits.
    pub since_periapsis_s: f64,
    /// Downlink of guidance at this time.
    pub downlink: DownlinkStatus,
    /// Row of the timeline's command in force, from 1; 0 where none is.
    pub timeline_row: usize,
    /// When the timeline's command ends, or where none is the next one begins, in s; `None`: never.
    pub timeline_until_s: Option<f64>,
    /// Geometry, attitude and loads.
    pub evaluation: &'a Evaluation,
    /// The last prediction of the next one; `None` before any.
    pub prediction: Option<EncounterPrediction>,
    /// Momentum, dumps, sensors and control.
    pub summary: FlightSummary<'a>,
}

/// The encounter's body at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EncounterReport {
    /// From the orbit's centre, EME2000.
    pub body: CartesianState,
    /// Distance of the spacecraft from its centre, in m.
    pub distance_m: f64,
    /// The osculating hyperbola about it; `None` where it is none.
    pub b_plane: Option<BPlane>,
}

impl Report<'_> {
    /// The orbit that osculates about the body that the path is integrated about; `None` where there is none, or while the flight
    /// waits.
    pub fn osculating_orbit(&self) -> Option<OsculatingOrbit> {
        let geometry = &self.evaluation.instant.geometry;
        let trajectory = &self.propagator.trajectory;
        let state = trajectory.state_from_integration_center(self.time_s).unwrap_or(geometry.spacecraft);
        let center = trajectory.integration_center(self.configuration);
        OsculatingOrbit::new(self.configuration, center, &state, &geometry.to_sun.position_m)
    }

    /// The encounter's body; `None` without one, or while the flight waits.
    pub fn encounter(&self) -> Option<EncounterReport> {
        let encounter = self.configuration.encounter?;
        let geometry = &self.evaluation.instant.geometry;
        let from_body = geometry.from_planet()?;
        Some(EncounterReport {
            body: geometry.spacecraft - from_body,
            distance_m: from_body.position_m.norm(),
            b_plane: BPlane::from_state(&from_body, encounter.gm_m3_s2),
        })
    }
}

/// Values that depend on the mode of the flight.
pub struct FlightSummary<'a> {
    time_s: f64,
    /// Momentum and velocity change so far.
    pub totals: Totals,
    /// Dumps so far.
    pub dumps: Dumps,
    /// Time between dumps.
    pub spacing: DumpSpacing,
    /// Whether a dump lasts.
    pub is_dumping: bool,
    /// Angular impulse of the last dump, in the body frame at its start, in N m s.
    pub dump_impulse_body_n_m_s: Vector3<f64>,
    /// Velocity change of the last dump, EME2000, in m/s.
    pub dump_delta_v_inertial_m_s: Vector3<f64>,
    /// Maneuvers so far.
    pub maneuvers: Maneuvers,
    /// Attitude, its quaternion continuous along the flight.
    pub attitude: Attitude,
    /// Attitude and rate as sensors know them.
    pub estimate: Estimate,
    /// The Sun in the body frame as sensed.
    pub sun_sensed_body: Option<Vector3<f64>>,
    /// Sum of the accelerometers' increments along the body axes at the last sample, in m/s.
    pub accelerometer_body_m_s: Vector3<f64>,
    /// Control of the attitude.
    pub control: ControlReport,
    body: Bodies<'a>,
}

/// Control of the attitude at one time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ControlReport {
    /// Angle between estimated and commanded attitude at the last sample, in rad.
    pub error_rad: f64,
    /// Whether the reference has come to the command.
    pub is_settled: bool,
    /// Whether wheels or thrusters could not give the torque requested at the last sample.
    pub is_limited: bool,
}

/// One wheel at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelReport {
    /// Relative to the body, in N m s.
    pub momentum_n_m_s: f64,
    /// Torque of the motor, in N m.
    pub torque_n_m: f64,
    /// In rad/s.
    pub speed_rad_s: f64,
    /// Power of the motor, in W.
    pub power_w: f64,
    /// Whether it holds all that it can.
    pub is_saturated: bool,
}

/// Body and wheels as the mode of the flight has them.
enum Bodies<'a> {
    /// Ideal wheels: their momentum without the body's own, in N m s, its rate in N m, and the body's acceleration in rad/s2.
    Ideal {
        settings: &'a IdealSettings,
        /// Momenta by effect; absent of a flight that waits.
        integrator: Option<&'a MomentumIntegrator>,
        momentum_body_n_m_s: Vector3<f64>,
        rate_body_n_m: Vector3<f64>,
        acceleration_body_rad_s2: Vector3<f64>,
    },
    /// Body and wheels by their dynamics.
    Dynamic { settings: &'a DynamicsSettings, dynamics: &'a DynamicState, at: MotionAt },
}

impl<'a> FlightSummary<'a> {
    /// Summary of an attitude that is followed ideally: ideal wheels hold the system's momentum less what the body's own rotation and
    /// panels that turn take; sensors see the true attitude.
    pub(super) fn ideal(
        simulated: &IdealState,
        settings: &'a IdealSettings,
        integrator: Option<&'a MomentumIntegrator>,
        evaluation: &Evaluation,
        inputs: &DynamicsInputs,
    ) -> Self {
        let Evaluation { instant, loads, mass, .. } = evaluation;
        let (time_s, frame) = (instant.time_s, &instant.law.frame);
        let (totals, dumps) = (simulated.integrator.totals(time_s), *simulated.integrator.dumps());
        let attitude = simulated.integrator.attitude(&frame.inertial_from_body, time_s);
        let segment = &simulated.integrator.segment;
        let structure_rate_body_n_m = segment.structure_rate_body_n_m(&mass.inertia_body_kg_m2, time_s);
        let torque_body_n_m = &loads.total().torque_body_n_m;
        Self {
            time_s,
            totals,
            dumps,
            spacing: simulated.spacing,
            is_dumping: false,
            dump_impulse_body_n_m_s: impulse_body_n_m_s(&dumps),
            dump_delta_v_inertial_m_s: simulated.dump_delta_v_inertial_m_s,
            maneuvers: simulated.maneuvers,
            attitude,
            estimate: Estimate {
                attitude,
                is_valid: inputs.health.star_tracker,
                rate_body_rad_s: Some(frame.rate_body_rad_s),
            },
            sun_sensed_body: sensed_sun(
                &settings.sun_sensors,
                |k| inputs.sun_sensor_failed.get(k).is_some_and(|failed| *failed),
                &instant.sun_body,
                instant.lit_fraction,
                (settings.seed, sample_number(time_s, settings.rate_hz)),
            ),
            accelerometer_body_m_s: Vector3::zeros(),
            control: ControlReport::default(),
            body: Bodies::Ideal {
                settings,
                integrator,
                momentum_body_n_m_s: totals.wheels_body_n_m_s(&evaluation.structure_body_n_m_s(), frame),
                rate_body_n_m: totals.wheels_rate_body_n_m(&structure_rate_body_n_m, frame, torque_body_n_m),
                acceleration_body_rad_s2: segment.acceleration_body_rad_s2(time_s),
            },
        }
    }

    /// Summary of a body that turns by torque.
    pub(super) fn dynamic(
        dynamics: &'a DynamicState,
        settings: &'a DynamicsSettings,
        thrusters: &Thrusters,
        evaluation: &Evaluation,
        at: MotionAt,
    ) -> Self {
        let MotionAt { time_s, body, .. } = at;
        let DynamicState { motion, sensing, control, dumps, .. } = dynamics;
        let dumped = thrusters.dumped_at(motion, time_s);
        let [dump_impulse_body_n_m_s, dump_delta_v_inertial_m_s] =
            dumped.unwrap_or([impulse_body_n_m_s(&dumps.dumps), Vector3::zeros()]);
        let is_controlled = settings.control.is_some();
        Self {
            time_s,
            totals: dynamic_totals(&at),
            dumps: dumps.dumps,
            spacing: dumps.spacing,
            is_dumping: dumps.is_dumping(thrusters, time_s),
            dump_impulse_body_n_m_s,
            dump_delta_v_inertial_m_s,
            maneuvers: Maneuvers::default(),
            attitude: Attitude::from_rotation(&evaluation.instant.law.frame.inertial_from_body)
                .continuing(&body.attitude),
            estimate: sensing.estimate_at(time_s),
            sun_sensed_body: sensing.sun_sensed_body,
            accelerometer_body_m_s: *sensing.accelerometer.delta_v_body_m_s(),
            control: ControlReport {
                error_rad: if is_controlled { control.controller.attitude_error_rad() } else { 0.0 },
                is_settled: is_controlled && control.controller.is_settled(),
                is_limited: control.is_limited(),
            },
            body: Bodies::Dynamic { settings, dynamics, at },
        }
    }

    /// Change of momentum by each effect since the last dump.
    pub fn by_source(&self) -> SourceMomenta {
        match &self.body {
            Bodies::Ideal { integrator, .. } => {
                integrator.map_or_else(SourceMomenta::default, |it| it.by_source(self.time_s))
            }
            Bodies::Dynamic { dynamics, at, .. } => dynamics.dumps.by_source(&dynamics.motion, at),
        }
    }

    /// Momentum that no ideal wheel holds, body frame, in N m s: the part across the wheels' axes, and beyond their capacities; zero where
    /// the body turns by torque.
    pub fn unheld_body_n_m_s(&self) -> Vector3<f64> {
        let Bodies::Ideal { settings, momentum_body_n_m_s, .. } = &self.body else { return Vector3::zeros() };
        let held = settings.wheels.iter().enumerate().map(|(k, wheel)| {
            settings.momentum_n_m_s(k, momentum_body_n_m_s).clamp(-wheel.capacity_n_m_s, wheel.capacity_n_m_s)
        });
        momentum_body_n_m_s - settings.array.sum_body_n_m_s(held)
    }

    /// Wheel `k` (0-based).
    pub fn wheel(&self, k: usize) -> Option<WheelReport> {
        let (momentum_n_m_s, torque_n_m, speed_rad_s, is_saturated) = match &self.body {
            Bodies::Ideal {
                settings, momentum_body_n_m_s, rate_body_n_m, acceleration_body_rad_s2, ..
            } => {
                let wheel = settings.wheels.get(k)?;
                let momentum_n_m_s = settings.momentum_n_m_s(k, momentum_body_n_m_s);
                let (array, inertia_kg_m2) = (&settings.array, wheel.inertia_kg_m2);
                let torque_n_m = array.motor_n_m(k, inertia_kg_m2, rate_body_n_m, acceleration_body_rad_s2);
                let is_saturated = momentum_n_m_s.abs() > wheel.capacity_n_m_s;
                (momentum_n_m_s, torque_n_m, wheel.speed_rad_s(momentum_n_m_s), is_saturated)
            }
            Bodies::Dynamic { settings, dynamics, at: MotionAt { body, .. } } => {
                let (gyrostat, motion) = (&settings.gyrostat, &dynamics.motion);
                let wheel = gyrostat.wheels().get(k)?;
                let momentum_n_m_s = motion.rotor_n_m_s(gyrostat, k, self.time_s, body);
                let motor = dynamics.control.wheels.motors.get(k)?;
                let torque_n_m = motion.motor_n_m(gyrostat, motor, k, self.time_s);
                let speed_rad_s = wheel.speed_rad_s(momentum_n_m_s);
                (momentum_n_m_s, torque_n_m, speed_rad_s, wheel.is_saturated(momentum_n_m_s))
            }
        };
        let power_w = motor_power_w(torque_n_m, speed_rad_s);
        Some(WheelReport { momentum_n_m_s, torque_n_m, speed_rad_s, power_w, is_saturated })
    }

    /// Displacement of flexible mode `k` (0-based), in sqrt(kg) m.
    pub fn mode_sqrt_kg_m(&self, k: usize) -> f64 {
        match &self.body {
            Bodies::Ideal { .. } => 0.0,
            Bodies::Dynamic { dynamics, at, .. } => dynamics.motion.oscillator(k, self.time_s, &at.body)[0],
        }
    }

    /// Angles of slosh pendulum `k` (0-based), in rad.
    pub fn slosh_rad(&self, k: usize) -> [f64; 2] {
        let Bodies::Dynamic { settings, dynamics, at } = &self.body else { return [0.0; 2] };
        let Appendages { modes, sloshes, .. } = settings.gyrostat.appendages();
        [0, 1].map(|axis| {
            let place = modes.len() + 2 * k + axis;
            let [displacement, _] = dynamics.motion.oscillator(place, self.time_s, &at.body);
            sloshes[k].angle_rad(displacement)
        })
    }
}

/// Momentum and velocity change of a body that turns by torque.
pub(super) fn dynamic_totals(MotionAt { body, .. }: &MotionAt) -> Totals {
    Totals {
        momentum_inertial_n_m_s: body.momentum_inertial_n_m_s,
        delta_v_inertial_m_s: body.delta_v_inertial_m_s,
        ..Totals::default()
    }
}

fn impulse_body_n_m_s(dumps: &Dumps) -> Vector3<f64> {
    dumps.last.map_or(Vector3::zeros(), |event| event.impulse_body_n_m_s())
}
