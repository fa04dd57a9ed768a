//! Shapes in a spacecraft file, as people write them: boxes, cylinders, discs and dishes, which stand for plates.

use std::collections::BTreeMap;

use super::copies::{MirrorPlane, RepeatDescription};
use super::facets::{BoxFace, CylinderEnd};
use super::thermal_table::ThermalDescription;
use crate::toml::{Corners, Point, Positive, Rings, TurnEither, UnitVector, tables};

tables! {
/// A box: six rectangles, fronts outside, called `name.+X` to `name.-Z`.
struct BoxDescription called "box" {
    /// Name that those of its faces begin with; numbered unless given.
    name: Option<String>,
    /// Centre, in m.
    center_m as center_body_m: Point,
    /// Lengths along its own X, Y and Z axis, in m.
    size_m: [Positive; 3],
    /// Turns of the box about the body's X, then Y, then Z direction through its centre, in deg; its axes are the body's
    /// unless given.
    rotation_deg as rotation_rad: Option<[TurnEither; 3]>,
    /// Material of the outside.
    optics: String,
    /// Materials of single faces instead: `+X`, `-X`, `+Y`, `-Y`, `+Z`, `-Z`.
    face_optics: Option<BTreeMap<String, String>>,
    /// Material of the inside, if light can reach it.
    rear_optics: Option<String>,
    /// Faces that it lacks.
    open_faces: Option<Vec<BoxFace>>,
    /// Heat of each face; heat from inside is that of the whole box, shared among its faces by area.
    thermal: Option<ThermalDescription>,
    /// Mirrored copies besides: in the plane x = 0, y = 0 or z = 0 of the body frame, one after the other.
    mirror: Option<Vec<MirrorPlane>>,
    repeat: Option<RepeatDescription>,
}

/// A cylinder of flat facets, fronts outside, called `name.side[1]` and so on, and two ends, `name.+axis` and `name.-axis`.
///
/// Areas of side and ends are those of the cylinder, and so is the area that the side shows broadside, on average over the
/// directions around the axis; from one direction it is off by at most 1 - x / tan x with x = pi / facets: 5.2 % with 8
/// facets, 1.3 % with 16, 0.32 % with 32. For that it is shorter by half of this part. The first facet faces along the body axis that is most
/// across the cylinder's, made perpendicular; the others follow right-handed about the axis.
struct FacetedCylinderDescription called "cylinder" {
    /// Name that those of its facets begin with; numbered unless given.
    name: Option<String>,
    /// Middle of its axis, in m.
    center_m as center_body_m: Point,
    /// Unit vector of its axis.
    axis as axis_body: UnitVector = [0.0, 0.0, 1.0],
    /// Radius, in m.
    radius_m: Positive,
    /// Length along the axis, in m.
    height_m: Positive,
    /// How many flat facets the side has.
    facets: Corners = 16,
    /// Material of the outside.
    optics: String,
    /// Material of both ends, outside; that of the side unless given.
    end_optics: Option<String>,
    /// Material of the inside, if light can reach it.
    rear_optics: Option<String>,
    /// Ends that it lacks.
    open_ends: Option<Vec<CylinderEnd>>,
    /// Heat of each facet; heat from inside is that of the whole cylinder, shared among facets and ends by area.
    thermal: Option<ThermalDescription>,
    /// Mirrored copies besides: in the plane x = 0, y = 0 or z = 0 of the body frame, one after the other.
    mirror: Option<Vec<MirrorPlane>>,
    repeat: Option<RepeatDescription>,
}

/// A round disc: one plate with a regular outline of the disc's area.
struct DiscDescription called "disc" {
    /// Name of the plate; numbered unless given.
    name: Option<String>,
    /// Centre, in m.
    center_m as center_body_m: Point,
    /// Unit vector out of the front face.
    normal as normal_body: UnitVector,
    /// Radius, in m.
    radius_m: Positive,
    /// How many corners its outline has.
    corners: Corners = 24,
    /// Material of the front face.
    optics: String,
    /// Material of the rear face, if light can reach it.
    rear_optics: Option<String>,
    thermal: Option<ThermalDescription>,
    /// Mirrored copies besides: in the plane x = 0, y = 0 or z = 0 of the body frame, one after the other.
    mirror: Option<Vec<MirrorPlane>>,
    repeat: Option<RepeatDescription>,
}

/// A dish, a paraboloid of flat facets in rings, fronts inside the hollow, called `name.ring[1][1]` and so on from the vertex
/// outwards.
///
/// The area of every ring and the area that it shows along the axis are those of the paraboloid. For that the rim lies
/// deeper than `depth_m`, by up to 15 % with 2 rings, 7.6 % with 3, 4.8 % with 4, and its corners lie outside of `radius_m`
/// by (pi / facets)^2 / 3: 2.3 % with 12 facets. The first facet of a ring faces along the body axis that is most across the
/// dish's, made perpendicular; the others follow right-handed about the axis.
struct DishDescription called "dish" {
    /// Name that those of its facets begin with; numbered unless given.
    name: Option<String>,
    /// Its deepest point, in m.
    vertex_m as vertex_body_m: Point,
    /// Unit vector of its axis, from the vertex out of the hollow.
    axis as axis_body: UnitVector,
    /// Radius of the rim, in m.
    radius_m: Positive,
    /// From the vertex to the plane of the rim, in m.
    depth_m: Positive,
    /// How many facets each ring has.
    facets: Corners = 12,
    /// How many rings.
    rings: Rings = 3,
    /// Material of the hollow side.
    optics: String,
    /// Material of the back, if light can reach it.
    rear_optics: Option<String>,
    /// Heat of each facet; heat from inside is that of the whole dish, shared among its facets by area.
    thermal: Option<ThermalDescription>,
    /// Mirrored copies besides: in the plane x = 0, y = 0 or z = 0 of the body frame, one after the other.
    mirror: Option<Vec<MirrorPlane>>,
    repeat: Option<RepeatDescription>,
}
}
