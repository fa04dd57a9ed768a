//! B-plane of a hyperbola: where its incoming asymptote would pass a body that did not bend it.
//!
//! Equation: S = e / |e|^2 + sqrt(1 - 1 / |e|^2) h x e / (|h| |e|) along the incoming asymptote, e the vector of eccentricity, h the
//! angular momentum; B = (|h| / v) S x h / |h|, v the speed far from the body; T = S x N / |S x N|, N north of the ecliptic of
//! J2000; R = S x T.
//! Reference: Kizner, A Method of Describing Miss Distances for Lunar and Interplanetary Trajectories, 1961; paper 003.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::environment::CartesianState;
use crate::environment::frames::dcm_eme2000_from_ecliptic;

/// An osculating hyperbola in its B-plane.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BPlane {
    /// Component of B along T, parallel to the ecliptic, m.
    pub b_t_m: f64,
    /// Component of B along R, toward its south where S lies in it, m.
    pub b_r_m: f64,
    /// Speed far from the body, m/s.
    pub excess_speed_m_s: f64,
}

impl BPlane {
    /// Of a state in EME2000 about a body of gravitational parameter `mu_m3_s2`; `None` on an ellipse or a straight line.
    pub fn of(state: &CartesianState, mu_m3_s2: f64) -> Option<Self> {
        let (r, v) = (state.position_m, state.velocity_m_s);
        let excess_squared = v.norm_squared() - 2.0 * mu_m3_s2 / r.norm();
        let momentum = r.cross(&v);
        let momentum_m2_s = momentum.norm();
        if !(excess_squared > 0.0 && momentum_m2_s > 0.0) {
            return None;
        }
        let normal = momentum / momentum_m2_s;
        let excess_speed_m_s = excess_squared.sqrt();
        // Through the semi-latus rectum: the difference of nearly equal vectors is not exact far from the body.
        let ratio_s_m = momentum_m2_s / mu_m3_s2;
        let eccentricity = (1.0 + excess_squared * ratio_s_m * ratio_s_m).sqrt();
        let toward = (v.cross(&momentum) / mu_m3_s2 - r.normalize()).normalize();
        let cosine = 1.0 / eccentricity;
        let asymptote = toward * cosine + normal.cross(&toward) * (1.0 - cosine * cosine).sqrt();
        let north = dcm_eme2000_from_ecliptic() * Vector3::z();
        let t = asymptote.cross(&north).try_normalize(0.0)?;
        let b_m = asymptote.cross(&normal) * (momentum_m2_s / excess_speed_m_s);
        Some(Self { b_t_m: b_m.dot(&t), b_r_m: b_m.dot(&asymptote.cross(&t)), excess_speed_m_s })
    }
}

#[cfg(test)]
mod tests {
    //! The asymptote of a hyperbola far from the body is the path itself there.
    use super::*;
    use crate::constants::GM_MERCURY_M3_S2;
    use crate::environment::orbit::{Elements, TwoBodyOrbit};

    #[test]
    fn the_path_far_ahead_of_periapsis_meets_the_plane_there() {
        let elements = Elements {
            semi_major_axis_m: -8.1e5,
            eccentricity: 4.3,
            inclination_rad: 1.1,
            ascending_node_rad: 0.7,
            periapsis_argument_rad: 2.9,
            true_anomaly_rad: 0.0,
        };
        let orbit = TwoBodyOrbit::from_elements(elements, GM_MERCURY_M3_S2, 0.0).unwrap();
        let north =
            Vector3::new(0.0, -23.439_291_1_f64.to_radians().sin(), 23.439_291_1_f64.to_radians().cos());
        // 10,000 days before periapsis the speed is that of the asymptote to 1e-9, and the place lies on it.
        let far = orbit.state_at(-8.64e8);
        let s = far.velocity_m_s.normalize();
        let t = s.cross(&north).normalize();
        let r = s.cross(&t);
        for at_s in [-1e5, -3e3, 0.0, 700.0, 1e5] {
            let found = BPlane::of(&orbit.state_at(at_s), GM_MERCURY_M3_S2).unwrap();
            // b = |a| sqrt(e^2 - 1), v^2 = mu / |a|.
            let size_m = 8.1e5 * (4.3_f64.powi(2) - 1.0).sqrt();
            assert!((found.b_t_m.hypot(found.b_r_m) / size_m - 1.0).abs() < 1e-9, "{at_s}");
            assert!((found.excess_speed_m_s / (GM_MERCURY_M3_S2 / 8.1e5).sqrt() - 1.0).abs() < 1e-9);
            // The place on the asymptote, less what is along it; it falls toward the body by mu / v^2 ln r, 10 km of 3000 here.
            let [b_t_m, b_r_m] = [t, r].map(|axis| far.position_m.dot(&axis));
            assert!((found.b_t_m - b_t_m).hypot(found.b_r_m - b_r_m) < 1e-2 * size_m, "{at_s}");
        }
    }

    #[test]
    fn ellipses_have_none() {
        assert_eq!(BPlane::of(&CartesianState::on_circle(3e6, GM_MERCURY_M3_S2), GM_MERCURY_M3_S2), None);
        let falling = CartesianState { position_m: Vector3::x() * 1e7, velocity_m_s: Vector3::x() * -9e3 };
        assert_eq!(BPlane::of(&falling, GM_MERCURY_M3_S2), None);
    }
}
