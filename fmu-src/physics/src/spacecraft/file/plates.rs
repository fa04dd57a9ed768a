//! Plates, sunshade and panels, from their descriptions.

use super::copies::{check_apart, motions, plate_copies};
use super::description::{
    CylinderDescription, Description, PanelDescription, PlateDescription, SunshadeDescription,
};
use super::mass::panel_mass;
use super::materials::{Material, Materials};
use super::names::{Named, list};
use super::outline::{checked_area, checked_center, checked_normal, checked_outline};
use super::shapes::{box_plates, cylinder_plates, disc_plates, dish_plates, distinct_plates};
use super::thermal::thermal;
use crate::spacecraft::panel::Panel;
use crate::spacecraft::surface::{Cylinder, MOST_SURFACES, Plate, Sunshade, SunshadeModel};
use crate::toml::{Checker, Place};

/// The plates that the file lists, then those of its shapes; none beyond the most that a spacecraft may have.
pub(crate) fn body_plates(
    check: &mut Checker<'_>,
    materials: &Materials,
    description: &Description,
) -> Vec<Plate> {
    let mut found = Vec::new();
    let Description { plates: listed, boxes, cylinders, discs, dishes, .. } = description;
    shaped(check, materials, &mut found, ("plates", listed.as_deref()), plates);
    shaped(check, materials, &mut found, ("boxes", boxes.as_deref()), box_plates);
    shaped(check, materials, &mut found, ("cylinders", cylinders.as_deref()), cylinder_plates);
    shaped(check, materials, &mut found, ("discs", discs.as_deref()), disc_plates);
    shaped(check, materials, &mut found, ("dishes", dishes.as_deref()), dish_plates);
    if surfaces(&found) > MOST_SURFACES {
        let found = "more surfaces, copies and facets of shapes among them";
        check.push(&Place::root(), found, format_args!("at most {MOST_SURFACES}"));
    }
    distinct_plates(check, &found);
    found.into_iter().flat_map(|(_, plates)| plates).collect()
}

/// Where items stand, with the plates of each.
type Found = Vec<(Place, Vec<Plate>)>;

fn surfaces(found: &Found) -> usize {
    found.iter().map(|(_, plates)| plates.len()).sum()
}

/// Adds the plates of every item under a key.
fn shaped<D>(
    check: &mut Checker<'_>,
    materials: &Materials,
    found: &mut Found,
    (key, items): (&str, Option<&[D]>),
    plates: impl Fn(&mut Checker<'_>, &Materials, &Place, usize, &D) -> Vec<Plate>,
) {
    let mut count = surfaces(found);
    list(check, &Place::root().key(key), items, |check, at, index, item| {
        if count <= MOST_SURFACES {
            let made = plates(check, materials, at, index, item);
            count += made.len();
            found.push((at.clone(), made));
        }
    });
}

/// A plate with its copies.
fn plates(
    check: &mut Checker<'_>,
    materials: &Materials,
    at: &Place,
    index: usize,
    description: &PlateDescription,
) -> Vec<Plate> {
    let plate = plate(check, materials, at, index, description);
    let (mirror, repeat) = (description.mirror.as_deref(), description.repeat.as_ref());
    let motions = motions(check, at, mirror, repeat);
    let plates = plate_copies(&plate, &motions);
    check_apart(check, at, &plates, motions.len());
    plates
}

fn plate(
    check: &mut Checker<'_>,
    materials: &Materials,
    at: &Place,
    index: usize,
    description: &PlateDescription,
) -> Plate {
    let front = materials.find(check, &at.key("optics"), &description.optics);
    let rear =
        description.rear_optics.as_ref().map(|name| materials.find(check, &at.key("rear_optics"), name));
    let normal = description.normal.map(|normal| check.unit_vector(&at.key("normal"), normal));
    let outline = checked_outline(check, at, description.polygon_m.as_deref(), normal.as_ref());
    Plate {
        name: description.called(index),
        area_m2: checked_area(check, at, description.area_m2, outline.as_ref()),
        center_m: checked_center(check, at, description.center_m, outline.as_ref()),
        normal: checked_normal(check, at, normal, outline.as_ref()),
        optics: front.optics,
        rear_optics: rear.map(|rear| rear.optics),
        gas_surface: Material::in_air(front, rear),
        thermal: thermal(check, materials.environment, at, description.thermal.as_ref(), front, rear),
        polygon: outline,
    }
}

pub(crate) fn sunshade(
    check: &mut Checker<'_>,
    materials: &Materials,
    at: &Place,
    description: &SunshadeDescription,
) -> Sunshade {
    let sunshade = Sunshade {
        model: description.model,
        dcm_body_from_shade: check.rotation(
            at,
            ("rotation_deg", description.rotation_deg),
            ("dcm_body_from_shade", description.dcm_body_from_shade),
        ),
        plates: list(check, &at.key("plates"), description.plates.as_deref(), |check, at, index, it| {
            plates(check, materials, at, index, it)
        })
        .concat(),
        cylinder: description.cylinder.as_ref().map(|c| cylinder(check, materials, &at.key("cylinder"), c)),
    };
    if !sunshade.has(description.model) {
        let (found, allowed) = match description.model {
            SunshadeModel::Plates => ("`plates` without plates", "[[sunshade.plates]] or \"cylinder\""),
            SunshadeModel::Cylinder => ("`cylinder` without a cylinder", "[sunshade.cylinder] or \"plates\""),
        };
        check.report_across(at, &at.key("model"), found, allowed);
    }
    sunshade
}

fn cylinder(
    check: &mut Checker<'_>,
    materials: &Materials,
    at: &Place,
    description: &CylinderDescription,
) -> Cylinder {
    let material = materials.find(check, &at.key("optics"), &description.optics);
    Cylinder {
        radius_m: description.radius_m.0,
        height_m: description.height_m.0,
        half_angle_rad: description.subtended_angle_deg.0.to_radians() / 2.0,
        optics: material.optics,
        gas_surface: material.gas_surface,
    }
}

pub(crate) fn panel(
    check: &mut Checker<'_>,
    materials: &Materials,
    at: &Place,
    index: usize,
    description: &PanelDescription,
) -> Panel {
    let dcm_body_from_panel = check.rotation(
        at,
        ("rotation_deg", description.rotation_deg),
        ("dcm_body_from_panel", description.dcm_body_from_panel),
    );
    let axis = check.unit_vector(&at.key("axis"), description.axis());
    let zero_normal = check.perpendicular(&at.key("zero_normal"), description.zero_normal(), &axis, "axis");
    let tilt_sign = description.tilt_sign();
    if tilt_sign.abs() != 1 {
        check.report(&at.key("tilt_sign"), tilt_sign, "1 or -1");
    }
    if let Some(side) = description.windmill_side.filter(|side| !(-1..=1).contains(side)) {
        check.report(&at.key("windmill_side"), side, "1, -1 or 0");
    }
    let front = materials.find(check, &at.key("optics"), &description.optics);
    let rear =
        description.rear_optics.as_ref().map(|name| materials.find(check, &at.key("rear_optics"), name));
    let outline = checked_outline(check, at, description.polygon_m.as_deref(), Some(&zero_normal));
    let area_m2 = checked_area(check, at, description.area_m2, outline.as_ref());
    let center_m = checked_center(check, at, description.center_m, outline.as_ref());
    let mass = panel_mass(check, at, description, area_m2, center_m, &zero_normal);
    let windmill_side = match description.windmill_side {
        Some(side) => side as f64,
        None => side_of(center_m.dot(&axis)),
    };
    Panel {
        name: description.called(index),
        area_m2,
        center_body_m: dcm_body_from_panel * center_m,
        mass: mass.map(|mass| mass.turned(&dcm_body_from_panel)),
        axis_body: dcm_body_from_panel * axis,
        zero_normal_body: dcm_body_from_panel * zero_normal,
        optics: front.optics,
        rear_optics: rear.map(|rear| rear.optics),
        gas_surface: Material::in_air(front, rear),
        thermal: thermal(check, materials.environment, at, description.thermal.as_ref(), front, rear),
        polygon: outline.as_ref().map(|polygon| polygon.moved(|v| dcm_body_from_panel * v)),
        control: description.control(),
        sun_offset_rad: description.sun_offset_deg().to_radians(),
        tilt_sign: if tilt_sign < 0 { -1.0 } else { 1.0 },
        windmill_side,
        angle_rad: description.angle_deg().to_radians(),
    }
}

/// On which side of the plane across its axis a panel's centre is that lies so far along it, in m: 1 or -1, 0 within rounding of the
/// plane.
fn side_of(along_axis_m: f64) -> f64 {
    const ROUNDING_M: f64 = 1e-9;
    if along_axis_m.abs() <= ROUNDING_M { 0.0 } else { along_axis_m.signum() }
}
