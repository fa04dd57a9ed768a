//! Flat outlines that stand for a box, a cylinder, a disc and a paraboloid, each in the shape's own axes.
//!
//! A round outline becomes the regular polygon of its area: with x = pi / n for n corners, of the outer radius
//! r (2 x / sin 2x)^(1/2). A prism on it has a perimeter longer than the circle's by (tan x / x)^(1/2); a cylinder is
//! shortened by the same part: side and ends then have the cylinder's areas and, by
//! Cauchy's formula (the mean width of a convex outline is its perimeter over pi), the side shows the cylinder's area
//! broadside on average over the directions around the axis. It stays convex, so that no facet shadows another.
//!
//! A ring of a paraboloid z = r^2 / 4 f has the area of its circles and, by its facets' tilt, that of the paraboloid's
//! zone, A(r) = 2/3 pi r^2 (u^2 + u + 1) / (u^(3/2) + 1) with u = 1 + r^2 / 4 f^2, which is the usual
//! 8/3 pi f^2 (u^(3/2) - 1) without cancellation.
//!
//! The numbers enter an FMU's GUID: none hangs on the machine's own library of functions.

use core::f64::consts::PI;

use nalgebra::Vector3;

use crate::enumeration::{Enumerated, Item, enumeration};
use crate::math;
use serde::Deserialize;

enumeration! {
    /// Face of a box, in its own axes.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
    pub(crate) enum BoxFace {
        #[serde(rename = "+X")]
        1 => PlusX,
        #[serde(rename = "-X")]
        2 => MinusX,
        #[serde(rename = "+Y")]
        3 => PlusY,
        #[serde(rename = "-Y")]
        4 => MinusY,
        #[serde(rename = "+Z")]
        5 => PlusZ,
        #[serde(rename = "-Z")]
        6 => MinusZ,
    }
}

/// End of a cylinder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) enum CylinderEnd {
    #[serde(rename = "+axis")]
    Plus,
    #[serde(rename = "-axis")]
    Minus,
}

/// A flat outline with its front where the right-hand rule has its normal.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Facet {
    /// Name within the shape; empty for its only one.
    pub name: String,
    /// Corners in the shape's own axes, in m.
    pub vertices_m: Vec<Vector3<f64>>,
}

/// Sine and cosine of an angle in deg, exact at right angles.
pub(super) fn sincos_deg(angle_deg: f64) -> (f64, f64) {
    let quarters = (angle_deg / 90.0).round();
    let (sin, cos) = math::sin_cos((angle_deg - 90.0 * quarters).to_radians());
    match quarters.rem_euclid(4.0) {
        1.0 => (cos, -sin),
        2.0 => (-sin, -cos),
        3.0 => (-cos, sin),
        _ => (sin, cos),
    }
}

/// The faces of a box about the origin that it has, outside in front.
pub(super) fn box_faces(size_m: &Vector3<f64>, open: &[BoxFace]) -> Vec<Facet> {
    let faces = BoxFace::ITEMS.iter().filter(|face| !open.contains(&face.variant));
    let facet = |face: &Item<BoxFace>| {
        let (axis, side) = (face.variant as usize / 2, [1.0, -1.0][face.variant as usize % 2]);
        let (second, third) = ((axis + 1) % 3, (axis + 2) % 3);
        let corner = |(along_second, along_third): (f64, f64)| {
            let mut corner = Vector3::zeros();
            corner[axis] = side * size_m[axis] / 2.0;
            corner[second] = along_second * size_m[second] / 2.0;
            corner[third] = side * along_third * size_m[third] / 2.0;
            corner
        };
        let vertices_m = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(corner).to_vec();
        Facet { name: face.name.to_owned(), vertices_m }
    };
    faces.map(facet).collect()
}

/// Side and ends of a cylinder about Z in the middle, outside in front.
pub(super) fn cylinder_facets(radius_m: f64, height_m: f64, facets: u32, open: &[CylinderEnd]) -> Vec<Facet> {
    let corners = ring(radius_m * of_equal_area(facets), facets);
    let x = half_step_rad(facets);
    // Half the height over the perimeter's part of that of the circle.
    let half_m = height_m / 2.0 * (x / math::tan(x)).sqrt();
    let mut found = Vec::new();
    for (k, (from, to)) in sides(&corners).enumerate() {
        let at = |corner: Vector3<f64>, z_m: f64| Vector3::new(corner.x, corner.y, z_m);
        let vertices_m = vec![at(from, -half_m), at(to, -half_m), at(to, half_m), at(from, half_m)];
        found.push(Facet { name: format!("side[{}]", k + 1), vertices_m });
    }
    for (which, name, side) in [(CylinderEnd::Plus, "+axis", 1.0), (CylinderEnd::Minus, "-axis", -1.0)] {
        if open.contains(&which) {
            continue;
        }
        let mut vertices_m: Vec<_> = corners.iter().map(|v| Vector3::new(v.x, v.y, side * half_m)).collect();
        if side < 0.0 {
            vertices_m.reverse();
        }
        found.push(Facet { name: name.to_owned(), vertices_m });
    }
    found
}

/// A disc about the origin with its front along Z.
pub(super) fn disc(radius_m: f64, corners: u32) -> Vec<Facet> {
    vec![Facet { name: String::new(), vertices_m: ring(radius_m * of_equal_area(corners), corners) }]
}

/// A paraboloid with its vertex at the origin, open along Z, the hollow in front.
pub(super) fn dish_facets(radius_m: f64, depth_m: f64, facets: u32, rings: u32) -> Vec<Facet> {
    let focal_length_m = radius_m * radius_m / (4.0 * depth_m);
    let zone_m2 = |radius_m: f64| {
        let u = 1.0 + math::powi(radius_m / (2.0 * focal_length_m), 2);
        2.0 / 3.0 * PI * radius_m * radius_m * (u * u + u + 1.0) / (u * u.sqrt() + 1.0)
    };
    let outer = of_equal_area(facets);
    let inner = outer * math::cos(half_step_rad(facets));
    let mut found = Vec::new();
    let mut z_m = 0.0;
    for k in 0..rings {
        let [from_m, to_m] = [k, k + 1].map(|k| radius_m * f64::from(k) / f64::from(rings));
        let area_m2 = zone_m2(to_m) - zone_m2(from_m);
        let shown_m2 = PI * (to_m * to_m - from_m * from_m);
        // 1 / cos of the tilt is the part by which the zone is larger than what it shows.
        let slope = ((area_m2 - shown_m2).max(0.0) * (area_m2 + shown_m2)).sqrt() / shown_m2;
        let next_z_m = z_m + inner * (to_m - from_m) * slope;
        let [low, high] = [from_m, to_m].map(|radius_m| ring(outer * radius_m, facets));
        for (i, ((a, b), (c, d))) in sides(&low).zip(sides(&high)).enumerate() {
            let up = |v: Vector3<f64>, z_m: f64| Vector3::new(v.x, v.y, z_m);
            let mut vertices_m = vec![up(a, z_m), up(c, next_z_m), up(d, next_z_m)];
            if k > 0 {
                vertices_m.push(up(b, z_m));
            }
            found.push(Facet { name: format!("ring[{}][{}]", k + 1, i + 1), vertices_m });
        }
        z_m = next_z_m;
    }
    found
}

/// Half the angle between neighbouring corners.
fn half_step_rad(corners: u32) -> f64 {
    PI / f64::from(corners)
}

/// Outer radius of a regular polygon with the area of a circle of radius 1.
fn of_equal_area(corners: u32) -> f64 {
    let x = half_step_rad(corners);
    (2.0 * x / math::sin(2.0 * x)).sqrt()
}

/// Corners of a regular polygon about Z, counter-clockwise; its first side faces along X.
fn ring(outer_radius_m: f64, corners: u32) -> Vec<Vector3<f64>> {
    let corner = |k: u32| {
        let (sin, cos) = sincos_deg(360.0 * (f64::from(k) - 0.5) / f64::from(corners));
        Vector3::new(cos, sin, 0.0) * outer_radius_m
    };
    (0..corners).map(corner).collect()
}

/// Each corner with the next.
fn sides(corners: &[Vector3<f64>]) -> impl Iterator<Item = (Vector3<f64>, Vector3<f64>)> + '_ {
    corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| (*a, *b))
}
