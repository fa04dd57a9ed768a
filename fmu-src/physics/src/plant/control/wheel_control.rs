//! Wheel control: how a torque on the body becomes motor torques, and what the motors give of it.
//!
//! Equation: u_k = -s_k + f_k + (b_k - h_k) / T with the shares s of the torque, friction f, and b the bias of a wheel with its
//! share of what the working wheels hold together beside their biases; where a motor would have to give more than it can, all s are reduced alike.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::attitude::control::WheelAllocator;
use crate::attitude::{Gyrostat, Motor};
use crate::plant::settings::dynamics_settings::WheelControlSettings;

/// Motors of the wheels.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct WheelControl {
    pub motors: Vec<Motor>,
    /// Whether the wheels could not give the torque that was requested.
    pub is_limited: bool,
}

/// The distribution of a torque over the wheels that turn and have a motor, made anew where those or the axes change; a cache that
/// no state holds.
#[derive(Clone, Debug, Default)]
pub(crate) struct WheelDistribution {
    /// Axis of each wheel, body frame, and whether it gives torque.
    wheels: Vec<(Vector3<f64>, bool)>,
    allocator: Option<WheelAllocator>,
    torques_n_m: Vec<f64>,
    balance_n_m: Vec<f64>,
    /// Momenta of the rotors at the sample, in N m s.
    rotors_n_m_s: Vec<f64>,
}

impl WheelDistribution {
    /// Makes it that of these wheels.
    fn update(&mut self, gyrostat: &Gyrostat, motors: &[Motor]) {
        let gives = |k: usize| !motors[k].failed && !gyrostat.wheels()[k].locked;
        let count = gyrostat.wheels().len().min(motors.len());
        let is_same = |k: usize| {
            let (known, works) = &self.wheels[k];
            let axis = &gyrostat.wheels()[k].axis_body;
            *works == gives(k) && known == axis
        };
        if self.balance_n_m.len() == count && self.wheels.len() == count && (0..count).all(is_same) {
            return;
        }
        self.wheels.clear();
        self.wheels.extend((0..count).map(|k| (gyrostat.wheels()[k].axis_body, gives(k))));
        let axes: Vec<_> = self.wheels.iter().map(|(axis_body, _)| *axis_body).collect();
        self.allocator = WheelAllocator::new(&axes, |k| self.wheels[k].1);
        self.torques_n_m = vec![0.0; axes.len()];
        self.balance_n_m = vec![0.0; axes.len()];
        self.rotors_n_m_s = vec![0.0; axes.len()];
    }
}

impl WheelControl {
    /// Motors of `wheels` wheels, without torque.
    pub(crate) fn new(wheels: usize) -> Self {
        Self { motors: vec![Motor::default(); wheels], is_limited: false }
    }

    /// Sets which wheels failed, one flag a wheel: their motors give no torque.
    pub(crate) fn fail(&mut self, failed: &[bool]) {
        for (motor, failed) in self.motors.iter_mut().zip(failed) {
            motor.failed = *failed;
            if motor.failed {
                motor.torque_n_m = 0.0;
            }
        }
    }

    /// Torques from outside, in N m, as far as the motors give them.
    pub(crate) fn drive(&mut self, gyrostat: &Gyrostat, torques_n_m: &[f64]) {
        for ((motor, wheel), torque_n_m) in self.motors.iter_mut().zip(gyrostat.wheels()).zip(torques_n_m) {
            if !motor.failed {
                motor.torque_n_m = torque_n_m.clamp(-wheel.max_torque_n_m, wheel.max_torque_n_m);
            }
        }
    }

    /// Whether the wheels that work give torque in all directions.
    pub(crate) fn span(&self, distribution: &mut WheelDistribution, gyrostat: &Gyrostat) -> bool {
        distribution.update(gyrostat, &self.motors);
        distribution.allocator.is_some()
    }

    /// The rotors continue as they are: the motors make up for friction alone.
    pub(crate) fn coast(
        &mut self,
        settings: &WheelControlSettings,
        gyrostat: &Gyrostat,
        momentum_n_m_s: impl Fn(usize) -> f64,
    ) {
        for (k, (motor, wheel)) in self.motors.iter_mut().zip(gyrostat.wheels()).enumerate() {
            let friction =
                if settings.compensates_friction { wheel.friction_n_m(momentum_n_m_s(k)) } else { 0.0 };
            let turns = !motor.failed && !wheel.locked;
            motor.torque_n_m =
                if turns { friction.clamp(-wheel.max_torque_n_m, wheel.max_torque_n_m) } else { 0.0 };
        }
        self.is_limited = false;
    }

    /// The motors give this torque on the body, in N m, while the rotors hold these momenta; the part of it that they do. The
    /// distribution is that of the wheels as they are.
    pub(crate) fn give(
        &mut self,
        settings: &WheelControlSettings,
        distribution: &mut WheelDistribution,
        gyrostat: &Gyrostat,
        torque_body_n_m: &Vector3<f64>,
        momentum_n_m_s: impl Fn(usize) -> f64,
    ) -> f64 {
        let Self { motors, is_limited } = self;
        let WheelDistribution { wheels, allocator, torques_n_m: shares, balance_n_m: balance, rotors_n_m_s } =
            distribution;
        let Some(allocator) = allocator else {
            motors.iter_mut().for_each(|motor| motor.torque_n_m = 0.0);
            *is_limited = true;
            return 0.0;
        };
        rotors_n_m_s.iter_mut().enumerate().for_each(|(k, held_n_m_s)| *held_n_m_s = momentum_n_m_s(k));
        // The body feels the opposite of what the motors exert on the rotors.
        allocator.distribute(settings.allocation, &-torque_body_n_m, shares);
        let turns = |k: usize| wheels[k].1;
        let working_body_n_m_s = gyrostat
            .along_axes(|k| if turns(k) { rotors_n_m_s[k] - gyrostat.wheels()[k].bias_n_m_s } else { 0.0 });
        allocator.distribute(settings.allocation, &working_body_n_m_s, balance);
        let mut given = 1.0_f64;
        for (k, wheel) in gyrostat.wheels().iter().enumerate() {
            let friction =
                if settings.compensates_friction { wheel.friction_n_m(rotors_n_m_s[k]) } else { 0.0 };
            // Motor torque without the share that is requested: friction and balance.
            balance[k] = if turns(k) {
                friction + (balance[k] + wheel.bias_n_m_s - rotors_n_m_s[k]) / settings.balance_time_s
            } else {
                0.0
            };
            balance[k] = balance[k].clamp(-wheel.max_torque_n_m, wheel.max_torque_n_m);
            let most = wheel.max_torque_n_m - balance[k] * shares[k].signum();
            if shares[k].abs() > most {
                given = given.min(most / shares[k].abs());
            }
        }
        for (motor, (share, other)) in motors.iter_mut().zip(shares.iter().zip(balance.iter())) {
            motor.torque_n_m = share * given + other;
        }
        *is_limited = given < 1.0;
        given
    }
}
