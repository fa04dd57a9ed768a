//! Whether a point lies outside of the convex hull of others, by the Frank-Wolfe algorithm.
//!
//! The hull's point nearest to the given one is approached along lines to vertices. At each point x of the hull, counted from
//! the given one, min over the vertices of x.v / |x| is a lower bound of the distance: where it is above 0, the plane across
//! x keeps point and hull apart, which proves that the point is outside. Jaggi, "Revisiting Frank-Wolfe", ICML 2013.

use nalgebra::Vector3;

/// Steps after which a point that could not be proved to be outside counts as inside.
const MOST_STEPS: usize = 4000;

/// A lower bound of the distance from the point to the hull, in the vertices' unit, where it is above `tolerance`: then the
/// point is outside. A point inside, or nearer than the tolerance, gives `None`.
pub fn is_outside(point: &Vector3<f64>, vertices: &[Vector3<f64>], tolerance: f64) -> Option<f64> {
    let mut nearest = vertices.first()? - point;
    let mut proved = 0.0_f64;
    for _ in 0..MOST_STEPS {
        let length = nearest.norm();
        if length <= tolerance {
            return None;
        }
        let along = |vertex: &Vector3<f64>| nearest.dot(&(vertex - point));
        let least = vertices.iter().min_by(|a, b| along(a).total_cmp(&along(b)))?;
        let bound = along(least) / length;
        proved = proved.max(bound);
        // The bound cannot grow beyond the distance to x itself.
        if length - proved <= 1e-3 * length {
            break;
        }
        let step = (least - point) - nearest;
        let part = -nearest.dot(&step) / step.norm_squared();
        nearest += step * part.clamp(0.0, 1.0);
    }
    (proved > tolerance).then_some(proved)
}
