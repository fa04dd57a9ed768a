//! Whether a point lies outside of the convex hull of others, by the Frank-Wolfe algorithm.
//!
//! The hull's point nearest to the given one is approached by moving shares of it from the farthest vertex to the nearest
//! along x (pairwise steps, which converge linearly). At each point x of the hull, counted from
//! the given one, min over the vertices of x.v / |x| is a lower bound of the distance: where it is above 0, the plane across
//! x keeps point and hull apart, which proves that the point is outside. Lacoste-Julien and Jaggi, "On the global
//! linear convergence of Frank-Wolfe optimization variants", NIPS 2015.

use nalgebra::Vector3;

/// Steps after which a point that could not be proved to be outside counts as inside.
const MOST_STEPS: usize = 4000;

/// A lower bound of the distance from the point to the hull, in the vertices' unit, where it is above `tolerance`: then the
/// point is outside. A point inside, or nearer than the tolerance, gives `None`.
pub fn is_outside(point: &Vector3<f64>, vertices: &[Vector3<f64>], tolerance: f64) -> Option<f64> {
    let offsets: Vec<Vector3<f64>> = vertices.iter().map(|vertex| vertex - point).collect();
    let mut nearest = *offsets.first()?;
    let mut shares = vec![0.0; offsets.len()];
    if let Some(first) = shares.first_mut() {
        *first = 1.0;
    }
    let mut proved = 0.0_f64;
    for _ in 0..MOST_STEPS {
        let length = nearest.norm();
        if length <= tolerance {
            return None;
        }
        let along = |k: &usize| nearest.dot(&offsets[*k]);
        let least = (0..offsets.len()).min_by(|a, b| along(a).total_cmp(&along(b)))?;
        let has_share = |k: &usize| shares[*k] > 0.0;
        let most = (0..offsets.len()).filter(has_share).max_by(|a, b| along(a).total_cmp(&along(b)))?;
        proved = proved.max(along(&least) / length);
        // The bound cannot grow beyond the distance to x itself.
        if length - proved <= 1e-3 * length || least == most {
            break;
        }
        let step = offsets[least] - offsets[most];
        let part = (-nearest.dot(&step) / step.norm_squared()).clamp(0.0, shares[most]);
        shares[most] -= part;
        shares[least] += part;
        nearest += step * part;
    }
    (proved > tolerance).then_some(proved)
}
