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
mod tests;
