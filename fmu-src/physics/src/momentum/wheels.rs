//! Reaction wheels: how system momentum spreads over them.

use nalgebra::{Matrix3, SymmetricEigen, Vector3};

/// A body axis off what the axes span by less lies in it.
const IN_SPAN: f64 = 1e-6;

/// Least eigenvalue of the axes' Gram matrix: axes within 1e-6 rad of a plane span no more than that.
const LEAST_EIGENVALUE: f64 = 1e-12;

/// Least size of the normal of two axes that span a face.
const LEAST_FACE: f64 = 1e-9;

/// Wheels with the smallest-norm distribution of momentum over their spin axes: the pseudo-inverse of the axes, whatever they span.
#[derive(Clone, Debug, PartialEq)]
pub struct WheelArray {
    axes_body: Vec<Vector3<f64>>,
    rows: Vec<Vector3<f64>>,
    /// How many directions the axes span.
    rank: usize,
}

impl WheelArray {
    /// From unit spin axes in the body frame; `None` unless they span all three directions.
    pub fn new(axes_body: &[Vector3<f64>]) -> Option<Self> {
        Some(Self::from_axes(axes_body)).filter(Self::spans_all)
    }

    /// From unit spin axes in the body frame, which may lie in a plane or a line; a zero vector is a wheel that holds nothing.
    pub fn from_axes(axes_body: &[Vector3<f64>]) -> Self {
        let gram: Matrix3<f64> = axes_body.iter().map(|axis| axis * axis.transpose()).sum();
        let eigenvalues = SymmetricEigen::new(gram).eigenvalues;
        let rank = eigenvalues.iter().filter(|value| **value >= LEAST_EIGENVALUE).count();
        // With the projection on what they leave out the matrix has an inverse, which is the pseudo-inverse on their span.
        let regular = match rank {
            3 => gram,
            _ => gram + projection_across(axes_body, rank),
        };
        let inverse = regular.try_inverse().unwrap_or_default();
        Self {
            axes_body: axes_body.to_vec(),
            rows: axes_body.iter().map(|axis| inverse * axis).collect(),
            rank,
        }
    }

    /// Whether the axes span all three directions.
    pub fn spans_all(&self) -> bool {
        self.rank == 3
    }

    /// Body axes along which the wheels hold momentum.
    pub fn spanned(&self) -> [bool; 3] {
        [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| (self.held(&axis) - axis).norm() < IN_SPAN)
    }

    /// The part of a momentum that lies along the axes, body frame, in N m s.
    fn held(&self, momentum_body_n_m_s: &Vector3<f64>) -> Vector3<f64> {
        let each = self.axes_body.iter().zip(&self.rows);
        each.map(|(axis, row)| axis * row.dot(momentum_body_n_m_s)).sum()
    }

    /// Momentum that wheels of these momenta along their axes hold together, body frame, in N m s.
    pub fn sum_body_n_m_s(&self, momenta_n_m_s: impl Iterator<Item = f64>) -> Vector3<f64> {
        self.axes_body.iter().zip(momenta_n_m_s).map(|(axis, momentum)| axis * momentum).sum()
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
        if self.spans_all() { self.box_n_m_s(capacities_n_m_s) } else { 0.0 }
    }

    /// The same by body axis, of axes in a plane or a line about those that they span; infinite about others, which wheels do not
    /// keep from growing.
    pub fn spanned_threshold_n_m_s(&self, capacities_n_m_s: impl Iterator<Item = f64>) -> Vector3<f64> {
        let box_n_m_s = self.box_n_m_s(capacities_n_m_s);
        Vector3::from(self.spanned().map(|is_spanned| if is_spanned { box_n_m_s } else { f64::INFINITY }))
    }

    /// Half the edge of the cube about the spanned body axes that the wheels hold.
    fn box_n_m_s(&self, capacities_n_m_s: impl Iterator<Item = f64>) -> f64 {
        let spanned = Vector3::from(self.spanned().map(|it| f64::from(u8::from(it))));
        // The corner of the cube that loads a wheel most has the signs of its row.
        let load = |row: &Vector3<f64>| row.abs().component_mul(&spanned).sum();
        let each = self.rows.iter().zip(capacities_n_m_s).map(|(row, capacity)| capacity / load(row));
        // A wheel that no spanned axis loads limits nothing.
        each.filter(|it| !it.is_nan()).fold(f64::INFINITY, f64::min)
    }
}

/// Momentum of wheels with these axes, of any length but zero, and momenta along them together, body frame, in N m s.
pub fn wheels_body_n_m_s(wheels: impl Iterator<Item = (Vector3<f64>, f64)>) -> Vector3<f64> {
    let along =
        |(axis, momentum): (Vector3<f64>, f64)| axis.try_normalize(0.0).unwrap_or_default() * momentum;
    wheels.map(along).sum()
}

/// Projection on the directions across axes that span `rank` of them.
fn projection_across(axes_body: &[Vector3<f64>], rank: usize) -> Matrix3<f64> {
    let pairs = axes_body.iter().enumerate().flat_map(|(k, a)| axes_body[k + 1..].iter().map(|b| a.cross(b)));
    let normal = pairs.max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()));
    let line = axes_body.iter().max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()));
    match (rank, normal, line) {
        (2, Some(normal), _) => {
            let normal = normal.normalize();
            normal * normal.transpose()
        }
        (1, _, Some(line)) => Matrix3::identity() - line * line.transpose(),
        _ => Matrix3::identity(),
    }
}

/// Momentum that wheels hold by the three meanings of their capacity, in N m s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelCapacity {
    /// Radius of the sphere inscribed in all momenta that some allocation holds: any direction.
    pub sphere_n_m_s: f64,
    /// Half the edge of the cube inscribed there: all body components at once.
    pub box_n_m_s: f64,
    /// Half the edge of the cube that the least-norm allocation holds, as the plant shares momentum.
    pub least_norm_box_n_m_s: f64,
}

impl WheelCapacity {
    /// By unit spin axes and capacities in N m s; `None` unless the axes span all directions.
    ///
    /// Method: momenta that the wheels can hold at all form a zonotope, the sum of the segments -c_k a_k .. c_k a_k; an allocation
    /// that makes the greatest relative load least reaches all of it. For the normal n = a_i x a_j of every face, a sphere of
    /// radius r lies inside it if r |n|_2 <= sum_k c_k |a_k . n|, a cube of half edge h if h |n|_1 <= that sum. Reference: Markley
    /// et al., "Maximum torque and momentum envelopes for reaction-wheel arrays", JGCD 33, 2010.
    pub fn new(axes_body: &[Vector3<f64>], capacities_n_m_s: &[f64]) -> Option<Self> {
        let least_norm = WheelArray::new(axes_body)?;
        let (mut sphere_n_m_s, mut box_n_m_s) = (f64::INFINITY, f64::INFINITY);
        for (first, a) in axes_body.iter().enumerate() {
            for b in &axes_body[first + 1..] {
                let normal = a.cross(b);
                // Two parallel axes span no face.
                if normal.abs().sum() > LEAST_FACE {
                    let wheels = axes_body.iter().zip(capacities_n_m_s);
                    let reach: f64 = wheels.map(|(axis, capacity)| capacity * axis.dot(&normal).abs()).sum();
                    sphere_n_m_s = sphere_n_m_s.min(reach / normal.norm());
                    box_n_m_s = box_n_m_s.min(reach / normal.abs().sum());
                }
            }
        }
        let least_norm_box_n_m_s = least_norm.guaranteed_threshold_n_m_s(capacities_n_m_s.iter().copied());
        Some(Self { sphere_n_m_s, box_n_m_s, least_norm_box_n_m_s })
    }
}

#[cfg(test)]
mod tests;
