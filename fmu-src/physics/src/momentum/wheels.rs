//! Reaction wheels: how system momentum spreads over them.

use nalgebra::{Matrix3, Vector3};

/// Wheels with the smallest-norm distribution of momentum over their spin axes.
#[derive(Clone, Debug, PartialEq)]
pub struct WheelArray {
    rows: Vec<Vector3<f64>>,
}

impl WheelArray {
    /// From unit spin axes in the body frame; `None` unless they span all three directions.
    pub fn new(axes_body: &[Vector3<f64>]) -> Option<Self> {
        let gram: Matrix3<f64> = axes_body.iter().map(|axis| axis * axis.transpose()).sum();
        let inverse = gram.try_inverse().filter(|inverse| inverse.iter().all(|x| x.is_finite()))?;
        Some(Self { rows: axes_body.iter().map(|axis| inverse * axis).collect() })
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
}

#[cfg(test)]
mod tests {
    //! The wheels together hold exactly what they were given, by the pyramid's closed form.
    use super::*;
    use approx::assert_relative_eq;

    fn pyramid() -> Vec<Vector3<f64>> {
        let c = (1.0f64 / 3.0).sqrt();
        [(c, c), (c, -c), (-c, -c), (-c, c)].iter().map(|&(x, z)| Vector3::new(x, c, z)).collect()
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

    #[test]
    fn a_plane_of_wheels_is_no_array() {
        assert!(WheelArray::new(&[Vector3::x(), Vector3::y(), Vector3::new(0.6, 0.8, 0.0)]).is_none());
        assert!(WheelArray::new(&[]).is_none());
    }
}
