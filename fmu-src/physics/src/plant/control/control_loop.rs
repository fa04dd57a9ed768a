//! Control loop of a flight: what guidance commands, the torque that the controller asks for, and what wheels or thrusters give
//! of it.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::attitude::control::{ControlTarget, ControllerState, Estimate};
use crate::attitude::{Attitude, Gyrostat, GyrostatMotion, MotionAt};
use crate::guidance::{DownlinkStatus, GuidedAttitude};
use crate::numerics::intervals::next_multiple_s;
use crate::numerics::spacing::spacing;

use super::wheel_control::{WheelControl, WheelDistribution};
use crate::plant::settings::attitude_source::Command;
use crate::plant::settings::dynamics_settings::Control;
use crate::plant::thrusters::allocation::ThrusterAllocator;
use crate::plant::thrusters::reaction_control::Thrusters;
use crate::spacecraft::MassProperties;

/// Guidance is sampled at whole multiples of this, in s.
const GUIDANCE_INTERVAL_S: f64 = 1.0;

/// Guidance, controller and what it acts through.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct ControlLoop {
    /// Controller.
    pub controller: ControllerState,
    /// Motors.
    pub wheels: WheelControl,
    /// Last command of guidance.
    pub guidance: Option<Command>,
    /// Downlink as the last sample of guidance reported it.
    pub downlink: DownlinkStatus,
    /// Whether a substitute stood in for a target of its law.
    pub is_degenerate: bool,
    /// When guidance is sampled next, in s.
    next_guidance_s: f64,
    /// Whether thrusters control the attitude, and whether they could not give the torque requested.
    pub by_thrusters: bool,
    thrusters_limited: bool,
}

/// The body at a sample, what is known of it, and thrusters and wheels that act on it.
pub(crate) struct Sampled<'a> {
    pub number: i64,
    pub gyrostat: &'a Gyrostat,
    pub motion: &'a GyrostatMotion,
    pub at: &'a MotionAt,
    pub estimate: &'a Estimate,
    pub mass: &'a MassProperties,
    /// Torque of a dump by a constant torque, in N m.
    pub dump_body_n_m: Vector3<f64>,
    pub thrusters: &'a mut Thrusters,
    pub allocator: &'a mut ThrusterAllocator,
    pub distribution: &'a mut WheelDistribution,
}

impl ControlLoop {
    /// Control loop at the start of a flight with `wheels` wheels.
    pub(crate) fn new(wheels: usize, time_s: f64, attitude: Attitude, rate_body_rad_s: Vector3<f64>) -> Self {
        Self {
            controller: ControllerState::new(attitude, rate_body_rad_s),
            wheels: WheelControl::new(wheels),
            guidance: None,
            downlink: DownlinkStatus::default(),
            is_degenerate: false,
            next_guidance_s: time_s,
            by_thrusters: false,
            thrusters_limited: false,
        }
    }

    /// Rejects decoded states that no simulation with this number of wheels can produce.
    pub(crate) fn is_valid(&self, wheels: usize) -> bool {
        self.controller.is_valid()
            && self.wheels.motors.len() == wheels
            && self.guidance.is_none_or(|command| command.attitude.is_rotation())
    }

    /// Whether wheels or thrusters could not give the torque requested at the last sample.
    pub(crate) fn is_limited(&self) -> bool {
        if self.by_thrusters { self.thrusters_limited } else { self.wheels.is_limited }
    }

    /// The command of guidance in force at `time_s`; `None` where it is sampled anew there.
    pub(crate) fn guidance_at(&self, time_s: f64) -> Option<Command> {
        self.guidance.filter(|_| time_s < self.next_guidance_s - 4.0 * spacing(time_s))
    }

    /// Takes a sample of guidance at `time_s` as the command; without guidance the estimated attitude is held.
    pub(crate) fn guide(
        &mut self,
        time_s: f64,
        guided: Option<&GuidedAttitude>,
        estimate: &Estimate,
    ) -> Command {
        self.next_guidance_s = next_multiple_s(time_s + 4.0 * spacing(time_s), GUIDANCE_INTERVAL_S);
        self.downlink = guided.map(DownlinkStatus::from_attitude).unwrap_or_default();
        self.is_degenerate = guided.is_some_and(|guided| guided.degenerate);
        let (attitude, rate_body_rad_s) = guided.map_or((estimate.attitude, Vector3::zeros()), |guided| {
            let frame = guided.frame;
            (Attitude::from_rotation(&frame.inertial_from_body), frame.rate_body_rad_s)
        });
        *self.guidance.insert(Command { attitude, rate_body_rad_s, since_s: time_s })
    }

    /// The torque the controller asks for, and what wheels or thrusters give of it; whether the controller is sampled and has a rate.
    pub(crate) fn control(
        &mut self,
        control: &Control,
        target: &ControlTarget,
        sampled: Sampled<'_>,
    ) -> bool {
        let Sampled { number, gyrostat, motion, at, mass, .. } = sampled;
        let Sampled { thrusters, allocator, distribution, .. } = sampled;
        let time_s = motion.end_s();
        let burning = thrusters.valves.burning();
        let lacks_wheels = !self.wheels.span(distribution, gyrostat);
        let by_thrusters = (burning.is_some() || lacks_wheels) && thrusters.spans(allocator, mass, time_s);
        let is_new = by_thrusters != self.by_thrusters;
        if is_new {
            self.by_thrusters = by_thrusters;
            self.thrusters_limited = false;
            self.controller.change_actuators();
        }
        let momentum = |k: usize| motion.rotor_at_n_m_s(gyrostat, k, at);
        if by_thrusters {
            self.wheels.coast(&control.wheels, gyrostat, momentum);
            if !is_new && number.rem_euclid(control.thrusters.samples) != 0 {
                return false;
            }
        }
        let axial = |k: usize| {
            let wheel = &gyrostat.wheels()[k];
            let carried = if wheel.locked { 0.0 } else { wheel.carried_n_m_s(&at.body.rate_body_rad_s) };
            momentum(k) + carried
        };
        let rotors_body_n_m_s = gyrostat.along_axes(axial);
        let pulsed_body_n_m = thrusters.current_dump().map_or(Vector3::zeros(), |it| it.mean_torque_body_n_m);
        let mut known_body_n_m = sampled.dump_body_n_m + pulsed_body_n_m;
        if let Some(set) = burning {
            let [_, torque] = allocator.settings.nominal_thrust(set, &mass.center_of_mass_body_m);
            known_body_n_m += torque;
        }
        let limits = if by_thrusters { &control.thrusters.controller } else { &control.controller };
        let torque_body_n_m = self.controller.sample(
            limits,
            gyrostat.carrier_body_kg_m2(),
            target,
            sampled.estimate,
            &rotors_body_n_m_s,
            &known_body_n_m,
        );
        let given = if by_thrusters {
            let given = thrusters.give(allocator, &torque_body_n_m, mass, [time_s, limits.interval_s()]);
            self.thrusters_limited = given != Some(1.0);
            given.unwrap_or(0.0)
        } else {
            self.wheels.give(&control.wheels, distribution, gyrostat, &torque_body_n_m, momentum)
        };
        if given < 1.0 {
            self.controller.limited(&(torque_body_n_m * given));
        }
        sampled.estimate.rate_body_rad_s.is_some()
    }
}
