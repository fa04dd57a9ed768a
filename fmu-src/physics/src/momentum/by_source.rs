//! What each effect did to the momentum since the last dump.

use nalgebra::{Rotation3, SVector, Vector3};
use serde::{Deserialize, Serialize};

use super::totals::Convention;
use crate::numerics::chebyshev::Segment;
use crate::radiation::{Effect, Loads};

/// Effects that act between dumps.
pub const SOURCES: [Effect; 6] = [
    Effect::Solar,
    Effect::Albedo,
    Effect::Infrared,
    Effect::Thermal,
    Effect::GravityGradient,
    Effect::Applied,
];
/// Components of all of them.
pub(super) const ROWS: usize = 3 * SOURCES.len();

/// Torque by effect in the order of [`SOURCES`], body frame, in N m.
pub type SourceTorques = [Vector3<f64>; SOURCES.len()];

/// Torque by effect of the loads at one time.
pub fn torques_body_n_m(loads: &Loads) -> SourceTorques {
    SOURCES.map(|effect| loads[effect].torque_body_n_m)
}

/// Momentum by effect since the last dump, in N m s: EME2000 where the momentum is physical, the integral of body components
/// under the other convention.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SourceMomenta([Vector3<f64>; SOURCES.len()]);

impl SourceMomenta {
    /// Of one effect, body frame, in N m s, the body standing like this; `None` for an effect that is not kept apart.
    pub fn body_n_m_s(
        &self,
        effect: Effect,
        convention: Convention,
        inertial_from_body: &Rotation3<f64>,
    ) -> Option<Vector3<f64>> {
        let at = SOURCES.iter().position(|source| *source == effect)?;
        let momentum = self.0.get(at)?;
        Some(match convention {
            Convention::Inertial => inertial_from_body.inverse() * momentum,
            Convention::BodyIntegral => *momentum,
        })
    }

    pub(super) fn to_vector(self) -> SVector<f64, ROWS> {
        SVector::from_fn(|row, _| self.0[row / 3][row % 3])
    }

    pub(super) fn from_vector(vector: &SVector<f64, ROWS>) -> Self {
        Self(core::array::from_fn(|source| vector.fixed_rows::<3>(3 * source).into_owned()))
    }

    /// With what torques did over a span: the means of inertial and body components times its length.
    pub fn add(&mut self, impulses: &[Vector3<f64>; SOURCES.len()]) {
        self.0.iter_mut().zip(impulses).for_each(|(sum, impulse)| *sum += impulse);
    }
}

/// The rates at which [`SourceMomenta`] change, as one vector.
pub(super) fn rates(
    convention: Convention,
    inertial_from_body: &Rotation3<f64>,
    torques: &SourceTorques,
) -> SVector<f64, ROWS> {
    let turned = torques.map(|torque| match convention {
        Convention::Inertial => inertial_from_body * torque,
        Convention::BodyIntegral => torque,
    });
    SourceMomenta(turned).to_vector()
}

/// Momentum by effect over one segment of the integration.
pub(super) type SourceSegment<const N: usize> = Segment<ROWS, N>;
