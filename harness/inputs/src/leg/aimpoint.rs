//! Aimpoint of a flyby as files give it.

use crate::reading::At;

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

impl FlybyAimpoint {
    /// Returns the aimpoint that keys of a table give, by the first of them; `None` where they give none, part of one, or two.
    pub(crate) fn new(
        [b_t_m, b_r_m]: [&Option<At<f64>>; 2],
        altitude_m: &Option<At<f64>>,
        angle_rad: &Option<At<f64>>,
    ) -> Option<At<Self>> {
        match (b_t_m, b_r_m, altitude_m, angle_rad) {
            (Some(b_t_m), Some(b_r_m), None, None) => {
                Some(b_t_m.with(Self::Plane { b_t_m: b_t_m.it, b_r_m: b_r_m.it }))
            }
            (None, None, Some(altitude_m), Some(angle_rad)) => {
                Some(altitude_m.with(Self::Altitude { altitude_m: altitude_m.it, angle_rad: angle_rad.it }))
            }
            _ => None,
        }
    }
}
