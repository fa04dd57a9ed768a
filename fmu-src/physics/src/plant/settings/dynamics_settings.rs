//! Settings and inputs of attitude dynamics and control.

use crate::attitude::control::{
    AccelerometerSettings, Allocation, ControllerSettings, SensorHealth, SensorSettings, SunSensor,
};
use nalgebra::Vector3;

use crate::attitude::{Attitude, Gyrostat};
use crate::guidance::Guided;
use crate::propulsion::PulseCommand;
use crate::spacecraft::MassProperties;

use super::attitude_source::Command;
use super::reaction_control_settings::ThrustCommand;
use super::thruster_events::Maneuver;

/// Settings of dynamics and control.
#[derive(Clone, Debug)]
pub struct DynamicsSettings {
    /// Body and wheels.
    pub gyrostat: Gyrostat,
    /// Samples of sensors and controller a second.
    pub rate_hz: f64,
    /// Star tracker and gyros.
    pub sensors: SensorSettings,
    /// Accelerometers.
    pub accelerometer: AccelerometerSettings,
    /// Sun sensors.
    pub sun_sensors: Vec<SunSensor>,
    /// The controller; absent where wheel torques come from outside.
    pub control: Option<Control>,
    /// Edges of the disturbance grid are multiples of this, in s.
    pub grid_s: f64,
    /// Attitude, rate and wheel momenta at the start of the flight.
    pub start: StartMotion,
}

/// How body and wheels turn where a flight begins, where nothing is measured yet.
#[derive(Clone, Debug)]
pub struct StartMotion {
    /// Attitude.
    pub attitude: Attitude,
    /// Body rate, in rad/s.
    pub rate_body_rad_s: Vector3<f64>,
    /// Guidance that gives the attitude instead, if any.
    pub pointing: Option<StartPointing>,
    /// Whether that gives the rate too.
    pub rate_is_pointed: bool,
    /// Momentum of each wheel, in N m s.
    pub wheels_n_m_s: Vec<f64>,
}

/// Guidance that gives the attitude at the start of a flight.
#[derive(Clone, Debug)]
pub enum StartPointing {
    /// The orbit phase's own guidance.
    Guidance(Box<Guided>),
    /// A command.
    Command(Command),
}

impl DynamicsSettings {
    /// The body takes the inertia and centre of mass of these.
    pub(crate) fn set_mass_properties(&mut self, mass: &MassProperties) {
        self.gyrostat.set_mass_properties(mass.inertia_body_kg_m2, mass.center_of_mass_body_m);
    }
}

/// The controller and how its torque reaches wheels and thrusters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Control {
    /// Gains and limits with the wheels.
    pub controller: ControllerSettings,
    /// How torque is spread over the wheels.
    pub wheels: WheelControlSettings,
    /// With the thrusters.
    pub thrusters: ThrusterControl,
}

/// Attitude control by pulses of thrusters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThrusterControl {
    /// Gains and limits; its interval is that between two decisions.
    pub controller: ControllerSettings,
    /// Samples between two decisions.
    pub samples: i64,
}

impl ThrusterControl {
    /// Decisions every `period_s` or the nearest whole number of samples, with `controller` otherwise.
    pub fn new(controller: ControllerSettings, period_s: f64) -> Self {
        let samples = (period_s * controller.rate_hz).round().max(1.0);
        let rate_hz = controller.rate_hz / samples;
        Self {
            controller: ControllerSettings { rate_hz, keeps_reference: true, ..controller },
            samples: samples as i64,
        }
    }
}

/// Command to the controller.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Tracked {
    /// The orbit phase's own guidance.
    #[default]
    Guidance,
    /// An attitude, turning on at a constant rate.
    Attitude(Command),
    /// A body rate alone, in rad/s.
    Rate(Vector3<f64>),
}

/// Inputs of a step; filled anew in every step.
#[derive(Clone, Debug, Default)]
pub struct DynamicsInputs {
    /// Attitude or rate that the controller tracks.
    pub tracked: Tracked,
    /// Torque that each wheel is commanded in free flight, in N m.
    pub wheel_torques_n_m: Vec<f64>,
    /// Failure of each wheel.
    pub wheel_failed: Vec<bool>,
    /// Failure of each Sun sensor.
    pub sun_sensor_failed: Vec<bool>,
    /// Pulse that each thruster is commanded within the step.
    pub pulses: Vec<PulseCommand>,
    /// The delta-v commanded.
    pub thrust: ThrustCommand,
    /// Failures of star tracker and gyros.
    pub health: SensorHealth,
    /// Momentum that a dump which is requested leaves, body frame, in N m s.
    pub dump_to_body_n_m_s: Option<Vector3<f64>>,
    /// A maneuver that is requested; a dump that goes with it leaves what dumps on request do.
    pub maneuver: Option<Maneuver>,
}

/// Settings of wheel control.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelControlSettings {
    /// Rule that distributes a torque over the wheels.
    pub allocation: Allocation,
    /// Time constant with which the wheels' momenta are brought to the same distribution, in s; infinite = not at all.
    pub balance_time_s: f64,
    /// Whether the motors make up for the wheels' known friction.
    pub compensates_friction: bool,
}
