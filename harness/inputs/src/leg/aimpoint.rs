//! Aimpoint of a flyby as files give it.

/// Aimpoint of a flyby: where a path passes a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FlybyAimpoint {
    /// By the altitude of its closest approach, and the angle of B from T toward R.
    Altitude {
        /// Above the body's radius, m.
        altitude_m: f64,
        /// From T toward R, rad.
        angle_rad: f64,
    },
    /// By components of B of the hyperbola that osculates the lead time before the closest approach.
    Plane {
        /// Along T, m.
        b_t_m: f64,
        /// Along R, m.
        b_r_m: f64,
    },
}
