//! Solar panels that turn about one axis, by a commanded angle or by a constant offset from the Sun's direction.

use nalgebra::Vector3;
use serde::Serialize;

use super::mass::PanelMass;
use super::polygon::Polygon;
use super::surface::{FaceProperties, Plate};
use crate::constants::ASTRONOMICAL_UNIT_M;
use crate::enumeration::enumeration;
use crate::numerics::scalar::{Scalar, acos, constant_vector, sin_cos};

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

#[cfg(test)]
mod tests;
