//! Boxes, cylinders, discs and dishes: their tables in the file, and the plates with outlines that they stand for.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Vector3};

use super::copies::{MOST_PLATES, MirrorPlane, RepeatDescription, check_apart, copy_name, motions};
use super::facets::{BoxFace, CylinderEnd, Facet, box_faces, cylinder_facets, disc, dish_facets};
use super::materials::ChosenMaterial;
use super::part_reader::PartReader;
use super::polygon::Polygon;
use super::surface::Plate;
use super::thermal::Thermal;
use super::thermal_table::{ThermalDescription, thermal};
use crate::enumeration::Enumerated;
use crate::refusal::Refusal;
use crate::toml::{
    Corners, Named, Place, Point, Positive, Rings, TurnEither, UnitVector, Written, hint, tables,
};

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

/// Data common to all shapes.
struct Shape<'s> {
    name: String,
    /// From the shape's own axes to the body frame: turn, then shift.
    turn: Matrix3<f64>,
    shift_m: Vector3<f64>,
    facets: Vec<Facet>,
    rear: Option<ChosenMaterial>,
    thermal: Thermal,
    mirror: Option<&'s [MirrorPlane]>,
    repeat: Option<&'s RepeatDescription>,
}

/// The shape of a table whose outside is of the material `front`.
macro_rules! shape {
    ($part:ident, $described:ident, $front:ident, [$turn:expr, $shift_m:expr], $facets:expr) => {{
        let rear = $part.rear($described.rear_optics.as_deref());
        Shape {
            name: $described.called($part.index),
            turn: $turn,
            shift_m: $shift_m,
            facets: $facets,
            rear,
            thermal: thermal($part, $described.thermal.as_ref(), $front, rear),
            mirror: $described.mirror.as_deref(),
            repeat: $described.repeat.as_ref(),
        }
    }};
}

/// The plates of a box.
pub(super) fn box_plates(part: &PartReader<'_>, description: &BoxDescription) -> Vec<Plate> {
    let front = part.material("optics", &description.optics);
    let mut own = Vec::new();
    let open = description.open_faces.as_deref().unwrap_or_default();
    for (face, name) in description.face_optics.iter().flatten() {
        let optics = part.table("face_optics");
        let material = optics.material(face, name);
        match BoxFace::ITEMS.iter().find(|it| it.name == face) {
            None => {
                let names: Vec<&str> = BoxFace::ITEMS.iter().map(|it| it.name).collect();
                let found = format!("the unknown face `{face}`{}", hint(face, &names));
                optics.key(face).report(found, names.join(", "));
            }
            Some(it) if open.contains(&it.variant) => {
                optics.key(face).report("a face that is open too", "a face that the box has");
            }
            Some(_) => own.push((face.clone(), material)),
        }
    }
    let facets = box_faces(&Vector3::from(description.size_m.value()), open);
    let turn = part.rotation(description.rotation_rad(), None);
    let shape = shape!(part, description, front, [turn, description.center_body_m()], facets);
    let material = |face: &str| own.iter().find(|(name, _)| name == face).map_or(front, |(_, own)| *own);
    shape.plates(part, "faces", &material)
}

/// The plates of a cylinder.
pub(super) fn cylinder_plates(part: &PartReader<'_>, description: &FacetedCylinderDescription) -> Vec<Plate> {
    let front = part.material("optics", &description.optics);
    let end = description.end_optics.as_ref();
    let end = end.map_or(front, |name| part.material("end_optics", name));
    let (radius_m, height_m) = (description.radius_m.0, description.height_m.0);
    let open = description.open_ends.as_deref().unwrap_or_default();
    let facets = cylinder_facets(radius_m, height_m, description.facets(), open);
    let turn = frame(&description.axis_body());
    let shape = shape!(part, description, front, [turn, description.center_body_m()], facets);
    let material = |facet: &str| if facet.starts_with("side") { front } else { end };
    shape.plates(part, "facets", &material)
}

/// The plate of a disc.
pub(super) fn disc_plates(part: &PartReader<'_>, description: &DiscDescription) -> Vec<Plate> {
    let front = part.material("optics", &description.optics);
    let facets = disc(description.radius_m.0, description.corners());
    let turn = frame(&description.normal_body());
    let shape = shape!(part, description, front, [turn, description.center_body_m()], facets);
    shape.plates(part, "discs", &|_| front)
}

/// The plates of a dish.
pub(super) fn dish_plates(part: &PartReader<'_>, description: &DishDescription) -> Vec<Plate> {
    let front = part.material("optics", &description.optics);
    let (radius_m, depth_m) = (description.radius_m.0, description.depth_m.0);
    let facets = dish_facets(radius_m, depth_m, description.facets(), description.rings());
    let turn = frame(&description.axis_body());
    let shape = shape!(part, description, front, [turn, description.vertex_body_m()], facets);
    shape.plates(part, "facets", &|_| front)
}

/// Two plates of one name, made by different items of the file, could not be distinguished.
pub(super) fn distinct_plates(found: &[(Place<'_>, Vec<Plate>)]) {
    let mut known: BTreeMap<&str, &Place<'_>> = BTreeMap::new();
    for (at, plates) in found {
        for plate in plates {
            let other = *known.entry(&plate.name).or_insert(at);
            if other.path() != at.path() && !at.key("name").has_reported() {
                let found = format!("a plate `{}`, as {other} has", plate.name);
                at.key("name").report(found, "a name whose plates have names of their own");
            }
        }
    }
}

impl Shape<'_> {
    /// Its plates and those of its copies; none where something was reported.
    fn plates(
        &self,
        part: &PartReader<'_>,
        kind: &str,
        material: &dyn Fn(&str) -> ChosenMaterial,
    ) -> Vec<Plate> {
        let motions = motions(part, self.mirror, self.repeat);
        if part.has_reported() || part.has_stand_in() {
            return Vec::new();
        }
        let count = motions.len() * self.facets.len();
        if count == 0 || count > MOST_PLATES {
            part.report(format_args!("{count} {kind}"), format_args!("1 to {MOST_PLATES}"));
            return Vec::new();
        }
        let mut plates = Vec::with_capacity(count);
        for (index, motion) in motions.iter().enumerate() {
            let name = copy_name(&self.name, index, motions.len());
            for facet in &self.facets {
                let in_body = facet.vertices_m.iter().map(|v| self.turn * v + self.shift_m).collect();
                let report = |error: Refusal| {
                    let found = format!("lengths that make no outline of `{}` ({error})", facet.name);
                    part.report(found, "lengths within a factor of 1e8 of one another");
                };
                let Ok(outline) = Polygon::new(in_body).map_err(report) else { return Vec::new() };
                let outline = motion.moved_outline(&outline);
                plates.push(self.plate(&name, facet, outline, material(&facet.name)));
            }
            self.divide_heat(&mut plates[index * self.facets.len()..]);
        }
        check_apart(part, &plates, motions.len());
        plates
    }

    fn plate(&self, name: &str, facet: &Facet, outline: Polygon, front: ChosenMaterial) -> Plate {
        let mut thermal = self.thermal;
        thermal.front = front.material.thermal;
        let dot = if facet.name.is_empty() { "" } else { "." };
        let faces = ChosenMaterial::faces(front, self.rear, thermal);
        let name = format!("{name}{dot}{}", facet.name);
        Plate { faces, ..Plate::outlined(name, outline, faces.optics, faces.rear_optics) }
    }

    /// Divides the heat from inside among all plates by area.
    fn divide_heat(&self, plates: &mut [Plate]) {
        let whole_m2: f64 = plates.iter().map(|plate| plate.area_m2).sum();
        for plate in plates {
            let fraction = plate.area_m2 / whole_m2;
            plate.faces.thermal.internal_heat_w =
                self.thermal.internal_heat_w.map(|heat_w| heat_w * fraction);
        }
    }
}

/// Axes with Z along a direction, as columns: X is the body axis that is most across it, made perpendicular.
pub(crate) fn frame(z: &Vector3<f64>) -> Matrix3<f64> {
    let mut across = Vector3::zeros();
    across[z.iamin()] = 1.0;
    let x = (across - z * z.dot(&across)).normalize();
    Matrix3::from_columns(&[x, z.cross(&x), *z])
}
