//! The shape of plates, sunshade and panels in a spacecraft file.

use super::describe_shapes::{MirrorPlane, RepeatDescription};
use super::describe_thermal::ThermalDescription;
use crate::spacecraft::panel::PanelControl;
use crate::spacecraft::surface::SunshadeModel;
use crate::toml::{
    HalfTurnEither, List, NonEmpty, Point, Positive, SubtendedAngle, TurnEither, UnitVector, tables,
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
