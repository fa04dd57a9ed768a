//! Panels: their table in the file, and the reading of it.

use nalgebra::Vector3;

use super::mass::{PanelMass, inertia_kg_m2};
use super::materials::ChosenMaterial;
use super::outline::{checked_area, checked_center, checked_outline};
use super::panel::{Panel, PanelControl};
use super::part_reader::PartReader;
use super::thermal_table::{ThermalDescription, thermal};
use crate::toml::{HalfTurnEither, List, Named, Point, Positive, TurnEither, UnitVector, Written, tables};

tables! {
/// A flat panel that turns about one axis through its centre.
struct PanelDescription called "panel" {
    /// Name for messages and pictures; numbered unless given.
    name: Option<String>,
    /// Area of one side, in m2; may be left out where a polygon is given.
    area_m2: Option<Positive>,
    /// Centre in the panel frame, in m; may be left out where a polygon is given.
    center_m: Option<Point>,
    /// Outline at angle 0 in the panel frame, in m, for self-shadowing; perpendicular to `zero_normal`.
    polygon_m: Option<List<Point, 3>>,
    /// Axis of rotation in the panel frame.
    axis: UnitVector = [1.0, 0.0, 0.0],
    /// Normal of the cell side at angle 0 in the panel frame, perpendicular to the axis.
    zero_normal: UnitVector = [0.0, -1.0, 0.0],
    /// Material of the cell side.
    optics: String,
    /// Material of the back, if light can reach it.
    rear_optics: Option<String>,
    thermal: Option<ThermalDescription>,
    /// Its part of the spacecraft's mass, in kg: centre of mass and inertia then follow its angle; `[mass_properties]` are those
    /// with every panel at angle 0.
    mass_kg: Option<Positive>,
    /// Centre of that mass at angle 0 in the panel frame, in m; the panel's centre unless given.
    mass_center_m: Option<Point>,
    /// Inertia about that centre at angle 0, axes of the panel frame, row by row, in kg m2; that of a thin square plate unless
    /// given.
    inertia_kg_m2: Option<[[f64; 3]; 3]>,
    /// How the angle comes about.
    control: PanelControl = PanelControl::SunOffset,
    /// Angle between cell normal and Sun for `sun_offset`, in deg; its sign is a sense of tilt.
    sun_offset_deg as sun_offset_rad: HalfTurnEither = 0.0,
    /// Sense of the tilt off the Sun about the panel's axis at a positive offset: 1 or -1.
    #[cfg_attr(feature = "schema", schemars(extend("enum" = [1, -1])))]
    tilt_sign: i64 = 1,
    /// Sense in which a windmill angle turns the panel about its axis: 1, -1, or 0, not at all. Left out, the sign of the centre's part
    /// along the axis, so that panels of both sides turn against one another.
    #[cfg_attr(feature = "schema", schemars(extend("enum" = [1, -1, 0])))]
    windmill_side: Option<i64>,
    /// Angle about the axis for `angle`, in deg.
    angle_deg as angle_rad: TurnEither = 0.0,
    /// Misalignment: turns of the panel frame about the body's X, then Y, then Z axis, in deg.
    rotation_deg as rotation_rad: Option<[TurnEither; 3]>,
    /// Misalignment as matrix, row by row: components in the panel frame to components in the body frame.
    dcm_body_from_panel: Option<[[f64; 3]; 3]>,
} rules {
    Requires mass_center_m => mass_kg: "no mass_kg beside it", "with mass_kg alone";
    Requires inertia_kg_m2 => mass_kg: "no mass_kg beside it", "with mass_kg alone";
    Excludes dcm_body_from_panel => rotation_deg: "both `rotation_deg` and `dcm_body_from_panel`", "one of them";
}
}

/// Reads a panel.
pub(super) fn panel(part: &PartReader<'_>, description: &PanelDescription) -> Panel {
    let dcm_body_from_panel =
        part.key("dcm_body_from_panel").rotation(description.rotation_rad(), description.dcm_body_from_panel);
    let axis = description.axis();
    let zero_normal = part.key("zero_normal").perpendicular(description.zero_normal(), &axis, "axis");
    let tilt_sign = description.tilt_sign();
    if tilt_sign.abs() != 1 {
        part.key("tilt_sign").report(tilt_sign, "1 or -1");
    }
    if let Some(side) = description.windmill_side.filter(|side| !(-1..=1).contains(side)) {
        part.key("windmill_side").report(side, "1, -1 or 0");
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
        faces: ChosenMaterial::faces(front, rear, thermal(part, description.thermal.as_ref(), front, rear)),
        polygon: outline.as_ref().map(|polygon| polygon.moved(|v| dcm_body_from_panel * v)),
        control: description.control(),
        sun_offset_rad: description.sun_offset_rad(),
        tilt_sign: if tilt_sign < 0 { -1.0 } else { 1.0 },
        windmill_side,
        angle_rad: description.angle_rad(),
    }
}

/// A panel's mass in the panel frame.
fn panel_mass(
    part: &PartReader<'_>,
    description: &PanelDescription,
    area_m2: f64,
    center_m: Vector3<f64>,
    normal: &Vector3<f64>,
) -> Option<PanelMass> {
    let Positive(mass_kg) = description.mass_kg?;
    let place = description.mass_center_m.value().unwrap_or(center_m);
    let mut mass = PanelMass::square_plate(mass_kg, area_m2, place, normal);
    if let Some(rows) = description.inertia_kg_m2 {
        mass.inertia_body_kg_m2 = inertia_kg_m2(part, rows);
    }
    Some(mass)
}

/// Returns the side of the plane across the axis on which a panel's centre lies, by its distance along the axis in m: 1 or -1, or 0
/// within rounding of the plane.
fn side_of(along_axis_m: f64) -> f64 {
    const ROUNDING_M: f64 = 1e-9;
    if along_axis_m.abs() <= ROUNDING_M { 0.0 } else { along_axis_m.signum() }
}
