//! A direction of view, parallel or in perspective, and the order in which surfaces are painted in it.

use super::surface::{Surface, Vector, unit};

/// Distance of the eye in perspective, as a multiple of the distance across what is seen.
const EYE_DISTANCE: f64 = 2.2;
/// How near to a plane a corner counts as on it, relative to what is seen.
const ON_PLANE: f64 = 1e-6;

/// A point of the picture plane: to the right and up, in m at the target's depth.
pub(crate) type Flat = (f64, f64);

/// Viewpoint of a picture: its axes, the direction to the viewer, the target.
pub struct Camera {
    right: Vector,
    up: Vector,
    /// From the target to the viewer.
    pub viewer: Vector,
    target_m: Vector,
    /// Distance of the eye from the target; `None` in parallel projection.
    eye_m: Option<f64>,
    tolerance_m: f64,
}

impl Camera {
    /// With +Z upwards, or +Y where one looks along Z; `across_m` is the distance across what is seen.
    pub fn new(viewer: Vector, target_m: Vector, across_m: f64, is_perspective: bool) -> Option<Self> {
        let viewer = unit(viewer)?;
        let right = unit(Vector::z().cross(&viewer)).unwrap_or(Vector::x());
        let eye_m = is_perspective.then_some(EYE_DISTANCE * across_m);
        let up = viewer.cross(&right);
        Some(Self { right, up, viewer, target_m, eye_m, tolerance_m: ON_PLANE * across_m })
    }

    /// Returns the position of a point in the picture.
    pub fn flat(&self, point_m: Vector) -> Flat {
        let from_target = point_m - self.target_m;
        let nearer = self.eye_m.map_or(1.0, |eye_m| eye_m / (eye_m - from_target.dot(&self.viewer)));
        (nearer * from_target.dot(&self.right), nearer * from_target.dot(&self.up))
    }

    /// How far towards the viewer.
    pub fn depth_m(&self, point_m: Vector) -> f64 {
        (point_m - self.target_m).dot(&self.viewer)
    }

    /// Distance of the viewer above a surface's front, or its cosine in parallel projection.
    fn above(&self, surface: &Surface) -> f64 {
        match self.eye_m {
            None => surface.normal.dot(&self.viewer),
            Some(eye_m) => height_m(surface, self.target_m + eye_m * self.viewer),
        }
    }

    /// Whether one sees its front.
    pub fn sees_front(&self, surface: &Surface) -> bool {
        self.above(surface) > 0.0
    }

    /// Whether `surface`, which covers the point in the picture, is nearer than it.
    pub fn hides(&self, surface: &Surface, point_m: Vector) -> bool {
        let above = self.above(surface);
        above != 0.0 && height_m(surface, point_m) * above.signum() < -self.tolerance_m * 1e3
    }

    /// Whether `back` is painted before `front`: on the far side of its plane, or with it on the near side of its own.
    fn is_behind(&self, back: &Surface, front: &Surface) -> bool {
        let side = |of: &Surface, corners: &Surface, sign: f64| {
            let above = self.above(of);
            let is_on_side =
                |corner: &Vector| sign * above.signum() * height_m(of, *corner) <= self.tolerance_m;
            above.abs() > 1e-9 && corners.corners.iter().all(is_on_side)
        };
        side(front, back, 1.0) || side(back, front, -1.0)
    }

    /// Indices of the surfaces from the farthest to the nearest. Where planes separate a pair that may overlap, they decide
    /// (Newell, Newell and Sancha 1972); else the depth of the centres. Surfaces that cross are not cut.
    pub fn painting_order(&self, surfaces: &[Surface]) -> Vec<usize> {
        const MAX_COMPARED: usize = 1500;
        let depths: Vec<f64> = surfaces.iter().map(|surface| self.depth_m(surface.center)).collect();
        let mut waiting: Vec<usize> = (0..surfaces.len()).collect();
        waiting.sort_by(|a, b| depths[*a].total_cmp(&depths[*b]));
        if surfaces.len() > MAX_COMPARED {
            return waiting;
        }
        let boxes: Vec<[Flat; 2]> = surfaces.iter().map(|surface| self.around(surface)).collect();
        let overlap = |a: &[Flat; 2], b: &[Flat; 2]| {
            let least = self.tolerance_m;
            a[0].0 + least < b[1].0
                && b[0].0 + least < a[1].0
                && a[0].1 + least < b[1].1
                && b[0].1 + least < a[1].1
        };
        // For each surface those that must be painted before it.
        let mut before: Vec<Vec<usize>> = vec![Vec::new(); surfaces.len()];
        for (i, a) in surfaces.iter().enumerate() {
            for (j, b) in surfaces.iter().enumerate().skip(i + 1) {
                if overlap(&boxes[i], &boxes[j]) {
                    match (self.is_behind(a, b), self.is_behind(b, a)) {
                        (true, false) => before[j].push(i),
                        (false, true) => before[i].push(j),
                        _ => {}
                    }
                }
            }
        }
        let mut painted = vec![false; surfaces.len()];
        let mut order = Vec::with_capacity(surfaces.len());
        while !waiting.is_empty() {
            let is_free = |index: &usize| before[*index].iter().all(|other| painted[*other]);
            // A ring of surfaces, each before the next, has no order: the farthest begins.
            let next = waiting.remove(waiting.iter().position(is_free).unwrap_or(0));
            painted[next] = true;
            order.push(next);
        }
        order
    }

    fn around(&self, surface: &Surface) -> [Flat; 2] {
        bounds(surface.corners.iter().map(|corner| self.flat(*corner)))
    }
}

/// Lower left and upper right corner of the rectangle around some points.
pub(crate) fn bounds(points: impl Iterator<Item = Flat>) -> [Flat; 2] {
    points.fold(
        [(f64::INFINITY, f64::INFINITY), (f64::NEG_INFINITY, f64::NEG_INFINITY)],
        |[low, high], (x, y)| [(low.0.min(x), low.1.min(y)), (high.0.max(x), high.1.max(y))],
    )
}

/// Height of a point above the front of a surface's plane.
fn height_m(surface: &Surface, point_m: Vector) -> f64 {
    surface.normal.dot(&(point_m - surface.center))
}

/// Whether an outline goes around a point.
pub fn contains(outline: &[Flat], point: Flat) -> bool {
    let mut is_inside = false;
    let edges = outline.iter().zip(outline.iter().cycle().skip(1));
    for (a, b) in edges {
        if (a.1 > point.1) != (b.1 > point.1) && point.0 < a.0 + (b.0 - a.0) * (point.1 - a.1) / (b.1 - a.1) {
            is_inside = !is_inside;
        }
    }
    is_inside
}

#[cfg(test)]
mod tests;
