//! Copies of a plate or shape: in a row, around an axis, mirrored.

use nalgebra::{Matrix3, Vector3};

use super::facets::sincos_deg;
use super::part_reader::PartReader;
use super::polygon::Polygon;
use super::surface::Plate;
use crate::toml::{Copies, Point, TurnEither, UnitVector, Written, tables};
use serde::Deserialize;

/// A plane of the body frame, through its origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub(crate) enum MirrorPlane {
    /// x = 0.
    X,
    /// y = 0.
    Y,
    /// z = 0.
    Z,
}

tables! {
/// Copies in a row (`step_m`) or around an axis (`axis`).
struct RepeatDescription {
    /// How many there are, the one that is written among them.
    count: Copies,
    /// From each to the next, in m.
    step_m: Option<Point>,
    /// Unit vector of the axis that each is turned about from the one before.
    axis: Option<UnitVector>,
    /// Angle from each to the next, right-handed about `axis`, in deg; 360 over the count unless given.
    angle_deg: Option<TurnEither>,
    /// A point of the axis, in m.
    point_m: Point = [0.0, 0.0, 0.0],
} rules {
    Requires angle_deg => axis: "no `axis` beside it", "with `axis` alone";
    Requires point_m => axis: "no `axis` beside it", "with `axis` alone";
    Either step_m => axis: "both `step_m` and `axis`", "one of them";
    AnyOf step_m axis: "neither `step_m` nor `axis`", "one of them";
}
}

/// Most plates that one shape and its copies may come to.
pub(super) const MOST_PLATES: usize = 2000;

/// Two plates are one if they differ by no more than this part of their size.
const SAME_PLACE: f64 = 1e-6;

/// Motion from the original to a copy: turned or mirrored by a matrix, then shifted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Motion {
    matrix: Matrix3<f64>,
    shift_m: Vector3<f64>,
}

impl Motion {
    /// The point after the motion.
    pub(super) fn moved_point(&self, point_m: &Vector3<f64>) -> Vector3<f64> {
        self.matrix * point_m + self.shift_m
    }

    /// The outline after the motion; a mirrored one runs the other way round, so that its front stays in front.
    pub(super) fn moved_outline(&self, outline: &Polygon) -> Polygon {
        let moved = outline.moved(|vertex| self.moved_point(vertex));
        if self.matrix.determinant() < 0.0 { moved.reversed() } else { moved }
    }

    fn mirrored(&self, plane: MirrorPlane) -> Self {
        let mirror = |i: usize| if i == plane as usize { -1.0 } else { 1.0 };
        let mirror = Vector3::from_fn(|i, _| mirror(i));
        Self {
            matrix: Matrix3::from_diagonal(&mirror) * self.matrix,
            shift_m: self.shift_m.component_mul(&mirror),
        }
    }
}

/// Every copy, the one that is written first: those of `repeat`, then the mirror images of all before.
pub(super) fn motions(
    part: &PartReader<'_>,
    mirror: Option<&[MirrorPlane]>,
    repeat: Option<&RepeatDescription>,
) -> Vec<Motion> {
    let itself = Motion { matrix: Matrix3::identity(), shift_m: Vector3::zeros() };
    let repeated = part.optional("repeat", repeat, |_, repeat| repeated(repeat)).flatten();
    let mut motions = repeated.unwrap_or_else(|| vec![itself]);
    let planes = mirror.unwrap_or_default();
    if mirror.is_some_and(<[_]>::is_empty) {
        part.key("mirror").report("an empty list", "at least one of x, y, z, or no such key");
    }
    for (k, plane) in planes.iter().enumerate() {
        if planes[..k].contains(plane) {
            part.key("mirror").item(k).report("the same plane again", "each of x, y, z once");
            continue;
        }
        let images: Vec<Motion> = motions.iter().map(|motion| motion.mirrored(*plane)).collect();
        motions.extend(images);
    }
    motions
}

/// Name of a copy: its number in brackets where there are several.
pub(super) fn copy_name(name: &str, index: usize, count: usize) -> String {
    if count == 1 { name.to_owned() } else { format!("{name}[{}]", index + 1) }
}

/// Reports a copy that lies where an earlier one does; `count` copies have each the same number of plates.
pub(super) fn check_apart(part: &PartReader<'_>, plates: &[Plate], count: usize) {
    for (index, later) in plates.iter().enumerate().skip(plates.len() / count.max(1)) {
        let size_m = later.area_m2.sqrt();
        let is_same = |plate: &&Plate| {
            (plate.center_m - later.center_m).norm() <= SAME_PLACE * size_m
                && plate.normal.dot(&later.normal) >= 1.0 - SAME_PLACE
                && (plate.area_m2 / later.area_m2 - 1.0).abs() <= SAME_PLACE
        };
        if let Some(earlier) = plates[..index].iter().find(is_same) {
            let found = format!("`{}` in the place of `{}`", later.name, earlier.name);
            part.report(found, "copies that lie apart");
            return;
        }
    }
}

/// Copies of a plate, itself among them.
pub(super) fn plate_copies(plate: &Plate, motions: &[Motion]) -> Vec<Plate> {
    let copy = |(index, motion): (usize, &Motion)| Plate {
        name: copy_name(&plate.name, index, motions.len()),
        center_m: motion.moved_point(&plate.center_m),
        normal: motion.matrix * plate.normal,
        polygon: plate.polygon.as_ref().map(|outline| motion.moved_outline(outline)),
        ..plate.clone()
    };
    if motions.len() == 1 {
        return vec![plate.clone()];
    }
    motions.iter().enumerate().map(copy).collect()
}

fn repeated(repeat: &RepeatDescription) -> Option<Vec<Motion>> {
    let Copies(count) = repeat.count;
    let angle_deg = repeat.angle_deg.map_or(360.0 / f64::from(count), |it| it.0);
    let motion = |k: u32| match (repeat.step_m.value(), repeat.axis.value()) {
        (Some(step_m), None) => Some(Motion { matrix: Matrix3::identity(), shift_m: step_m * f64::from(k) }),
        (None, Some(axis)) => {
            let (matrix, point_m) = (turn(&axis, angle_deg * f64::from(k)), repeat.point_m());
            Some(Motion { matrix, shift_m: point_m - matrix * point_m })
        }
        _ => None,
    };
    (0..count).map(motion).collect()
}

/// Rodrigues' formula: right-handed about a unit vector.
fn turn(axis: &Vector3<f64>, angle_deg: f64) -> Matrix3<f64> {
    let (sin, cos) = sincos_deg(angle_deg);
    Matrix3::identity() * cos + axis.cross_matrix() * sin + axis * axis.transpose() * (1.0 - cos)
}
