//! Reaction wheels: how system momentum spreads over them.

use nalgebra::{Matrix3, SymmetricEigen, Vector3};

/// Least eigenvalue of the axes' Gram matrix: axes within 1e-6 rad of a plane span no more than that.
const LEAST_EIGENVALUE: f64 = 1e-12;

/// Least size of the normal of two axes that span a face.
const LEAST_FACE: f64 = 1e-9;

/// Wheels with the smallest-norm distribution of momentum over their spin axes.
#[derive(Clone, Debug, PartialEq)]
pub struct WheelArray {
    axes_body: Vec<Vector3<f64>>,
    rows: Vec<Vector3<f64>>,
}

impl WheelArray {
    /// From unit spin axes in the body frame; `None` unless they span all three directions.
    pub fn new(axes_body: &[Vector3<f64>]) -> Option<Self> {
        let gram: Matrix3<f64> = axes_body.iter().map(|axis| axis * axis.transpose()).sum();
        if SymmetricEigen::new(gram).eigenvalues.min() < LEAST_EIGENVALUE {
            return None;
        }
        let inverse = gram.try_inverse()?;
        Some(Self {
            axes_body: axes_body.to_vec(),
            rows: axes_body.iter().map(|axis| inverse * axis).collect(),
        })
    }

    /// Number of wheels.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there is no wheel; never true for an array that could be built.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Spin momentum of wheel `wheel` (0-based) when the array holds `momentum_body_n_m_s`, in N m s.
    pub fn momentum_n_m_s(&self, wheel: usize, momentum_body_n_m_s: &Vector3<f64>) -> f64 {
        self.rows[wheel].dot(momentum_body_n_m_s)
    }

    /// Torque of the motor of wheel `wheel` (0-based) on its rotor of this inertia (kg m2), in N m, when what the array holds
    /// changes at this rate (body frame, N m) and the body's angular rate at this one (rad/s2): d/dt (h + I a.w).
    pub fn motor_n_m(
        &self,
        wheel: usize,
        inertia_kg_m2: f64,
        rate_body_n_m: &Vector3<f64>,
        acceleration_body_rad_s2: &Vector3<f64>,
    ) -> f64 {
        let carried = inertia_kg_m2 * self.axes_body[wheel].dot(acceleration_body_rad_s2);
        self.momentum_n_m_s(wheel, rate_body_n_m) + carried
    }

    /// The greatest h, in N m s, such that no wheel has to hold more than its capacity (in N m s, in the wheels' order)
    /// while the three body components of momentum all stay within -h .. +h: what a per-component dump threshold may be at
    /// most. Wheels that share momentum better than by the smallest norm would hold more.
    pub fn guaranteed_threshold_n_m_s(&self, capacities_n_m_s: impl Iterator<Item = f64>) -> f64 {
        // The corner of the cube that loads a wheel most has the signs of its row.
        let each = self.rows.iter().zip(capacities_n_m_s).map(|(row, capacity)| capacity / row.abs().sum());
        each.fold(f64::INFINITY, f64::min)
    }

    /// The greatest magnitude of momentum, in N m s, that no wheel has to hold more than its capacity for, whatever its
    /// direction.
    pub fn guaranteed_magnitude_n_m_s(&self, capacities_n_m_s: impl Iterator<Item = f64>) -> f64 {
        let each = self.rows.iter().zip(capacities_n_m_s).map(|(row, capacity)| capacity / row.norm());
        each.fold(f64::INFINITY, f64::min)
    }
}

/// The greatest h, in N m s, such that some allocation holds every momentum with body components within -h .. +h, by unit spin
/// axes and capacities in N m s; 0 unless the axes span all directions.
///
/// Method: momenta that the wheels can hold at all form a zonotope, the sum of the segments -c_k a_k .. c_k a_k; an allocation
/// that makes the greatest relative load least reaches all of it. The cube lies inside it if h |n|_1 <= sum_k c_k |a_k . n|
/// for the normal n = a_i x a_j of every face. Reference: Markley et al., "Maximum torque and momentum envelopes for
/// reaction-wheel arrays", JGCD 33, 2010.
pub fn attainable_threshold_n_m_s(axes_body: &[Vector3<f64>], capacities_n_m_s: &[f64]) -> f64 {
    let mut least_n_m_s = f64::INFINITY;
    for (first, a) in axes_body.iter().enumerate() {
        for b in &axes_body[first + 1..] {
            let normal = a.cross(b);
            let wheels = axes_body.iter().zip(capacities_n_m_s);
            let reach: f64 = wheels.map(|(axis, capacity)| capacity * axis.dot(&normal).abs()).sum();
            let size = normal.abs().sum();
            // Two parallel axes span no face.
            if size > LEAST_FACE {
                least_n_m_s = least_n_m_s.min(reach / size);
            }
        }
    }
    if least_n_m_s.is_finite() { least_n_m_s } else { 0.0 }
}

#[cfg(test)]
mod tests {
    //! The wheels together hold exactly what they were given, by the pyramid's closed form.
    use super::*;
    use approx::assert_relative_eq;

    use crate::spacecraft::{MESSENGER_TOML, PAPER_DUMP_THRESHOLDS_N_M_S, Spacecraft};

    fn pyramid() -> Vec<Vector3<f64>> {
        let c = (1.0f64 / 3.0).sqrt();
        [(c, c), (c, -c), (-c, -c), (-c, c)].iter().map(|&(x, z)| Vector3::new(x, c, z)).collect()
    }

    #[test]
    fn two_wheels_or_wheels_in_a_plane_hold_no_momentum_together() {
        let skew = [Vector3::new(0.36, 0.48, 0.8), Vector3::new(-0.6, 0.64, 0.48)];
        let between = (skew[0] * 0.3 + skew[1] * 0.7).normalize();
        assert!(WheelArray::new(&skew).is_none());
        assert!(WheelArray::new(&[skew[0], skew[1], between]).is_none());
        let off_the_plane = (between + skew[0].cross(&skew[1]) * 1e-3).normalize();
        assert!(WheelArray::new(&[skew[0], skew[1], off_the_plane]).is_some());
    }

    #[test]
    fn wheels_sum_to_the_momentum() {
        let array = WheelArray::new(&pyramid()).unwrap();
        let momentum = Vector3::new(1.0, -2.0, 0.5);
        let sum: Vector3<f64> =
            pyramid().iter().enumerate().map(|(k, axis)| axis * array.momentum_n_m_s(k, &momentum)).sum();
        assert_relative_eq!(sum, momentum, epsilon = 1e-14);
    }

    #[test]
    fn the_most_that_any_sharing_holds_is_that_of_the_closed_form() {
        // Across the normal (-2, 2, 0)/3 of two neighbours the other two reach 4 sqrt 3/9 each, and its size is 4/3.
        let h = attainable_threshold_n_m_s(&pyramid(), &[8.0; 4]);
        assert_relative_eq!(h, 16.0 / 3.0_f64.sqrt(), max_relative = 1e-14);
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        assert_eq!(attainable_threshold_n_m_s(&axes, &[2.0, 3.0, 4.0]), 2.0);
        // In a plane, along a line, none.
        assert_eq!(attainable_threshold_n_m_s(&axes[..2], &[2.0; 2]), 0.0);
        assert_eq!(attainable_threshold_n_m_s(&[Vector3::x(), Vector3::x()], &[2.0; 2]), 0.0);
        assert_eq!(attainable_threshold_n_m_s(&[], &[]), 0.0);
    }

    #[test]
    fn a_symmetric_pyramid_shares_equally() {
        let array = WheelArray::new(&pyramid()).unwrap();
        for wheel in 0..array.len() {
            assert_relative_eq!(
                array.momentum_n_m_s(wheel, &Vector3::y()),
                3.0f64.sqrt() / 4.0,
                epsilon = 1e-14
            );
        }
    }

    fn shipped(text: &str) -> (Spacecraft, f64) {
        let spacecraft = Spacecraft::from_toml("shipped.toml", text).unwrap();
        let axes: Vec<Vector3<f64>> = spacecraft.wheels.iter().map(|wheel| wheel.axis_body).collect();
        let array = WheelArray::new(&axes).unwrap();
        let threshold_n_m_s =
            array.guaranteed_threshold_n_m_s(spacecraft.wheels.iter().map(|wheel| wheel.capacity_n_m_s));
        // Any corner of the cube can be held, one a little beyond cannot.
        let loads = |scale: f64| {
            let corners = (0..8_u32).map(move |corner| {
                Vector3::from_fn(|i, _| if corner >> i & 1 == 0 { scale } else { -scale } * threshold_n_m_s)
            });
            let share = |corner: Vector3<f64>| {
                let wheels = spacecraft.wheels.iter().enumerate();
                wheels
                    .map(|(k, wheel)| array.momentum_n_m_s(k, &corner).abs() / wheel.capacity_n_m_s)
                    .fold(0.0, f64::max)
            };
            corners.map(share).fold(0.0, f64::max)
        };
        assert!(loads(1.0 - 1e-9) <= 1.0 && loads(1.0 + 1e-9) > 1.0);
        (spacecraft, threshold_n_m_s)
    }

    #[test]
    fn shipped_thresholds_are_guaranteed() {
        // MESSENGER's corner along a wheel's axis loads it by sqrt 3 x 3/4.
        let (spacecraft, guaranteed) = shipped(MESSENGER_TOML);
        assert_relative_eq!(guaranteed, 8.0 / (0.75 * 3.0_f64.sqrt()), max_relative = 1e-5);
        assert!(spacecraft.dump_threshold_n_m_s.unwrap().max() <= guaranteed);
        assert_eq!(spacecraft.dump_threshold_n_m_s, Some(Vector3::repeat(PAPER_DUMP_THRESHOLDS_N_M_S[1].1)));
        // Three wheels along the axes hold their own capacity.
        let (spacecraft, guaranteed) = shipped(include_str!("../../../resources/examples/solar-sailer.toml"));
        assert_relative_eq!(guaranteed, 2.0, epsilon = 1e-12);
        assert!(spacecraft.dump_threshold_n_m_s.unwrap().max() <= guaranteed);
    }

    #[test]
    fn a_plane_of_wheels_is_no_array() {
        assert!(WheelArray::new(&[Vector3::x(), Vector3::y(), Vector3::new(0.6, 0.8, 0.0)]).is_none());
        assert!(WheelArray::new(&[]).is_none());
    }
}
