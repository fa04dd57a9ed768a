//! Plates and the sunshade: their tables in the file, and the reading of them.

use super::copies::{MirrorPlane, RepeatDescription, check_apart, motions, plate_copies};
use super::materials::ChosenMaterial;
use super::outline::{checked_area, checked_center, checked_normal, checked_outline};
use super::part_reader::PartReader;
use super::surface::{Cylinder, Plate, Sunshade, SunshadeModel};
use super::thermal_table::{ThermalDescription, thermal};
use crate::toml::{
    List, Named, NonEmpty, Point, Positive, SubtendedAngle, TurnEither, UnitVector, Written, tables,
};

tables! {
/// A flat surface.
struct PlateDescription called "plate" {
    /// Name for messages and pictures; numbered unless given.
    name: Option<String>,
    /// Area, in m2; may be left out where a polygon is given.
    area_m2: Option<Positive>,
    /// Centre of area, in m; may be left out where a polygon is given.
    center_m: Option<Point>,
    /// Unit vector out of the front face; lengths off by at most 1e-3 are renormalised. Where a polygon is given it may be
    /// left out: the vertices then run counter-clockwise seen from the front.
    normal: Option<UnitVector>,
    /// Outline, in m, for self-shadowing: at least 3 vertices in one plane, edges that do not cross. Vertices off the plane by
    /// rounding, up to 1 mm and 0.5 % of the size, are moved onto it. Only surfaces with an outline shadow others and are
    /// shadowed.
    polygon_m: Option<List<Point, 3>>,
    /// Material of the front face.
    optics: String,
    /// Material of the rear face, if light can reach it.
    rear_optics: Option<String>,
    thermal: Option<ThermalDescription>,
    /// Mirrored copies besides: in the plane x = 0, y = 0 or z = 0 of the frame, one after the other.
    mirror: Option<Vec<MirrorPlane>>,
    repeat: Option<RepeatDescription>,
}

/// A sunshade in its own frame: given as plates, as section of a cylinder, or both.
struct SunshadeDescription {
    /// Description that is used.
    model: SunshadeModel,
    /// Misalignment: turns of the shade about the body's X, then Y, then Z axis, in deg.
    rotation_deg as rotation_rad: Option<[TurnEither; 3]>,
    /// Misalignment as matrix, row by row: components in the shade frame to components in the body frame.
    dcm_body_from_shade: Option<[[f64; 3]; 3]>,
    /// Plates in the shade frame.
    plates: Option<NonEmpty<PlateDescription>>,
    cylinder: Option<CylinderDescription>,
} rules {
    Excludes dcm_body_from_shade => rotation_deg: "both `rotation_deg` and `dcm_body_from_shade`", "one of them";
}

/// Part of a cylinder's outside: axis along Z through the origin, symmetric about the XY plane and the -Y direction.
struct CylinderDescription {
    /// Radius, in m.
    radius_m: Positive,
    /// Total height, in m.
    height_m: Positive,
    /// Total angle subtended at the axis, in deg; up to 360.
    subtended_angle_deg as subtended_angle_rad: SubtendedAngle,
    /// Material of the outside.
    optics: String,
}
}

/// A plate with its copies.
pub(super) fn plates(part: &PartReader<'_>, description: &PlateDescription) -> Vec<Plate> {
    let plate = plate(part, description);
    let (mirror, repeat) = (description.mirror.as_deref(), description.repeat.as_ref());
    let motions = motions(part, mirror, repeat);
    let plates = plate_copies(&plate, &motions);
    check_apart(part, &plates, motions.len());
    plates
}

fn plate(part: &PartReader<'_>, description: &PlateDescription) -> Plate {
    let front = part.material("optics", &description.optics);
    let rear = part.rear(description.rear_optics.as_deref());
    let normal = description.normal.value();
    let outline = checked_outline(part, description.polygon_m.as_deref(), normal.as_ref());
    Plate {
        name: description.called(part.index),
        area_m2: checked_area(part, description.area_m2, outline.as_ref()),
        center_m: checked_center(part, description.center_m, outline.as_ref()),
        normal: checked_normal(part, normal, outline.as_ref()),
        faces: ChosenMaterial::faces(front, rear, thermal(part, description.thermal.as_ref(), front, rear)),
        polygon: outline,
    }
}

/// Reads the sunshade.
pub(super) fn sunshade(part: &PartReader<'_>, description: &SunshadeDescription) -> Sunshade {
    let sunshade = Sunshade {
        model: description.model,
        dcm_body_from_shade: part
            .key("dcm_body_from_shade")
            .rotation(description.rotation_rad(), description.dcm_body_from_shade),
        plates: part.list("plates", description.plates.as_deref(), plates).concat(),
        cylinder: part.optional("cylinder", description.cylinder.as_ref(), cylinder),
    };
    if !sunshade.has(description.model) {
        let (found, allowed) = match description.model {
            SunshadeModel::Plates => ("`plates` without plates", "[[sunshade.plates]] or \"cylinder\""),
            SunshadeModel::Cylinder => ("`cylinder` without a cylinder", "[sunshade.cylinder] or \"plates\""),
        };
        part.key("model").report_across(found, allowed);
    }
    sunshade
}

fn cylinder(part: &PartReader<'_>, description: &CylinderDescription) -> Cylinder {
    let ChosenMaterial { place, material } = part.material("optics", &description.optics);
    Cylinder {
        radius_m: description.radius_m.0,
        height_m: description.height_m.0,
        half_angle_rad: description.subtended_angle_rad() / 2.0,
        optics: material.optics,
        gas_surface: material.gas_surface,
        thermal: material.thermal,
        material: place,
    }
}
