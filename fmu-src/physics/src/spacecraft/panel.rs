//! Solar panels that turn about one axis, by a commanded angle or by a constant offset from the Sun's direction.

use nalgebra::Vector3;
use serde::Serialize;

use super::mass::{PanelMass, inertia_kg_m2};
use super::materials::ChosenMaterial;
use super::outline::{checked_area, checked_center, checked_outline};
use super::part_reader::PartReader;
use super::polygon::Polygon;
use super::surface::{FaceProperties, Plate};
use super::thermal_table::{ThermalDescription, thermal};
use crate::constants::ASTRONOMICAL_UNIT_M;
use crate::enumeration::enumeration;
use crate::numerics::scalar::{Scalar, acos, constant_vector, sin_cos};
use crate::toml::{HalfTurnEither, List, Named, Point, Positive, TurnEither, UnitVector, Written, tables};

enumeration! {
    /// How a panel's angle comes about.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, serde::Deserialize)]
    #[serde(rename_all = "snake_case")]
    pub enum PanelControl {
        /// A constant angle between the panel's normal and the Sun.
        1 => SunOffset,
        /// The input angle.
        2 => Angle,
        /// The angle to the Sun of the input sunOffsetCommand.
        3 => Command,
        /// The angle to the Sun and the windmill angle of the timeline; where it says nothing, the constant angle to the Sun.
        4 => Timeline,
        /// The angle to the Sun at which the light on the cells is articulation.targetSuns; where not even full sunlight reaches
        /// that, cells toward the Sun.
        5 => Distance,
    }
}

crate::toml::plain!(PanelControl);

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

/// A flat panel whose axis of rotation passes through its centre (paper 000, eqs 9-11).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Panel {
    /// For messages and pictures.
    pub name: String,
    /// Area of one side in m2.
    pub area_m2: f64,
    /// Centre, on the axis, body frame, in m.
    pub center_body_m: Vector3<f64>,
    /// Unit vector of the axis; angles are right-handed about it.
    pub axis_body: Vector3<f64>,
    /// Unit normal of the cell side at angle 0, perpendicular to the axis.
    pub zero_normal_body: Vector3<f64>,
    /// Cell side and back.
    pub faces: FaceProperties,
    /// Outline at angle 0, body frame, counter-clockwise seen from the cell side; panels without one neither shadow
    /// nor are shadowed.
    pub polygon: Option<Polygon>,
    /// How the angle comes about unless somebody chooses otherwise.
    pub control: PanelControl,
    /// Angle between cell normal and Sun for [`PanelControl::SunOffset`], in rad, -pi to pi; the sign
    /// is a sense of tilt.
    pub sun_offset_rad: f64,
    /// Sense of the tilt off the Sun: +1 or -1 about the axis.
    pub tilt_sign: f64,
    /// Sense of a windmill angle about the panel's axis: +1, -1, or 0 if it does not turn the panel.
    pub windmill_side: f64,
    /// Angle for [`PanelControl::Angle`], in rad.
    pub angle_rad: f64,
    /// Its part of the mass; without one centre of mass and inertia do not follow its angle.
    pub mass: Option<PanelMass>,
}

impl Panel {
    /// The plate that it is at angle 0.
    pub fn plate_at_zero(&self) -> Plate {
        Plate {
            name: self.name.clone(),
            area_m2: self.area_m2,
            center_m: self.center_body_m,
            normal: self.zero_normal_body,
            faces: self.faces,
            polygon: self.polygon.clone(),
        }
    }

    /// Unit normal of the cell side at an angle about the axis (paper 000, eq 9, for any axis and zero direction).
    pub fn normal_body<T: Scalar>(&self, angle_rad: T) -> Vector3<T> {
        let (sin, cos) = sin_cos(angle_rad);
        self.normal_by_cos_sin([cos, sin])
    }

    /// Unit normal of the cell side by cosine and sine of the angle.
    fn normal_by_cos_sin<T: Scalar>(&self, [cos, sin]: [T; 2]) -> Vector3<T> {
        constant_vector::<T>(&self.zero_normal_body) * cos
            + constant_vector::<T>(&self.quarter_normal()) * sin
    }

    /// The angle about the axis at which the cell normal makes `sun_offset_rad` with the Sun's direction (a unit
    /// vector in the body frame), tilted by `tilt_sign` times the offset's sign about the axis from the Sun-facing angle.
    ///
    /// The offset is measured in space, not in the panel's plane of rotation: with o the offset and a the Sun's part along the
    /// axis, cos(tilt) = cos o / sqrt(1 - a^2), so tan(tilt) = sin o sqrt(1 - (a / sin o)^2) / cos o, which is smooth through
    /// offset 0 with the axis across the Sun. Where the Sun is so near the axis that no angle gives the offset, the nearest is
    /// taken: cells turned straight at (or away from) the Sun's projection. With the Sun on the axis itself every angle gives
    /// 90 deg; then the answer is 0.
    pub fn angle_for_sun_offset<T: Scalar>(
        &self,
        sun_body: &Vector3<T>,
        sun_offset_rad: T,
        tilt_sign: f64,
    ) -> T {
        let (sin, cos) = sin_cos(sun_offset_rad);
        let [facing, tilt] =
            self.facing_and_tilt(sun_body, [cos, sin]).map(|[cos, sin]| T::polar_angle(sin, cos));
        facing + tilt * tilt_sign
    }

    /// Unit normal of the cell side at that angle; `sun_offset` is cosine and sine of the offset, `tilt_sign` +1 or -1.
    pub fn normal_for_sun_offset<T: Scalar>(
        &self,
        sun_body: &Vector3<T>,
        sun_offset: [T; 2],
        tilt_sign: f64,
    ) -> Vector3<T> {
        let [facing, tilt] = self.facing_and_tilt(sun_body, sun_offset);
        let ([cos, sin], [tilt_cos, tilt_sin]) = (facing, [tilt[0], tilt[1] * tilt_sign]);
        let square = |[cos, sin]: [T; 2]| cos * cos + sin * sin;
        let per_length = T::constant(1.0) / (square(facing) * square(tilt)).sqrt();
        self.normal_by_cos_sin([
            (cos * tilt_cos - sin * tilt_sin) * per_length,
            (sin * tilt_cos + cos * tilt_sin) * per_length,
        ])
    }

    /// Unnormalised cosine and sine of the Sun-facing angle and of the tilt from it; the argument is those of the offset.
    fn facing_and_tilt<T: Scalar>(&self, sun_body: &Vector3<T>, [cos, sin]: [T; 2]) -> [[T; 2]; 2] {
        /// The axis is across the Sun but for the rounding of a unit vector.
        const ACROSS: f64 = 4.0 * f64::EPSILON;
        let [zero, one] = [0.0, 1.0].map(T::constant);
        let facing = [dot(&self.zero_normal_body, sun_body), dot(&self.quarter_normal(), sun_body)];
        if facing.iter().all(|it| it.value() == 0.0) {
            return [[one, zero]; 2];
        }
        let along_axis = dot(&self.axis_body, sun_body);
        let (along, across) = (along_axis.value().abs(), sin.value().abs());
        let tilt = if along <= ACROSS {
            [cos, sin]
        } else if across > along {
            let share = along_axis / sin;
            [cos, sin * (one - share * share).sqrt()]
        } else if cos.value() >= 0.0 {
            [one, zero]
        } else {
            [-one, T::constant(0.0_f64.copysign(sin.value()))]
        };
        [facing, tilt]
    }

    /// Unit normal of the cell side at 90 deg, body frame.
    pub fn quarter_normal(&self) -> Vector3<f64> {
        self.axis_body.cross(&self.zero_normal_body)
    }
}

/// Light on cells in suns by their unit normal, the Sun's direction, both body frame, and its distance in m: 1 is full sunlight across
/// the cells at 1 AU.
pub fn light_suns(normal_body: &Vector3<f64>, sun_body: &Vector3<f64>, sun_distance_m: f64) -> f64 {
    let distance_au = sun_distance_m / ASTRONOMICAL_UNIT_M;
    normal_body.dot(sun_body).max(0.0) / (distance_au * distance_au)
}

/// Angle between cell normal and Sun, in rad, at which the light on the cells is `suns`, this far from the Sun; 0 where not even full
/// sunlight is so much.
pub fn offset_for_suns<T: Scalar>(suns: f64, sun_distance_m: T) -> T {
    let distance_au = sun_distance_m * (1.0 / ASTRONOMICAL_UNIT_M);
    let cosine = distance_au * distance_au * suns;
    if cosine.value() < 1.0 { acos(cosine) } else { T::constant(0.0) }
}

fn dot<T: Scalar>(constant: &Vector3<f64>, vector: &Vector3<T>) -> T {
    vector.x * constant.x + vector.y * constant.y + vector.z * constant.z
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

#[cfg(test)]
mod tests;
