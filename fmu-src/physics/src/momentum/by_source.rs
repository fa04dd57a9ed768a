//! Change of momentum by each effect since the last dump.

use nalgebra::{Rotation3, Vector3};
use serde::{Deserialize, Serialize};

use super::totals::Convention;
use crate::loads::{Active, ByEffect, Effect, Loads};
use crate::numerics::chebyshev::Segment;

/// Torque of the effects that act and whose momentum is kept apart, body frame, in N m.
pub type SourceTorques = ByEffect<Option<Vector3<f64>>>;

/// Whether the momentum of an effect is kept apart on a body whose attitude is followed ideally, in the table's order.
const KEPT_APART: [bool; Effect::COUNT] = {
    let mut kept = [false; Effect::COUNT];
    let mut k = 0;
    while k < Effect::COUNT {
        kept[k] = Effect::ALL[k].row().momentum_apart && !Effect::ALL[k].is_by_moving_parts();
        k += 1;
    }
    kept
};

/// Torque by effect of the loads at one time, of those that act on a body whose attitude is followed ideally.
pub fn torques_body_n_m(loads: &Loads, active: Active) -> SourceTorques {
    let acts = |effect: Effect| KEPT_APART[effect as usize] && active.has(effect);
    ByEffect::from_fn(|effect| acts(effect).then(|| loads[effect].torque_body_n_m))
}

/// Momentum by effect since the last dump, in N m s: EME2000 where the momentum is physical, the integral of body components
/// under the other convention.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SourceMomenta(pub(super) ByEffect<Vector3<f64>>);

impl SourceMomenta {
    /// Returns the momentum of one effect, body frame at this attitude, in N m s; zero for an effect that is not kept apart.
    pub fn body_n_m_s(
        &self,
        effect: Effect,
        convention: Convention,
        inertial_from_body: &Rotation3<f64>,
    ) -> Vector3<f64> {
        match convention {
            Convention::Inertial => inertial_from_body.inverse() * self.0[effect],
            Convention::BodyIntegral => self.0[effect],
        }
    }

    /// Adds changes of momentum by effect, in N m s.
    pub fn add(&mut self, impulses: &[Vector3<f64>; Effect::COUNT]) {
        Effect::ALL.into_iter().zip(impulses).for_each(|(effect, impulse)| self.0[effect] += impulse);
    }
}

/// The rate at which the momentum of an effect changes, in N m.
pub(super) fn rate(
    convention: Convention,
    inertial_from_body: &Rotation3<f64>,
    torque_body_n_m: &Vector3<f64>,
) -> Vector3<f64> {
    match convention {
        Convention::Inertial => inertial_from_body * torque_body_n_m,
        Convention::BodyIntegral => *torque_body_n_m,
    }
}

/// Momentum by effect over one segment of the integration; absent of those that do not act.
pub(super) type SourceSegments<const N: usize> = ByEffect<Option<Segment<3, N>>>;
