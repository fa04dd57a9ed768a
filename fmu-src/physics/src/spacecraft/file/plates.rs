//! Plates, sunshade and panels, from their descriptions.

use super::copies::{check_apart, motions, plate_copies};
use super::describe_surfaces::{
    CylinderDescription, PanelDescription, PlateDescription, SunshadeDescription,
};
use super::description::SpacecraftDescription;
use super::mass::panel_mass;
use super::materials::ChosenMaterial;
use super::outline::{checked_area, checked_center, checked_normal, checked_outline};
use super::part_reader::PartReader;
use super::shapes::{box_plates, cylinder_plates, disc_plates, dish_plates, distinct_plates};
use super::thermal::thermal;
use crate::spacecraft::panel::Panel;
use crate::spacecraft::surface::{Cylinder, MOST_SURFACES, Plate, Sunshade, SunshadeModel};
use crate::toml::{KeyPath, Named, Table, UnitVector, Written};

/// The plates that the file lists, then those of its shapes; none beyond the most that a spacecraft may have.
pub(crate) fn body_plates(file: &mut PartReader<'_, '_>, description: &SpacecraftDescription) -> Vec<Plate> {
    let mut found = Vec::new();
    let SpacecraftDescription { plates: listed, boxes, cylinders, discs, dishes, .. } = description;
    shaped(file, &mut found, ("plates", listed.as_deref()), plates);
    shaped(file, &mut found, ("boxes", boxes.as_deref()), box_plates);
    shaped(file, &mut found, ("cylinders", cylinders.as_deref()), cylinder_plates);
    shaped(file, &mut found, ("discs", discs.as_deref()), disc_plates);
    shaped(file, &mut found, ("dishes", dishes.as_deref()), dish_plates);
    if surfaces(&found) > MOST_SURFACES {
        let found = "more surfaces, copies and facets of shapes among them";
        file.check.push(&file.at, found, format_args!("at most {MOST_SURFACES}"));
    }
    distinct_plates(file.check, &found);
    found.into_iter().flat_map(|(_, plates)| plates).collect()
}

/// Key path and plates of every item.
type Found = Vec<(KeyPath, Vec<Plate>)>;

fn surfaces(found: &Found) -> usize {
    found.iter().map(|(_, plates)| plates.len()).sum()
}

/// Adds the plates of every item under a key.
fn shaped<D: Table>(
    file: &mut PartReader<'_, '_>,
    found: &mut Found,
    (key, items): (&str, Option<&[D]>),
    plates: impl Fn(&mut PartReader<'_, '_>, &D) -> Vec<Plate>,
) {
    let mut count = surfaces(found);
    file.list(key, items, |part, item| {
        if count <= MOST_SURFACES {
            let made = plates(part, item);
            count += made.len();
            found.push((part.at.clone(), made));
        }
    });
}

/// A plate with its copies.
fn plates(part: &mut PartReader<'_, '_>, description: &PlateDescription) -> Vec<Plate> {
    let plate = plate(part, description);
    let (mirror, repeat) = (description.mirror.as_deref(), description.repeat.as_ref());
    let motions = motions(part, mirror, repeat);
    let plates = plate_copies(&plate, &motions);
    check_apart(part, &plates, motions.len());
    plates
}

fn plate(part: &mut PartReader<'_, '_>, description: &PlateDescription) -> Plate {
    let front = part.material("optics", &description.optics);
    let rear = part.rear(description.rear_optics.as_deref());
    let normal = description.normal.map(UnitVector::value);
    let outline = checked_outline(part, description.polygon_m.as_deref(), normal.as_ref());
    Plate {
        name: description.called(part.index),
        area_m2: checked_area(part, description.area_m2, outline.as_ref()),
        center_m: checked_center(part, description.center_m, outline.as_ref()),
        normal: checked_normal(part, normal, outline.as_ref()),
        optics: front.material.optics,
        rear_optics: rear.map(|rear| rear.material.optics),
        gas_surface: ChosenMaterial::in_air(front, rear),
        materials: ChosenMaterial::places(front, rear),
        thermal: thermal(part, description.thermal.as_ref(), front, rear),
        polygon: outline,
    }
}

pub(crate) fn sunshade(part: &mut PartReader<'_, '_>, description: &SunshadeDescription) -> Sunshade {
    let sunshade = Sunshade {
        model: description.model,
        dcm_body_from_shade: part.check.rotation(
            &part.at.key("dcm_body_from_shade"),
            description.rotation_rad(),
            description.dcm_body_from_shade,
        ),
        plates: part.list("plates", description.plates.as_deref(), plates).concat(),
        cylinder: part.optional("cylinder", description.cylinder.as_ref(), cylinder),
    };
    if !sunshade.has(description.model) {
        let (found, allowed) = match description.model {
            SunshadeModel::Plates => ("`plates` without plates", "[[sunshade.plates]] or \"cylinder\""),
            SunshadeModel::Cylinder => ("`cylinder` without a cylinder", "[sunshade.cylinder] or \"plates\""),
        };
        part.report_across("model", found, allowed);
    }
    sunshade
}

fn cylinder(part: &mut PartReader<'_, '_>, description: &CylinderDescription) -> Cylinder {
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

pub(crate) fn panel(part: &mut PartReader<'_, '_>, description: &PanelDescription) -> Panel {
    let dcm_body_from_panel = part.check.rotation(
        &part.at.key("dcm_body_from_panel"),
        description.rotation_rad(),
        description.dcm_body_from_panel,
    );
    let axis = description.axis();
    let zero_normal = part.perpendicular("zero_normal", description.zero_normal(), ("axis", &axis));
    let tilt_sign = description.tilt_sign();
    if tilt_sign.abs() != 1 {
        part.report("tilt_sign", tilt_sign, "1 or -1");
    }
    if let Some(side) = description.windmill_side.filter(|side| !(-1..=1).contains(side)) {
        part.report("windmill_side", side, "1, -1 or 0");
    }
    let front = part.material("optics", &description.optics);
    let rear = part.rear(description.rear_optics.as_deref());
    let outline = checked_outline(part, description.polygon_m.as_deref(), Some(&zero_normal));
    let area_m2 = checked_area(part, description.area_m2, outline.as_ref());
    let center_m = checked_center(part, description.center_m, outline.as_ref());
    let mass = panel_mass(part, description, area_m2, center_m, &zero_normal);
    let windmill_side = match description.windmill_side {
        Some(side) => side as f64,
        None => side_of(center_m.dot(&axis)),
    };
    Panel {
        name: description.called(part.index),
        area_m2,
        center_body_m: dcm_body_from_panel * center_m,
        mass: mass.map(|mass| mass.turned(&dcm_body_from_panel)),
        axis_body: dcm_body_from_panel * axis,
        zero_normal_body: dcm_body_from_panel * zero_normal,
        optics: front.material.optics,
        rear_optics: rear.map(|rear| rear.material.optics),
        gas_surface: ChosenMaterial::in_air(front, rear),
        materials: ChosenMaterial::places(front, rear),
        thermal: thermal(part, description.thermal.as_ref(), front, rear),
        polygon: outline.as_ref().map(|polygon| polygon.moved(|v| dcm_body_from_panel * v)),
        control: description.control(),
        sun_offset_rad: description.sun_offset_rad(),
        tilt_sign: if tilt_sign < 0 { -1.0 } else { 1.0 },
        windmill_side,
        angle_rad: description.angle_rad(),
    }
}

/// Returns the side of the plane across the axis on which a panel's centre lies, by its distance along the axis in m: 1 or -1, or 0
/// within rounding of the plane.
fn side_of(along_axis_m: f64) -> f64 {
    const ROUNDING_M: f64 = 1e-9;
    if along_axis_m.abs() <= ROUNDING_M { 0.0 } else { along_axis_m.signum() }
}
