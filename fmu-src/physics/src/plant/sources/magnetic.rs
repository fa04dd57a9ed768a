//! The spacecraft's residual dipole in the planet's magnetic field.

use nalgebra::Vector3;

use super::source::Source;
use crate::loads::{Effect, Linear};
use crate::numerics::scalar::Scalar;
use crate::plant::settings::laws::Laws;

/// Residual dipole.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ResidualDipole;

/// Torque m x B of a dipole (in A m2) in a field (in T), both in the body frame, in N m.
pub(super) fn torque_n_m<T: Scalar>(dipole_body_a_m2: &Vector3<T>, field_body_t: &Vector3<T>) -> Vector3<T> {
    dipole_body_a_m2.cross(field_body_t)
}

impl Source for ResidualDipole {
    const ROWS: &'static [Effect] = &[Effect::Magnetic];
    type Settings = Laws;
    type State = ();

    fn dipole(laws: &Laws, (): &(), _: f64) -> Linear {
        [laws.dipole_body_a_m2, Vector3::zeros()]
    }
}

#[cfg(test)]
mod tests {
    //! The torque is that of the forces q B on two poles, and it turns the dipole into the field.

    use super::*;

    #[test]
    fn the_torque_is_that_of_a_current_loop() {
        // A square loop in the plane x = 0 around x, sides of 2 m, 3 A: each side of it feels I l x B.
        let (field_t, current_a) = (Vector3::new(2e-5, -3e-5, 1e-5), 3.0);
        let corners =
            [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]].map(|[y, z]| Vector3::new(0.0, y, z));
        let torque: Vector3<f64> = (0..4)
            .map(|k| {
                let (from, to) = (corners[k], corners[(k + 1) % 4]);
                let force_n = (to - from).cross(&field_t) * current_a;
                ((from + to) / 2.0).cross(&force_n)
            })
            .sum();
        let dipole_a_m2 = Vector3::new(current_a * 4.0, 0.0, 0.0);
        assert!((torque_n_m(&dipole_a_m2, &field_t) - torque).norm() < 1e-18);
    }
}
