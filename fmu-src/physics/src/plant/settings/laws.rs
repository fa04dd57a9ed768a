//! Parameters of the effects in closed form: gravity of the planet, dipole of the spacecraft.

use nalgebra::Vector3;

/// Number of tunable parameters.
pub const TUNABLE_COUNT: usize = 3;

/// Parameters of the laws, constant during a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Laws<T = f64> {
    /// Gravitational parameter of the planet, in m3/s2.
    pub gm_m3_s2: T,
    /// Flattening of its gravity, where that acts on the gradient: J2 and the radius in m to which it refers.
    pub flattening: Option<[T; 2]>,
    /// The spacecraft's residual dipole, body frame, in A m2.
    pub dipole_body_a_m2: Vector3<T>,
}

impl<T> Laws<T> {
    /// Tunable parameters.
    pub fn tunable_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.dipole_body_a_m2.iter_mut()
    }
}
