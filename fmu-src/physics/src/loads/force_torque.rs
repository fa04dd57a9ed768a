//! A force with its torque about one point.

use core::iter::Sum;
use core::ops::{Add, AddAssign};

use nalgebra::Vector3;

use crate::numerics::scalar::Scalar;

/// A vector that changes linearly: at the start, and per second.
pub type Linear = [Vector3<f64>; 2];

/// Force and torque in the body frame; the torque is about the centre of mass unless stated otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceTorque<T: Scalar = f64> {
    /// Force in N.
    pub force_body_n: Vector3<T>,
    /// Torque in N m.
    pub torque_body_n_m: Vector3<T>,
}

impl<T: Scalar> ForceTorque<T> {
    /// No force, no torque.
    pub fn zero() -> Self {
        Self { force_body_n: Vector3::zeros(), torque_body_n_m: Vector3::zeros() }
    }

    /// Whether all components are finite numbers.
    pub fn is_finite(&self) -> bool {
        self.force_body_n.iter().chain(&self.torque_body_n_m).all(|x| x.value().is_finite())
    }

    /// A force through a point: torque = arm x force.
    pub fn at_arm(arm_body_m: &Vector3<T>, force_body_n: Vector3<T>) -> Self {
        Self { force_body_n, torque_body_n_m: arm_body_m.cross(&force_body_n) }
    }

    /// The same force with its torque about a point that lies `displacement_body_m` from the present one:
    /// T' = T - displacement x F.
    pub fn about(self, displacement_body_m: &Vector3<T>) -> Self {
        Self { torque_body_n_m: self.torque_body_n_m - displacement_body_m.cross(&self.force_body_n), ..self }
    }

    /// Force and torque multiplied by `factor`.
    pub fn scaled(&self, factor: T) -> Self {
        Self { force_body_n: self.force_body_n * factor, torque_body_n_m: self.torque_body_n_m * factor }
    }
}

impl<T: Scalar> Add for ForceTorque<T> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            force_body_n: self.force_body_n + other.force_body_n,
            torque_body_n_m: self.torque_body_n_m + other.torque_body_n_m,
        }
    }
}

impl<T: Scalar> AddAssign for ForceTorque<T> {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<T: Scalar> Sum for ForceTorque<T> {
    fn sum<I: Iterator<Item = Self>>(iter: I) -> Self {
        iter.fold(Self::zero(), Add::add)
    }
}
