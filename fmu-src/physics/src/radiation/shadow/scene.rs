//! All outlines together: who can shadow whom, and what is lit.

use nalgebra::{Vector2, Vector3};

use super::clip::{Pieces, cross, drop_flat_corners, flat_m2, keep_positive};
use super::convex::FlatParts;
use super::disc::{DIRECTIONS, LitMean, SunDisc};
use crate::numerics::scalar::{Scalar, constant_vector, scratch, sin_cos};
use crate::spacecraft::Polygon;

/// Distance from a plane, relative to the scene's size, below which an outline lies in the plane and casts no shadow on it.
const IN_PLANE: f64 = 1e-9;

/// A surface that shadows and is shadowed.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Outline in the body frame, at angle 0 if it turns.
    pub polygon: Polygon,
    /// Axis that the surface turns about; `None` if it is fixed.
    pub hinge: Option<Hinge>,
    /// Whether light on its rear counts. The outline casts its shadow either way.
    pub two_sided: bool,
}

/// The axis of a panel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hinge {
    /// Index of the panel, from 0, whose angle applies.
    pub panel: usize,
    /// A point on the axis, body frame, in m.
    pub point_body_m: Vector3<f64>,
    /// Unit vector of the axis, body frame.
    pub axis_body: Vector3<f64>,
}

/// Outlines prepared for any direction of the Sun and any angles.
#[derive(Clone, Debug, PartialEq)]
pub struct ShadowScene {
    surfaces: Vec<ShadowSurface>,
    /// For every surface those that can stand before its front, and before its rear.
    before: Vec<[Vec<usize>; 2]>,
    /// Radius of the sphere about the body frame's origin that contains all outlines, in m.
    size_m: f64,
}

#[derive(Clone, Debug, PartialEq)]
struct ShadowSurface {
    outline: Outline,
    flat: FlatParts,
    area_m2: f64,
    /// Radius of the sphere about the outline's centre that contains the outline, in m.
    radius_m: f64,
}

/// Position and axes of a surface at the panels' present angles.
#[derive(Clone, Copy, Debug)]
struct Pose<T: Scalar> {
    origin: Vector3<T>,
    east: Vector3<T>,
    north: Vector3<T>,
    normal: Vector3<T>,
}

scratch! {
/// Scratch space of [`ShadowScene::evaluate`] and its results; grows when needed and is kept.
pub struct ShadowWorkspace<T: Scalar> {
    poses: Vec<Pose<T>>,
    lit: Vec<Option<(T, Vector3<T>)>>,
    pieces: [Pieces<T>; 2],
    scratch: [Vec<Vector2<T>>; 2],
    space: [Vec<(Vector3<T>, T)>; 2],
    hole: Vec<Vector2<T>>,
    means: Vec<LitMean<T>>,
    pairs: usize,
}
}

impl<T: Scalar> ShadowWorkspace<T> {
    /// Lit area in m2 and its centre (body frame, m) of the side that looks at the Sun, as of the last evaluation;
    /// `None` where nothing shadows the outline or there is no such outline.
    pub fn lit(&self, outline: usize) -> Option<(T, Vector3<T>)> {
        self.lit.get(outline).copied().flatten()
    }

    /// How many pairs of outlines survived the culling in the last evaluation and were clipped.
    pub fn clipped_pairs(&self) -> usize {
        self.pairs
    }
}

impl ShadowScene {
    /// Prepares outlines: convex parts, and who can ever shadow whom.
    pub fn new(outlines: Vec<Outline>) -> Self {
        let surfaces = outlines.into_iter().map(|outline| {
            let flat = FlatParts::new(&outline.polygon);
            let away = |v: &Vector3<f64>| (v - flat.origin).norm();
            let radius_m = outline.polygon.vertices_m().iter().map(away).fold(0.0, f64::max);
            ShadowSurface { area_m2: outline.polygon.area_m2(), radius_m, flat, outline }
        });
        let surfaces: Vec<ShadowSurface> = surfaces.collect();
        let size_m = surfaces.iter().map(|s| s.flat.origin.norm() + s.radius_m).fold(0.0, f64::max);
        let before = surfaces.iter().map(|surface| {
            let candidates = |sign: f64| {
                let can = |other: &ShadowSurface| surface.highest(other, sign) > IN_PLANE * size_m;
                (0..surfaces.len())
                    .filter(|&j| !core::ptr::eq(&surfaces[j], surface) && can(&surfaces[j]))
                    .filter(|&j| !surfaces[..j].iter().any(|known| known.covers(&surfaces[j], size_m)))
                    .collect()
            };
            [candidates(1.0), if surface.outline.two_sided { candidates(-1.0) } else { Vec::new() }]
        });
        Self { before: before.collect(), surfaces, size_m }
    }

    /// Ordered pairs in which the second surface can shadow a side of the first.
    pub fn candidate_pairs(&self) -> usize {
        self.before.iter().flatten().map(Vec::len).sum()
    }

    /// Finds what the Sun lights of every outline's sunward side.
    ///
    /// `sun_body` is the unit vector toward the Sun; angles beyond those given count as 0.
    pub fn evaluate<T: Scalar>(
        &self,
        sun_body: &Vector3<T>,
        panel_angles_rad: &[T],
        workspace: &mut ShadowWorkspace<T>,
    ) {
        self.pose(panel_angles_rad, workspace);
        self.light(sun_body, workspace);
    }

    /// As [`ShadowScene::evaluate`], the Sun a disc: means over it, of the side that looks at its centre.
    pub fn evaluate_disc<T: Scalar>(
        &self,
        disc: &SunDisc<T>,
        panel_angles_rad: &[T],
        workspace: &mut ShadowWorkspace<T>,
    ) {
        self.pose(panel_angles_rad, workspace);
        workspace.means.clear();
        workspace.means.resize(self.surfaces.len(), LitMean::new());
        let (center, _) = disc.direction(0);
        for (sun_body, weight) in (0..DIRECTIONS).map(|number| disc.direction(number)) {
            self.light(&sun_body, workspace);
            let ShadowWorkspace { poses, lit, means, .. } = workspace;
            for (index, (mean, lit)) in means.iter_mut().zip(lit).enumerate() {
                let pose = &poses[index];
                let side = pose.normal.dot(&center).value().signum();
                let cos = pose.normal.dot(&sun_body) * side;
                if cos.value() > 0.0 {
                    let whole = (T::constant(self.surfaces[index].area_m2), pose.origin);
                    mean.add(cos * weight, lit.unwrap_or(whole), lit.is_some());
                }
            }
        }
        let ShadowWorkspace { poses, lit, means, .. } = workspace;
        lit.clear();
        lit.extend(means.iter().zip(poses).map(|(mean, pose)| mean.found(&pose.origin)));
    }

    fn pose<T: Scalar>(&self, panel_angles_rad: &[T], workspace: &mut ShadowWorkspace<T>) {
        workspace.pairs = 0;
        workspace.poses.clear();
        workspace.poses.extend(self.surfaces.iter().map(|surface| surface.pose(panel_angles_rad)));
    }

    /// Computes the areas lit from one direction; the surfaces' poses are up to date.
    fn light<T: Scalar>(&self, sun_body: &Vector3<T>, workspace: &mut ShadowWorkspace<T>) {
        workspace.lit.clear();
        workspace.lit.resize(self.surfaces.len(), None);
        let sun = sun_body.map(T::value);
        for (index, surface) in self.surfaces.iter().enumerate() {
            let cos = workspace.poses[index].normal.map(T::value).dot(&sun);
            if cos == 0.0 {
                continue;
            }
            let mut touched = false;
            let center = workspace.poses[index].origin.map(T::value);
            for &other in &self.before[index][usize::from(cos < 0.0)] {
                let away = workspace.poses[other].origin.map(T::value) - center;
                let reach = surface.radius_m + self.surfaces[other].radius_m;
                let along = away.dot(&sun);
                if along < -reach || away.norm_squared() - along * along > reach * reach {
                    continue;
                }
                if !touched {
                    touched = true;
                    let [pieces, _] = &mut workspace.pieces;
                    pieces.clear(surface.radius_m);
                    for part in &surface.flat.parts {
                        pieces.push(part.iter().map(|p| p.map(T::constant)));
                    }
                }
                workspace.pairs += 1;
                self.cut(index, other, sun_body, cos.signum(), workspace);
                if workspace.pieces[0].is_empty() {
                    break;
                }
            }
            if touched {
                workspace.lit[index] = Some(surface.summed(index, workspace));
            }
        }
    }

    /// Cuts the shadow of `other` out of the lit pieces of `index`.
    fn cut<T: Scalar>(
        &self,
        index: usize,
        other: usize,
        sun: &Vector3<T>,
        side: f64,
        workspace: &mut ShadowWorkspace<T>,
    ) {
        let ShadowWorkspace { poses, pieces, scratch, space, hole, .. } = workspace;
        let (pose, caster) = (&poses[index], &poses[other]);
        let height = |p: &Vector3<T>| (p - pose.origin).dot(&pose.normal) * side;
        let per_cos = (sun.dot(&pose.normal) * side).recip();
        let at_height_0 = |from: &(Vector3<T>, T), to: &(Vector3<T>, T), share: T| {
            (from.0 + (to.0 - from.0) * share, T::constant(0.0))
        };
        for part in &self.surfaces[other].flat.parts {
            let [whole, above] = &mut *space;
            whole.clear();
            whole.extend(part.iter().map(|p| {
                let point = caster.origin + caster.east * T::constant(p.x) + caster.north * T::constant(p.y);
                (point, height(&point))
            }));
            above.clear();
            keep_positive(whole, |corner| corner.1, at_height_0, above);
            if above.len() < 3 {
                continue;
            }
            hole.clear();
            hole.extend(above.iter().map(|(point, height)| {
                let foot = point - sun * (*height * per_cos) - pose.origin;
                Vector2::new(foot.dot(&pose.east), foot.dot(&pose.north))
            }));
            let triangle = |pair: &[Vector2<T>]| cross(&(pair[0] - hole[0]), &(pair[1] - hole[0])).value();
            let doubled_area: f64 = hole.windows(2).skip(1).map(triangle).sum();
            if doubled_area == 0.0 {
                continue;
            }
            if doubled_area < 0.0 {
                hole.reverse();
            }
            let size_m = hole.iter().map(|p| p.map(T::value).amax()).fold(self.size_m, f64::max);
            drop_flat_corners(hole, 0, flat_m2(size_m));
            if hole.is_empty() {
                continue;
            }
            let [lit, left] = pieces;
            lit.subtract_into(hole, scratch, left);
            core::mem::swap(lit, left);
        }
    }
}

impl ShadowSurface {
    fn pose<T: Scalar>(&self, panel_angles_rad: &[T]) -> Pose<T> {
        let flat = &self.flat;
        let fixed = [flat.origin, flat.east, flat.north, flat.normal].map(|v| constant_vector::<T>(&v));
        let [origin, east, north, normal] = fixed;
        let with_angle = |hinge: Hinge| panel_angles_rad.get(hinge.panel).map(|angle| (hinge, angle));
        let turned = self.outline.hinge.and_then(with_angle);
        let Some((hinge, angle_rad)) = turned else { return Pose { origin, east, north, normal } };
        let (sin, cos) = sin_cos(*angle_rad);
        let axis = constant_vector::<T>(&hinge.axis_body);
        // Rodrigues' formula.
        let turn = |v: Vector3<T>| v * cos + axis.cross(&v) * sin + axis * (axis.dot(&v) * (-cos + 1.0));
        let point = constant_vector::<T>(&hinge.point_body_m);
        Pose {
            origin: turn(origin - point) + point,
            east: turn(east),
            north: turn(north),
            normal: turn(normal),
        }
    }

    /// Lit area and centre from the pieces left; the whole surface's centre where nothing is left.
    fn summed<T: Scalar>(&self, index: usize, workspace: &ShadowWorkspace<T>) -> (T, Vector3<T>) {
        let pose = &workspace.poses[index];
        let (area, moments) = workspace.pieces[0].area_and_moments();
        if area.value() <= f64::EPSILON * self.area_m2 {
            return (T::constant(0.0), pose.origin);
        }
        (area, pose.origin + pose.east * (moments.x / area) + pose.north * (moments.y / area))
    }

    /// How far `other` rises above this surface's plane at most, on the side of `sign`, over all angles.
    fn highest(&self, other: &Self, sign: f64) -> f64 {
        let points = other.flat.parts.iter().flat_map(|part| other.flat.in_space(part));
        let normal = &self.flat.normal;
        let height = |point: Vector3<f64>| match (&self.outline.hinge, &other.outline.hinge) {
            (Some(a), Some(b)) if a.panel != b.panel => f64::INFINITY,
            // The point circles about its axis; where the plane turns instead, seen from the plane.
            (None, Some(hinge)) | (Some(hinge), None) => {
                let (axis, arm) = (&hinge.axis_body, point - hinge.point_body_m);
                let along = axis.dot(&arm);
                let fixed = axis.dot(normal) * along - normal.dot(&(self.flat.origin - hinge.point_body_m));
                sign * fixed + (arm - axis * along).norm() * (normal - axis * axis.dot(normal)).norm()
            }
            _ => sign * normal.dot(&(point - self.flat.origin)),
        };
        points.map(height).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Whether `other` is the same outline again, as the back of a plate that is given as a plate of its own.
    fn covers(&self, other: &Self, size_m: f64) -> bool {
        let near = |a: &Vector3<f64>, b: &Vector3<f64>| (a - b).norm() <= IN_PLANE * size_m;
        let points = |s: &Self| -> Vec<Vector3<f64>> {
            s.flat.parts.iter().flat_map(|part| s.flat.in_space(part)).collect()
        };
        let (mine, theirs) = (points(self), points(other));
        self.outline.hinge == other.outline.hinge
            && mine.len() == theirs.len()
            && self.flat.parts.len() == 1
            && other.flat.parts.len() == 1
            && mine.iter().all(|a| theirs.iter().any(|b| near(a, b)))
    }
}
