//! Outlines taken apart into convex parts, once, when a scene is built.

use nalgebra::{Vector2, Vector3};

use super::clip::flat_m2;
use crate::spacecraft::Polygon;

/// A surface's plane with two axes in it, and its convex parts in these axes, counter-clockwise seen from the normal.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FlatParts {
    pub origin: Vector3<f64>,
    pub east: Vector3<f64>,
    pub north: Vector3<f64>,
    pub normal: Vector3<f64>,
    pub parts: Vec<Vec<Vector2<f64>>>,
}

impl FlatParts {
    pub(super) fn new(polygon: &Polygon) -> Self {
        let origin = polygon.centroid_m();
        let normal = polygon.normal();
        let edge = polygon.vertices_m()[1] - polygon.vertices_m()[0];
        let east = (edge - normal * normal.dot(&edge)).normalize();
        let north = normal.cross(&east);
        let flat = |v: &Vector3<f64>| Vector2::new((v - origin).dot(&east), (v - origin).dot(&north));
        let mut outline: Vec<Vector2<f64>> = polygon.vertices_m().iter().map(flat).collect();
        let size_m = polygon.vertices_m().iter().map(Vector3::norm).fold(0.0, f64::max);
        drop_vertices_in_line(&mut outline, flat_m2(size_m));
        Self { origin, east, north, normal, parts: convex_parts(&outline) }
    }

    /// Vertices of a part in space.
    pub(super) fn in_space<'p>(
        &'p self,
        part: &'p [Vector2<f64>],
    ) -> impl Iterator<Item = Vector3<f64>> + 'p {
        part.iter().map(|p| self.origin + self.east * p.x + self.north * p.y)
    }
}

/// Twice the signed area of a triangle.
fn turn(a: &Vector2<f64>, b: &Vector2<f64>, c: &Vector2<f64>) -> f64 {
    (b - a).perp(&(c - a))
}

/// Drops vertices whose triangle with their neighbours has no more than twice the area `flat_m2`; three always stay.
fn drop_vertices_in_line(outline: &mut Vec<Vector2<f64>>, flat_m2: f64) {
    while outline.len() > 3 {
        let count = outline.len();
        let in_line = |i: &usize| {
            let [a, b, c] = [i + count - 1, *i, i + 1].map(|k| &outline[k % count]);
            turn(a, b, c).abs() <= flat_m2
        };
        let Some(found) = (0..count).find(in_line) else { break };
        outline.remove(found);
    }
}

/// Convex parts of a simple counter-clockwise outline: triangles by cutting off ears, joined while they stay convex.
pub(super) fn convex_parts(outline: &[Vector2<f64>]) -> Vec<Vec<Vector2<f64>>> {
    let mut parts: Vec<Vec<usize>> = if is_convex(outline, &(0..outline.len()).collect::<Vec<_>>()) {
        vec![(0..outline.len()).collect()]
    } else {
        ears(outline)
    };
    'join: loop {
        for i in 0..parts.len() {
            for j in i + 1..parts.len() {
                if let Some(joined) = join(&parts[i], &parts[j])
                    && is_convex(outline, &joined)
                {
                    parts[i] = joined;
                    parts.remove(j);
                    continue 'join;
                }
            }
        }
        break;
    }
    parts.into_iter().map(|part| part.into_iter().map(|index| outline[index]).collect()).collect()
}

fn is_convex(outline: &[Vector2<f64>], part: &[usize]) -> bool {
    let count = part.len();
    (0..count).all(|i| {
        let [a, b, c] = [i, i + 1, i + 2].map(|k| &outline[part[k % count]]);
        turn(a, b, c) >= 0.0
    })
}

fn ears(outline: &[Vector2<f64>]) -> Vec<Vec<usize>> {
    let mut left: Vec<usize> = (0..outline.len()).collect();
    let mut triangles = Vec::with_capacity(outline.len());
    while left.len() > 3 {
        let count = left.len();
        let corner = |i: usize| [(i + count - 1) % count, i, (i + 1) % count].map(|k| left[k]);
        let is_ear = |i: &usize| {
            let ear = corner(*i);
            let [a, b, c] = ear.map(|k| &outline[k]);
            let mut others = left.iter().filter(|k| !ear.contains(k)).map(|k| &outline[*k]);
            let is_outside = |p| turn(a, b, p) < 0.0 || turn(b, c, p) < 0.0 || turn(c, a, p) < 0.0;
            turn(a, b, c) > 0.0 && others.all(is_outside)
        };
        // A simple outline always has an ear, but for vertices in line, which enclose nothing and may go.
        let flat = |i: &usize| {
            let [a, b, c] = corner(*i).map(|k| &outline[k]);
            turn(a, b, c) == 0.0
        };
        let cut = (0..count).find(is_ear).or_else(|| (0..count).find(flat)).unwrap_or(0);
        triangles.push(corner(cut).to_vec());
        left.remove(cut);
    }
    triangles.push(left);
    triangles
}

/// Two parts with a common edge as one.
fn join(first: &[usize], second: &[usize]) -> Option<Vec<usize>> {
    for i in 0..first.len() {
        let (a, b) = (first[i], first[(i + 1) % first.len()]);
        let shared = (0..second.len()).find(|&j| second[j] == b && second[(j + 1) % second.len()] == a);
        if let Some(j) = shared {
            // Go round the first from b to a, then round the second from a to b, leaving out both ends.
            let round = |part: &[usize], start: usize| -> Vec<usize> {
                (0..part.len()).map(|k| part[(start + k) % part.len()]).collect()
            };
            let mut joined = round(first, i + 1);
            let rest = round(second, j + 1);
            joined.extend_from_slice(&rest[1..rest.len() - 1]);
            return Some(joined);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    //! The parts of an outline are convex and cover its area once.

    use core::f64::consts::TAU;

    use proptest::prelude::*;

    use super::*;

    fn area(part: &[Vector2<f64>]) -> f64 {
        (0..part.len()).map(|i| part[i].perp(&part[(i + 1) % part.len()]) / 2.0).sum()
    }

    #[test]
    fn a_convex_outline_stays_whole() {
        let hexagon: Vec<_> =
            (0..6).map(|i| (f64::from(i) * TAU / 6.0).sin_cos()).map(|(s, c)| Vector2::new(c, s)).collect();
        assert_eq!(convex_parts(&hexagon), vec![hexagon]);
    }

    #[test]
    fn an_l_makes_two_parts() {
        let l = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]].map(Vector2::from);
        assert_eq!(convex_parts(&l).len(), 2);
    }

    /// A rectangle with vertices along its edges, turned so that rounding bends the edges: one part of four corners.
    #[test]
    fn vertices_in_line_do_not_divide_an_outline() {
        for k in 0..200 {
            let (sin, cos) = (f64::from(k) * 0.37).sin_cos();
            let points = [[0.0, 0.0], [0.7, 0.0], [1.0, 0.0], [3.0, 0.0], [3.0, 0.9], [3.0, 1.1], [0.0, 1.1]];
            let turned = points.map(|[x, y]| Vector3::new(x * cos - y * sin, 5.0, x * sin + y * cos));
            let flat = FlatParts::new(&Polygon::new(turned.to_vec()).unwrap());
            assert_eq!(flat.parts.iter().map(Vec::len).collect::<Vec<_>>(), [4], "{k}");
            assert!((area(&flat.parts[0]) - 3.3).abs() < 1e-14);
        }
    }

    proptest! {
        #[test]
        fn parts_are_convex_and_cover_the_area(radii in prop::collection::vec(0.1..2.0_f64, 4..14)) {
            let count = radii.len() as f64;
            let star: Vec<_> = radii.iter().enumerate().map(|(i, r)| {
                let (sin, cos) = (i as f64 * TAU / count).sin_cos();
                Vector2::new(r * cos, r * sin)
            }).collect();
            let parts = convex_parts(&star);
            let total: f64 = parts.iter().map(|part| area(part)).sum();
            prop_assert!((total - area(&star)).abs() < 1e-12);
            for part in &parts {
                let all: Vec<usize> = (0..part.len()).collect();
                prop_assert!(is_convex(part, &all) && part.len() >= 3);
            }
        }
    }
}
