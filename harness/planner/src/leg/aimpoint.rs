//! Aimpoints in the B-plane, and the hyperbola that turns the path there.
//!
//! Equation: with v the speed far from the body, r the distance of its closest approach: B^2 = r^2 + 2 r mu / v^2; e = 1 + r v^2 / mu,
//! turn = 2 asin(1 / e), delta-v = 2 v / e.

use inputs::leg::FlybyAimpoint;
use nalgebra::Vector2;

/// Length of B, in m, of a hyperbola whose closest approach is `distance_m` from a body's centre.
pub fn impact_parameter_m(distance_m: f64, excess_speed_m_s: f64, mu_m3_s2: f64) -> f64 {
    (distance_m * (distance_m + 2.0 * mu_m3_s2 / (excess_speed_m_s * excess_speed_m_s))).sqrt()
}

/// Closest distance from a body's centre, in m, of the hyperbola with this length of B.
pub fn closest_distance_m(b_m: f64, excess_speed_m_s: f64, mu_m3_s2: f64) -> f64 {
    let axis_m = mu_m3_s2 / (excess_speed_m_s * excess_speed_m_s);
    b_m * b_m / (axis_m + axis_m.hypot(b_m))
}

/// B along T and R, in m, of an aimpoint, on a hyperbola without tides about a body of this gravitational parameter and radius.
pub fn b_m(aimpoint: &FlybyAimpoint, excess_speed_m_s: f64, mu_m3_s2: f64, radius_m: f64) -> Vector2<f64> {
    match *aimpoint {
        FlybyAimpoint::Plane { b_t_m, b_r_m } => Vector2::new(b_t_m, b_r_m),
        FlybyAimpoint::Altitude { altitude_m, angle_rad } => {
            let (sine, cosine) = angle_rad.sin_cos();
            let size_m = impact_parameter_m(radius_m + altitude_m, excess_speed_m_s, mu_m3_s2);
            Vector2::new(cosine, sine) * size_m
        }
    }
}

/// Effect of a closest approach on the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flyby {
    /// Angle by which the velocity far from the body turns, rad.
    pub turn_rad: f64,
    /// Change of that velocity, m/s.
    pub delta_v_m_s: f64,
}

impl Flyby {
    /// Computes the flyby of a hyperbola by its closest distance from the body's centre.
    pub fn new(distance_m: f64, excess_speed_m_s: f64, mu_m3_s2: f64) -> Self {
        let eccentricity = 1.0 + distance_m * excess_speed_m_s * excess_speed_m_s / mu_m3_s2;
        Self {
            turn_rad: 2.0 * (1.0 / eccentricity).asin(),
            delta_v_m_s: 2.0 * excess_speed_m_s / eccentricity,
        }
    }
}
