//! Distribution of a body torque or momentum over reaction wheels.
//!
//! Shares s solve sum s_k a_k = v for unit spin axes a_k. The pseudo-inverse has the smallest norm. The least maximum
//! minimises t = max |s_k| exactly (Markley, Reynolds, Liu, Lebsock, "Maximum torque and momentum envelopes for
//! reaction-wheel arrays", JGCD 33(5), 2010): by duality t is the greatest y.v with sum |y.a_k| <= 1, and that polytope
//! has its vertices along n = a_i x a_j. Wheels off the plane of the greatest one are at +-t; those in the plane share
//! what is left in the same way in two dimensions, and those along one line in one. Shares are continuous in v.

use nalgebra::{Matrix3, Vector3};

use crate::enumeration::enumeration;

/// Sine of the angle below which two axes count as parallel, and the least sine by which axes must leave a plane.
const PARALLEL: f64 = 1e-6;
/// Sine below which an axis counts as in a plane or perpendicular to a line.
const IN_PLANE: f64 = 1e-9;

enumeration! {
    /// How wheels share what they exert together.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Allocation {
        /// Smallest sum of squares.
        1 => PseudoInverse,
        /// Smallest largest torque.
        2 => LeastMaximum,
    }
}

/// A wheel's part in a face of the dual polytope.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Part {
    wheel: usize,
    /// Sign (off the face) or axis (on it) along the face's direction.
    along: f64,
}

/// A line in the plane of a [`Facet`]: wheels along it, and those of the plane that are not.
#[derive(Clone, Debug, PartialEq)]
struct Line {
    /// Perpendicular to the line within the plane, over the sum of the plane's wheels along it.
    across_over_sum: Vector3<f64>,
    off: Vec<Part>,
    /// Unit vector of the line over the number of wheels along it.
    line_over_count: Vector3<f64>,
    on: Vec<Part>,
}

/// A plane through at least two axes that are not parallel.
#[derive(Clone, Debug, PartialEq)]
struct Facet {
    /// Unit normal n over sum |n.a_k|.
    normal_over_sum: Vector3<f64>,
    off: Vec<Part>,
    lines: Vec<Line>,
}

/// Active wheels with what both distributions need, worked out once.
#[derive(Clone, Debug, PartialEq)]
pub struct WheelAllocator {
    axes_body: Vec<Vector3<f64>>,
    /// Rows of the pseudo-inverse; zero for inactive wheels.
    rows: Vec<Vector3<f64>>,
    facets: Vec<Facet>,
}

impl Line {
    fn new(axes: &[Vector3<f64>], members: &[usize], line: Vector3<f64>, normal: Vector3<f64>) -> Self {
        let across = normal.cross(&line);
        let is_off = |wheel: &usize| across.dot(&axes[*wheel]).abs() > IN_PLANE;
        let (off, on): (Vec<usize>, Vec<usize>) = members.iter().copied().partition(is_off);
        let sum: f64 = off.iter().map(|&wheel| across.dot(&axes[wheel]).abs()).sum();
        Self {
            across_over_sum: across / sum,
            off: parts(axes, off, &across),
            line_over_count: line / on.len() as f64,
            on: parts(axes, on, &line),
        }
    }
}

impl Facet {
    fn new(axes: &[Vector3<f64>], active: &[usize], normal: Vector3<f64>) -> Self {
        let is_off = |wheel: &usize| normal.dot(&axes[*wheel]).abs() > IN_PLANE;
        let (off, members): (Vec<usize>, Vec<usize>) = active.iter().copied().partition(is_off);
        let sum: f64 = off.iter().map(|&wheel| normal.dot(&axes[wheel]).abs()).sum();
        let lines = members.iter().map(|&wheel| Line::new(axes, &members, axes[wheel], normal)).collect();
        Self { normal_over_sum: normal / sum, off: parts(axes, off, &normal), lines }
    }
}

fn parts(axes: &[Vector3<f64>], wheels: Vec<usize>, direction: &Vector3<f64>) -> Vec<Part> {
    wheels.into_iter().map(|wheel| Part { wheel, along: direction.dot(&axes[wheel]).signum() }).collect()
}

/// The one of `items` whose vector has the greatest component of `vector` along it, with that component.
fn greatest<'a, T>(
    items: &'a [T],
    of: impl Fn(&T) -> &Vector3<f64>,
    vector: &Vector3<f64>,
) -> Option<(&'a T, f64)> {
    let mut found: Option<(&T, f64)> = None;
    for item in items {
        let component = of(item).dot(vector);
        if found.is_none_or(|(_, most)| component.abs() > most.abs()) {
            found = Some((item, component));
        }
    }
    found
}

impl WheelAllocator {
    /// From unit spin axes in the body frame; `None` unless the active ones span all directions.
    pub fn new(axes_body: &[Vector3<f64>], is_active: impl Fn(usize) -> bool) -> Option<Self> {
        let active: Vec<usize> = (0..axes_body.len()).filter(|&wheel| is_active(wheel)).collect();
        let gram: Matrix3<f64> =
            active.iter().map(|&wheel| axes_body[wheel] * axes_body[wheel].transpose()).sum();
        let inverse = gram.try_inverse().filter(|inverse| inverse.iter().all(|x| x.is_finite()))?;
        let mut normals: Vec<Vector3<f64>> = Vec::new();
        for (at, &first) in active.iter().enumerate() {
            for &second in &active[at + 1..] {
                let cross = axes_body[first].cross(&axes_body[second]);
                let normal = cross / cross.norm();
                let is_known = |known: &Vector3<f64>| known.cross(&normal).norm() <= IN_PLANE;
                if cross.norm() > PARALLEL && !normals.iter().any(is_known) {
                    normals.push(normal);
                }
            }
        }
        let leaves = |normal: &Vector3<f64>| {
            active.iter().any(|&wheel| normal.dot(&axes_body[wheel]).abs() > PARALLEL)
        };
        if !normals.iter().any(leaves) {
            return None;
        }
        let row = |wheel: usize| if is_active(wheel) { inverse * axes_body[wheel] } else { Vector3::zeros() };
        Some(Self {
            axes_body: axes_body.to_vec(),
            rows: (0..axes_body.len()).map(row).collect(),
            facets: normals.into_iter().map(|normal| Facet::new(axes_body, &active, normal)).collect(),
        })
    }

    /// The least greatest magnitude of a share that `vector_body` needs: a wheel limit over this is how much of the
    /// vector the array can give.
    pub fn least_maximum(&self, vector_body: &Vector3<f64>) -> f64 {
        greatest(&self.facets, |facet| &facet.normal_over_sum, vector_body).map_or(0.0, |(_, t)| t.abs())
    }

    /// Shares with sum over k of `shares[k]` times axis k = `vector_body`, to rounding; those of inactive wheels are 0.
    /// `shares` has as many items as there are axes.
    pub fn distribute(&self, method: Allocation, vector_body: &Vector3<f64>, shares: &mut [f64]) {
        match method {
            Allocation::PseudoInverse => {
                for (share, row) in shares.iter_mut().zip(&self.rows) {
                    *share = row.dot(vector_body);
                }
            }
            Allocation::LeastMaximum => {
                shares.fill(0.0);
                self.share_least_maximum(vector_body, shares);
            }
        }
        // Removes the rounding of axes that are nearly in a plane.
        let sum: Vector3<f64> = shares.iter().zip(&self.axes_body).map(|(share, axis)| axis * *share).sum();
        let rest = vector_body - sum;
        for (share, row) in shares.iter_mut().zip(&self.rows) {
            *share += row.dot(&rest);
        }
    }

    fn share_least_maximum(&self, vector_body: &Vector3<f64>, shares: &mut [f64]) {
        let Some((facet, most)) = greatest(&self.facets, |facet| &facet.normal_over_sum, vector_body) else {
            return;
        };
        let mut rest = *vector_body;
        let mut give = |parts: &[Part], share: f64, rest: &mut Vector3<f64>| {
            for part in parts {
                shares[part.wheel] = part.along * share;
                *rest -= self.axes_body[part.wheel] * (part.along * share);
            }
        };
        give(&facet.off, most, &mut rest);
        let Some((line, most)) = greatest(&facet.lines, |line| &line.across_over_sum, &rest) else {
            return;
        };
        give(&line.off, most, &mut rest);
        let share = line.line_over_count.dot(&rest);
        give(&line.on, share, &mut rest);
    }
}
