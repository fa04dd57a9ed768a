//! Values by effect, and the loads among them.

use core::ops::{Index, IndexMut};

use serde::{Deserialize, Serialize};

use super::effect::{Active, Effect};
use super::force_torque::ForceTorque;
use crate::numerics::scalar::Scalar;

/// One value for each effect.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ByEffect<V>([V; Effect::COUNT]);

/// Force and torque about the centre of mass by effect, body frame.
pub type Loads<T = f64> = ByEffect<ForceTorque<T>>;

impl<V> ByEffect<V> {
    /// Calls `value` for each effect.
    pub fn from_fn(value: impl FnMut(Effect) -> V) -> Self {
        Self(Effect::ALL.map(value))
    }

    /// The values in the table's order.
    pub fn values(&self) -> &[V; Effect::COUNT] {
        &self.0
    }

    /// The effects with their values.
    pub fn iter(&self) -> impl Iterator<Item = (Effect, &V)> {
        Effect::ALL.into_iter().zip(&self.0)
    }
}

impl<V> ByEffect<Option<V>> {
    /// Removes all values.
    pub fn clear(&mut self) {
        self.0.iter_mut().for_each(|value| *value = None);
    }

    /// The effects that have a value, with it.
    pub fn present(&self) -> impl Iterator<Item = (Effect, &V)> {
        self.iter().filter_map(|(effect, value)| Some((effect, value.as_ref()?)))
    }
}

impl<T: Scalar> ByEffect<ForceTorque<T>> {
    /// Loads that are all zero.
    pub fn zero() -> Self {
        Self([ForceTorque::zero(); Effect::COUNT])
    }

    /// Loads of the effects that act.
    #[must_use]
    pub fn of_active(self, active: Active) -> Self {
        Self::from_fn(|effect| if active.has(effect) { self[effect] } else { ForceTorque::zero() })
    }

    /// Sum over all effects.
    pub fn total(&self) -> ForceTorque<T> {
        self.0.iter().copied().sum()
    }
}

impl<V> Index<Effect> for ByEffect<V> {
    type Output = V;

    fn index(&self, effect: Effect) -> &V {
        &self.0[effect as usize]
    }
}

impl<V> IndexMut<Effect> for ByEffect<V> {
    fn index_mut(&mut self, effect: Effect) -> &mut V {
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
        let all = (10.0_f64.powi(Effect::COUNT as i32) - 1.0) / 9.0;
        assert_eq!(loads.total().force_body_n, Vector3::new(all, 0.0, 0.0));
        assert_eq!(loads.total().torque_body_n_m, Vector3::new(0.0, -all, 0.0));
        assert_eq!(loads[Effect::Thermal].force_body_n.x, 1000.0);
    }
}
