//! What acts on a spacecraft, effect by effect.

use core::ops::{Index, IndexMut};

use super::force_torque::ForceTorque;
use crate::numerics::scalar::Scalar;

/// An effect that exerts force or torque. A new one is a line here and a file of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effect {
    /// Direct sunlight.
    Solar,
    /// Sunlight reflected by the planet.
    Albedo,
    /// Infrared light of the planet.
    Infrared,
    /// Recoil of the heat the spacecraft radiates.
    Thermal,
    /// Gradient of the planet's gravity: torque alone.
    GravityGradient,
    /// What is applied from outside.
    Applied,
    /// The spacecraft's own thrusters.
    Thrusters,
}

impl Effect {
    /// All of them, in the order in which they are added up.
    pub const ALL: [Self; 7] = [
        Self::Solar,
        Self::Albedo,
        Self::Infrared,
        Self::Thermal,
        Self::GravityGradient,
        Self::Applied,
        Self::Thrusters,
    ];
    /// Those of the surroundings.
    pub const DISTURBANCES: [Self; 5] =
        [Self::Solar, Self::Albedo, Self::Infrared, Self::Thermal, Self::GravityGradient];
    /// Those of light and heat.
    pub const RADIATION: [Self; 4] = [Self::Solar, Self::Albedo, Self::Infrared, Self::Thermal];
}

/// Force and torque about the centre of mass by effect, body frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loads<T: Scalar = f64>([ForceTorque<T>; Effect::ALL.len()]);

impl<T: Scalar> Loads<T> {
    /// Nothing acts.
    pub fn zero() -> Self {
        Self([ForceTorque::zero(); Effect::ALL.len()])
    }

    /// Sum over all effects.
    pub fn total(&self) -> ForceTorque<T> {
        self.0.iter().copied().sum()
    }
}

impl<T: Scalar> Index<Effect> for Loads<T> {
    type Output = ForceTorque<T>;

    fn index(&self, effect: Effect) -> &ForceTorque<T> {
        &self.0[effect as usize]
    }
}

impl<T: Scalar> IndexMut<Effect> for Loads<T> {
    fn index_mut(&mut self, effect: Effect) -> &mut ForceTorque<T> {
        &mut self.0[effect as usize]
    }
}

#[cfg(test)]
mod tests {
    //! Every effect has its own place, and the total leaves none out.
    use super::*;
    use nalgebra::Vector3;

    #[test]
    fn every_effect_counts_once() {
        let mut loads = Loads::<f64>::zero();
        for (number, effect) in Effect::ALL.into_iter().enumerate() {
            let size = 10.0_f64.powi(number as i32);
            loads[effect] = ForceTorque {
                force_body_n: Vector3::new(size, 0.0, 0.0),
                torque_body_n_m: Vector3::new(0.0, -size, 0.0),
            };
        }
        assert_eq!(loads.total().force_body_n, Vector3::new(1_111_111.0, 0.0, 0.0));
        assert_eq!(loads.total().torque_body_n_m, Vector3::new(0.0, -1_111_111.0, 0.0));
        assert_eq!(loads[Effect::Thermal].force_body_n.x, 1000.0);
    }
}
