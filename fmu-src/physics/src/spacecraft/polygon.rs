//! Flat outlines: checked to be plane and simple, with area, centroid and normal.

use nalgebra::Vector3;
use serde::Serialize;

use crate::refusal::Refusal;

/// Vertices off the plane of their polygon by up to this part of its size are in it.
const PLANE_TOLERANCE: f64 = 1e-6;

/// Vertices are moved onto the plane from up to here, in m: coordinates are often written in whole millimetres ...
const ROUNDING_M: f64 = 1e-3;

/// ... but of a small polygon no more than this part of its size.
const ROUNDING_OF_SIZE: f64 = 0.005;

/// Vertices nearer than this part of the polygon's size are one.
const SAME_VERTEX: f64 = 1e-9;

/// A plane polygon whose boundary does not cross itself; counter-clockwise seen from where the normal points.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Polygon {
    vertices_m: Vec<Vector3<f64>>,
    /// How far a vertex was off the plane before it was moved onto it.
    #[serde(skip)]
    off_plane_m: f64,
}

impl Polygon {
    /// Checks the outline; its normal follows the right-hand rule. Vertices that are off its plane by rounding are moved onto
    /// it: the plane through their mean across the area vector.
    ///
    /// # Errors
    /// Fewer than three vertices, vertices that coincide, are not finite, or not in one plane (within 1 mm, and 0.5 % of the
    /// polygon's size), no area, or edges that cross.
    pub fn new(vertices_m: Vec<Vector3<f64>>) -> Result<Self, Refusal> {
        let count = vertices_m.len();
        if count < 3 {
            return Err(Refusal::new(format_args!("{count} vertices"), "at least 3"));
        }
        if let Some(vertex) = vertices_m.iter().position(|v| !v.iter().all(|x| x.is_finite())) {
            let found = format_args!("vertex {} that is not finite", vertex + 1);
            return Err(Refusal::new(found, "finite numbers"));
        }
        let mut polygon = Self { vertices_m, off_plane_m: 0.0 };
        let size_m = polygon.size_m();
        for (i, a) in polygon.vertices_m.iter().enumerate() {
            for (j, b) in polygon.vertices_m.iter().enumerate().skip(i + 1) {
                if (a - b).norm() <= SAME_VERTEX * size_m {
                    let found = format_args!("vertices {} and {} in one place", i + 1, j + 1);
                    return Err(Refusal::new(found, "distinct vertices"));
                }
            }
        }
        if polygon.area_vector_m2().norm() <= SAME_VERTEX * size_m * size_m {
            return Err(Refusal::new("vertices on one line", "an outline with an area"));
        }
        let normal = polygon.normal();
        let center = polygon.vertices_m.iter().sum::<Vector3<f64>>() / count as f64;
        let allowed_m = (PLANE_TOLERANCE * size_m).max(ROUNDING_M.min(ROUNDING_OF_SIZE * size_m));
        for (i, vertex) in polygon.vertices_m.iter().enumerate() {
            let distance_m = normal.dot(&(vertex - center)).abs();
            if distance_m > allowed_m {
                return Err(Refusal::new(
                    format_args!("vertex {} lies {distance_m:e} m off the plane of the polygon", i + 1),
                    format_args!("{allowed_m:e} m"),
                ));
            }
            polygon.off_plane_m = polygon.off_plane_m.max(distance_m);
        }
        if polygon.off_plane_m <= PLANE_TOLERANCE * size_m {
            polygon.off_plane_m = 0.0;
        } else {
            let flat = |vertex: &Vector3<f64>| vertex - normal * normal.dot(&(vertex - center));
            polygon.vertices_m = polygon.vertices_m.iter().map(flat).collect();
        }
        polygon.check_simple(&normal)?;
        Ok(polygon)
    }

    /// Vertices in order, in m.
    pub fn vertices_m(&self) -> &[Vector3<f64>] {
        &self.vertices_m
    }

    /// The farthest that a vertex was off the plane, in m, before it was moved onto it; 0 if none had to be.
    pub fn off_plane_m(&self) -> f64 {
        self.off_plane_m
    }

    /// Unit normal by the right-hand rule.
    pub fn normal(&self) -> Vector3<f64> {
        self.area_vector_m2().normalize()
    }

    /// Area in m2.
    pub fn area_m2(&self) -> f64 {
        self.area_vector_m2().norm()
    }

    /// Centre of area in m.
    pub fn centroid_m(&self) -> Vector3<f64> {
        let normal = self.normal();
        let origin = self.vertices_m[0];
        let mut sum = Vector3::zeros();
        let mut area = 0.0;
        for (a, b) in self.edges() {
            let (a, b) = (a - origin, b - origin);
            let part = normal.dot(&a.cross(&b)) / 2.0;
            area += part;
            sum += (a + b) * (part / 3.0);
        }
        origin + sum / area
    }

    /// The same outline seen from behind.
    pub fn reversed(&self) -> Self {
        Self { vertices_m: self.vertices_m.iter().rev().copied().collect(), off_plane_m: self.off_plane_m }
    }

    /// The outline after a motion that keeps lengths and angles.
    pub fn moved(&self, motion: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Self {
        Self { vertices_m: self.vertices_m.iter().map(motion).collect(), off_plane_m: self.off_plane_m }
    }

    fn edges(&self) -> impl Iterator<Item = (Vector3<f64>, Vector3<f64>)> + '_ {
        let next = self.vertices_m.iter().cycle().skip(1);
        self.vertices_m.iter().zip(next).map(|(a, b)| (*a, *b))
    }

    /// Newell's vector: area times normal.
    fn area_vector_m2(&self) -> Vector3<f64> {
        let origin = self.vertices_m[0];
        self.edges().map(|(a, b)| (a - origin).cross(&(b - origin)) / 2.0).sum()
    }

    fn size_m(&self) -> f64 {
        let first = self.vertices_m[0];
        2.0 * self.vertices_m.iter().map(|v| (v - first).norm()).fold(0.0, f64::max)
    }

    fn check_simple(&self, normal: &Vector3<f64>) -> Result<(), Refusal> {
        let edges: Vec<_> = self.edges().collect();
        let count = edges.len();
        let side =
            |(a, b): (Vector3<f64>, Vector3<f64>), p: Vector3<f64>| normal.dot(&(b - a).cross(&(p - a)));
        let between = |(a, b): (Vector3<f64>, Vector3<f64>), p: Vector3<f64>| (p - a).dot(&(p - b)) <= 0.0;
        for i in 0..count {
            for j in i + 1..count {
                let (first, second) = (edges[i], edges[j]);
                let crossing = || {
                    let found = format_args!("edges {} and {} cross or touch", i + 1, j + 1);
                    Err(Refusal::new(found, "an outline that does not cross itself"))
                };
                if j == i + 1 || (i == 0 && j == count - 1) {
                    // Neighbours share a vertex; they must not fold back onto each other.
                    let (before, after) = if j == i + 1 { (first, second) } else { (second, first) };
                    let (u, v) = (before.0 - before.1, after.1 - after.0);
                    let flat = u.cross(&v).norm() <= SAME_VERTEX * u.norm() * v.norm();
                    if flat && u.dot(&v) > 0.0 {
                        return crossing();
                    }
                    continue;
                }
                let (a, b) = (side(first, second.0), side(first, second.1));
                let (c, d) = (side(second, first.0), side(second, first.1));
                let proper = a * b < 0.0 && c * d < 0.0;
                let touching = (a == 0.0 && between(first, second.0))
                    || (b == 0.0 && between(first, second.1))
                    || (c == 0.0 && between(second, first.0))
                    || (d == 0.0 && between(second, first.1));
                if proper || touching {
                    return crossing();
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
