//! B-plane of a hyperbola: where its incoming asymptote would pass a body that did not bend it.
//!
//! Equation: S = e / |e|^2 + sqrt(1 - 1 / |e|^2) h x e / (|h| |e|) along the incoming asymptote, e the vector of eccentricity, h the
//! angular momentum; B = (|h| / v) S x h / |h|, v the speed far from the body; T = S x N / |S x N|, N north of the ecliptic of
//! J2000; R = S x T.
//! Reference: Kizner, A Method of Describing Miss Distances for Lunar and Interplanetary Trajectories, 1961; paper 003.

use nalgebra::{Matrix3x6, Vector3};
use serde::{Deserialize, Serialize};

use crate::environment::CartesianState;
use crate::environment::frames::dcm_eme2000_from_ecliptic;
use crate::math;
use crate::numerics::scalar::{Dual64, Scalar, constant_vector};

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
    /// Returns the B-plane of a state in EME2000 about a body of gravitational parameter `mu_m3_s2`; `None` on an ellipse or a straight line.
    pub fn from_state(state: &CartesianState, mu_m3_s2: f64) -> Option<Self> {
        let [b_t_m, b_r_m, excess_speed_m_s] = components(&state.position_m, &state.velocity_m_s, mu_m3_s2)?;
        Some(Self { b_t_m, b_r_m, excess_speed_m_s })
    }

    /// Exact partials of B.T, B.R (m) and of the speed far from the body (m/s) by that state (m, m/s).
    pub fn partials(state: &CartesianState, mu_m3_s2: f64) -> Option<Matrix3x6<f64>> {
        let mut partials = Matrix3x6::zeros();
        for (axis, mut column) in partials.column_iter_mut().enumerate() {
            let [mut position_m, mut velocity_m_s] =
                [&state.position_m, &state.velocity_m_s].map(constant_vector::<Dual64>);
            let seeded = if axis < 3 { &mut position_m[axis] } else { &mut velocity_m_s[axis - 3] };
            seeded.eps = 1.0;
            column.copy_from_slice(
                &components(&position_m, &velocity_m_s, mu_m3_s2)?.map(|component| component.eps),
            );
        }
        Some(partials)
    }

    /// Length of B, m.
    pub fn size_m(&self) -> f64 {
        math::hypot(self.b_t_m, self.b_r_m)
    }
}

/// B.T, B.R and the speed far from the body.
fn components<T: Scalar>(r: &Vector3<T>, v: &Vector3<T>, mu_m3_s2: f64) -> Option<[T; 3]> {
    let one = T::constant(1.0);
    let excess_squared = v.norm_squared() - T::constant(2.0 * mu_m3_s2) / r.norm();
    let momentum = r.cross(v);
    let momentum_m2_s = momentum.norm();
    if !(excess_squared.value() > 0.0 && momentum_m2_s.value() > 0.0) {
        return None;
    }
    let normal = momentum / momentum_m2_s;
    let excess_speed_m_s = excess_squared.sqrt();
    // Through the semi-latus rectum: the difference of nearly equal vectors is not exact far from the body.
    let ratio_s_m = momentum_m2_s / mu_m3_s2;
    let eccentricity = (one + excess_squared * ratio_s_m * ratio_s_m).sqrt();
    let toward = (v.cross(&momentum) / T::constant(mu_m3_s2) - r.normalize()).normalize();
    let cosine = one / eccentricity;
    let asymptote = toward * cosine + normal.cross(&toward) * (one - cosine * cosine).sqrt();
    let north = constant_vector::<T>(&(dcm_eme2000_from_ecliptic() * Vector3::z()));
    let t = asymptote.cross(&north).try_normalize(T::constant(0.0))?;
    let b_m = asymptote.cross(&normal) * (momentum_m2_s / excess_speed_m_s);
    Some([b_m.dot(&t), b_m.dot(&asymptote.cross(&t)), excess_speed_m_s])
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
            let found = BPlane::from_state(&orbit.state_at(at_s), GM_MERCURY_M3_S2).unwrap();
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
        assert_eq!(
            BPlane::from_state(&CartesianState::on_circle(3e6, GM_MERCURY_M3_S2), GM_MERCURY_M3_S2),
            None
        );
        let falling = CartesianState { position_m: Vector3::x() * 1e7, velocity_m_s: Vector3::x() * -9e3 };
        assert_eq!(BPlane::from_state(&falling, GM_MERCURY_M3_S2), None);
    }

    #[test]
    fn partials_are_central_differences() {
        let state = CartesianState {
            position_m: Vector3::new(-8.1e7, 6.2e7, -3.3e7),
            velocity_m_s: Vector3::new(4.1e3, -2.7e3, 1.5e3),
        };
        let partials = BPlane::partials(&state, GM_MERCURY_M3_S2).unwrap();
        for axis in 0..6 {
            let step = if axis < 3 { 3e3 } else { 1e-1 };
            let [after, before] = [step, -step].map(|step| {
                let mut moved = state;
                let part = if axis < 3 { &mut moved.position_m } else { &mut moved.velocity_m_s };
                part[axis % 3] += step;
                let plane = BPlane::from_state(&moved, GM_MERCURY_M3_S2).unwrap();
                Vector3::new(plane.b_t_m, plane.b_r_m, plane.excess_speed_m_s)
            });
            let difference = (after - before) / (2.0 * step);
            for row in 0..3 {
                let size = partials.fixed_view::<1, 3>(row, axis / 3 * 3).norm();
                let off = (difference[row] - partials[(row, axis)]).abs();
                assert!(off < 1e-8 * size, "{row} {axis}: {off} of {size}");
            }
        }
    }

    /// Angle by which Mercury turns the path, rad: tan(angle / 2) = mu / (B v^2).
    fn turn_rad(plane: &BPlane) -> f64 {
        2.0 * (GM_MERCURY_M3_S2 / (plane.size_m() * plane.excess_speed_m_s.powi(2))).atan()
    }

    /// Change of the velocity far behind Mercury for a miss in any direction of the plane, m/s a m: v sin(turn) / B.
    fn outgoing_change_1_s(plane: &BPlane) -> f64 {
        plane.excess_speed_m_s * turn_rad(plane).sin() / plane.size_m()
    }

    /// Paper 003's encounter: 200 km above Mercury at 5.2 km/s, 0.71 m/s a km.
    #[test]
    fn the_outgoing_velocity_changes_by_0_71_m_s_a_km() {
        let (radius_m, speed_m_s): (f64, f64) = (2_439_700.0 + 2e5, 5.2e3);
        let axis_m = -GM_MERCURY_M3_S2 / (speed_m_s * speed_m_s);
        for inclination_rad in [0.1_f64, 0.4, 1.5] {
            let elements = Elements {
                semi_major_axis_m: axis_m,
                eccentricity: 1.0 - radius_m / axis_m,
                inclination_rad,
                ascending_node_rad: 0.2,
                periapsis_argument_rad: 1.3,
                true_anomaly_rad: 0.0,
            };
            let orbit = TwoBodyOrbit::from_elements(elements, GM_MERCURY_M3_S2, 0.0).unwrap();
            let plane = BPlane::from_state(&orbit.state_at(-1e4), GM_MERCURY_M3_S2).unwrap();
            let a_km_m_s = 1e3 * outgoing_change_1_s(&plane);
            assert!((a_km_m_s - 0.71).abs() < 0.005, "{a_km_m_s}");
        }
    }

    /// Hyperbolas with B a little aside, propagated until they leave.
    #[test]
    fn a_miss_changes_the_outgoing_velocity_alike_in_all_directions() {
        let start = |aside_m: Vector3<f64>| CartesianState {
            position_m: Vector3::new(-3e10, 5.1e6, 0.0) + aside_m,
            velocity_m_s: Vector3::x() * 5.2e3,
        };
        let outgoing = |aside_m: Vector3<f64>| {
            let orbit = TwoBodyOrbit::from_state(&start(aside_m), GM_MERCURY_M3_S2, 0.0).unwrap();
            orbit.state_at(1.2e7).velocity_m_s
        };
        let plane = BPlane::from_state(&start(Vector3::zeros()), GM_MERCURY_M3_S2).unwrap();
        let turned = outgoing(Vector3::zeros()).angle(&Vector3::x());
        assert!((turned / turn_rad(&plane) - 1.0).abs() < 1e-3, "{turned}");
        for across in [Vector3::y(), Vector3::z(), Vector3::new(0.0, 0.6, -0.8)] {
            let change_1_s = (outgoing(across * 1e3) - outgoing(across * -1e3)).norm() / 2e3;
            let expected_1_s = outgoing_change_1_s(&plane);
            assert!((change_1_s / expected_1_s - 1.0).abs() < 1e-3, "{change_1_s} {expected_1_s}");
        }
    }
}
