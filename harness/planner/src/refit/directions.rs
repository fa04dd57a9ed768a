//! Principal directions of what is fitted: what the history determines, and what stays at its prior.

use nalgebra::{Matrix4, SymmetricEigen, Vector4};
use serde::Serialize;

/// A history determines a direction if it leaves at most this part of the prior's deviation.
const DETERMINED: f64 = 0.5;
/// A direction has no part in `solar.scale` if that is smaller.
const NONE: f64 = 1e-12;

/// A direction in the space of what is fitted, each coordinate in units of its prior's deviation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Direction {
    /// Unit vector: centre of mass X, Y, Z, and `solar.scale`, the greatest positive.
    pub vector: Vector4<f64>,
    /// Standard deviation along it after the fit, as a part of the prior's.
    pub sigma: f64,
    /// Whether the history determines it; otherwise it stays at its prior.
    pub observable: bool,
}

/// Eigenvectors of the information that the history has, J'J in units of the noise and the priors, the best determined first.
///
/// Directions that nothing determines are degenerate: any turn among them is as good. They are turned so that at most one has a
/// part in `solar.scale`, and the others are directions of the centre of mass.
pub(super) fn principal(information: &Matrix4<f64>) -> [Direction; 4] {
    let SymmetricEigen { eigenvectors, eigenvalues } = SymmetricEigen::new(*information);
    let mut order = [0, 1, 2, 3];
    order.sort_by(|a, b| eigenvalues[*b].total_cmp(&eigenvalues[*a]));
    let mut directions = order.map(|at| {
        let sigma = 1.0 / (1.0 + eigenvalues[at].max(0.0)).sqrt();
        let vector = eigenvectors.column(at).into_owned();
        let observable = sigma <= DETERMINED;
        // Nothing of the history is used along it.
        Direction { vector, sigma: if observable { sigma } else { 1.0 }, observable }
    });
    let first = directions.iter().position(|it| !it.observable).unwrap_or(directions.len());
    gather_scale(&mut directions[first..]);
    directions.map(|it| Direction { vector: it.vector * sense(&it.vector), ..it })
}

/// Turns directions pair by pair (Givens) until only the first has a part in `solar.scale`.
fn gather_scale(directions: &mut [Direction]) {
    let [first, others @ ..] = directions else { return };
    for other in others {
        let [a, b] = [first.vector.w, other.vector.w];
        let radius = a.hypot(b);
        if radius > NONE {
            let [cosine, sine] = [a / radius, b / radius];
            let before = first.vector;
            first.vector = before * cosine + other.vector * sine;
            other.vector = other.vector * cosine - before * sine;
        }
    }
}

/// +1 or -1, by which the greatest component becomes positive.
fn sense(vector: &Vector4<f64>) -> f64 {
    vector.as_slice().iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs())).map_or(1.0, f64::signum)
}
