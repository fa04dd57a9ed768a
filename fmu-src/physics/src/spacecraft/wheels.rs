//! Reaction wheels: their axes and what momentum they hold together.

use nalgebra::Vector3;
use serde::Serialize;

/// One reaction wheel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Wheel {
    /// For messages.
    pub name: String,
    /// Unit vector of the spin axis; positive speed is right-handed about it.
    pub axis_body: Vector3<f64>,
    /// Greatest momentum of the rotor about its axis, in N m s.
    pub capacity_n_m_s: f64,
}

/// Dump thresholds paper 000 states beside the capacity of each of four wheels, both in N m s; it does not publish
/// the wheels' axes.
pub const PAPER_DUMP_THRESHOLDS_N_M_S: [(f64, f64); 3] = [(4.0, 4.0), (8.0, 5.5), (12.0, 7.0)];

/// Two axes whose cross product is shorter than this are parallel.
const PARALLEL: f64 = 1e-9;

/// The greatest momentum, in N m s, the wheels can hold along `direction_body` (a unit vector) and its opposite.
///
/// All momenta the wheels can hold together form a convex body (a zonotope) whose faces have the normals n = a_i x a_j;
/// its extent along n is sum_k C_k |a_k . n|. Without three independent axes the answer is 0 for a direction outside
/// the span of the axes.
pub fn momentum_capacity_n_m_s(wheels: &[Wheel], direction_body: &Vector3<f64>) -> f64 {
    least_over_faces(wheels.iter().map(axis_and_capacity), |normal| normal.dot(direction_body).abs())
}

/// The greatest threshold h, in N m s, such that the wheels can hold every momentum whose three body components all
/// stay within -h .. +h: what a per-component dump threshold may be at most.
pub fn guaranteed_threshold_n_m_s(wheels: &[Wheel]) -> f64 {
    guaranteed_threshold_of(wheels.iter().map(axis_and_capacity))
}

/// The same for wheels given as unit axis (body frame) and capacity (N m s).
pub fn guaranteed_threshold_of(wheels: impl Iterator<Item = (Vector3<f64>, f64)> + Clone) -> f64 {
    least_over_faces(wheels, |normal| normal.abs().sum())
}

fn axis_and_capacity(wheel: &Wheel) -> (Vector3<f64>, f64) {
    (wheel.axis_body, wheel.capacity_n_m_s)
}

/// Least of (extent of the wheels) / (extent of the body asked for) over all faces.
fn least_over_faces(
    wheels: impl Iterator<Item = (Vector3<f64>, f64)> + Clone,
    asked_extent: impl Fn(&Vector3<f64>) -> f64,
) -> f64 {
    let mut least = f64::INFINITY;
    let mut consider = |normal: Vector3<f64>| {
        let held: f64 =
            wheels.clone().map(|(axis, capacity_n_m_s)| capacity_n_m_s * axis.dot(&normal).abs()).sum();
        let asked = asked_extent(&normal);
        if asked > PARALLEL {
            least = least.min(held / asked);
        }
    };
    let mut rank_above_one = false;
    for (i, (first, _)) in wheels.clone().enumerate() {
        for (second, _) in wheels.clone().skip(i + 1) {
            let normal = first.cross(&second);
            if normal.norm() > PARALLEL {
                rank_above_one = true;
                let normal = normal.normalize();
                consider(normal);
                // The body of coplanar axes is a flat polygon: its edges bound it too.
                consider(normal.cross(&first));
                consider(normal.cross(&second));
            }
        }
    }
    if let (false, Some((axis, _))) = (rank_above_one, wheels.clone().next()) {
        let across = axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize();
        consider(axis);
        consider(across);
        consider(axis.cross(&across));
    }
    if least.is_finite() { least } else { 0.0 }
}

#[cfg(test)]
mod tests {
    //! What wheels hold together, against arrangements solved by hand and against random search.

    use approx::assert_relative_eq;
    use proptest::prelude::*;

    use super::*;

    fn wheels(axes: &[[f64; 3]], capacity_n_m_s: f64) -> Vec<Wheel> {
        axes.iter()
            .map(|axis| Wheel {
                name: String::new(),
                axis_body: Vector3::from(*axis).normalize(),
                capacity_n_m_s,
            })
            .collect()
    }

    const PYRAMID: [[f64; 3]; 4] = [[1.0, 1.0, 1.0], [-1.0, 1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, 1.0, -1.0]];

    #[test]
    fn three_wheels_along_the_axes_hold_their_own_capacity() {
        let wheels = wheels(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], 3.0);
        assert_relative_eq!(guaranteed_threshold_n_m_s(&wheels), 3.0, epsilon = 1e-14);
        let diagonal = Vector3::repeat(1.0 / 3_f64.sqrt());
        assert_relative_eq!(momentum_capacity_n_m_s(&wheels, &diagonal), 3.0 * 3_f64.sqrt(), epsilon = 1e-14);
    }

    #[test]
    fn a_pyramid_holds_four_projections_along_its_axis() {
        let wheels = wheels(&PYRAMID, 8.0);
        let projected = 8.0 * 4.0 / 3_f64.sqrt();
        assert_relative_eq!(momentum_capacity_n_m_s(&wheels, &Vector3::y()), projected, epsilon = 1e-12);
        assert_relative_eq!(guaranteed_threshold_n_m_s(&wheels), projected / 2.0, epsilon = 1e-12);
    }

    #[test]
    fn flat_and_single_arrangements_hold_nothing_across() {
        let flat = wheels(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], 2.0);
        assert_relative_eq!(momentum_capacity_n_m_s(&flat, &Vector3::x()), 2.0, epsilon = 1e-14);
        assert_eq!(momentum_capacity_n_m_s(&flat, &Vector3::z()), 0.0);
        assert_eq!(guaranteed_threshold_n_m_s(&flat), 0.0);
        let one = wheels(&[[0.0, 0.0, 1.0]], 2.0);
        assert_relative_eq!(momentum_capacity_n_m_s(&one, &Vector3::z()), 2.0, epsilon = 1e-14);
        assert_eq!(momentum_capacity_n_m_s(&one, &Vector3::x()), 0.0);
        assert_eq!(guaranteed_threshold_n_m_s(&[]), 0.0);
    }

    proptest! {
        /// Whatever the wheels really hold lies within what is said, and the face's corner reaches it.
        #[test]
        fn no_wheel_momenta_reach_further(
            axes in prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64), 3..6),
            speeds in prop::collection::vec(-1.0..1.0_f64, 6),
        ) {
            prop_assume!(axes.iter().all(|a| Vector3::from(*a).norm() > 0.1));
            let wheels = wheels(&axes, 2.0);
            let held: Vector3<f64> =
                wheels.iter().zip(&speeds).map(|(w, s)| w.axis_body * (w.capacity_n_m_s * s)).sum();
            prop_assume!(held.norm() > 1e-3);
            let direction = held.normalize();
            prop_assert!(held.norm() <= momentum_capacity_n_m_s(&wheels, &direction) * (1.0 + 1e-9));
            let threshold = guaranteed_threshold_n_m_s(&wheels);
            for corner in 0..8_u32 {
                let corner = Vector3::from_fn(|i, _| if corner >> i & 1 == 0 { threshold } else { -threshold });
                let within = momentum_capacity_n_m_s(&wheels, &corner.normalize());
                prop_assert!(corner.norm() <= within * (1.0 + 1e-9) + 1e-12);
            }
        }
    }
}
