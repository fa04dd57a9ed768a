//! Solar panels that turn about one axis, by a commanded angle or by a constant offset from the Sun's direction.

use nalgebra::Vector3;
use serde::Serialize;

use super::mass::PanelMass;
use super::optics::Optics;
use super::polygon::Polygon;
use super::thermal::Thermal;
use crate::enumeration::enumeration;
use crate::numerics::scalar::{Scalar, constant_vector};

enumeration! {
    /// How a panel's angle comes about.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, serde::Deserialize)]
    #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
    #[serde(rename_all = "snake_case")]
    pub enum PanelControl {
        /// A constant angle between the panel's normal and the Sun.
        1 => SunOffset,
        /// The input angle.
        2 => Angle,
        /// The angle to the Sun of the input sunOffsetCommand.
        3 => Command,
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
    /// Optics of the cell side.
    pub optics: Optics,
    /// Optics of the back; `None` where no light can reach it.
    pub rear_optics: Option<Optics>,
    /// Heat of both faces.
    pub thermal: Thermal,
    /// Outline at angle 0, body frame, counter-clockwise seen from the cell side; panels without one neither shadow
    /// nor are shadowed.
    pub polygon: Option<Polygon>,
    /// How the angle comes about unless somebody chooses otherwise.
    pub control: PanelControl,
    /// Angle between cell normal and Sun for [`PanelControl::SunOffset`], in rad, 0 to pi.
    pub sun_offset_rad: f64,
    /// Which way the panel tilts off the Sun: +1 or -1 about the axis.
    pub tilt_sign: f64,
    /// Angle for [`PanelControl::Angle`], in rad.
    pub angle_rad: f64,
    /// Its part of the mass; without one centre of mass and inertia do not follow its angle.
    pub mass: Option<PanelMass>,
}

impl Panel {
    /// Unit normal of the cell side at an angle about the axis (paper 000, eq 9, for any axis and zero direction).
    pub fn normal_body<T: Scalar>(&self, angle_rad: T) -> Vector3<T> {
        let (sin, cos) = angle_rad.sin_cos();
        constant_vector::<T>(&self.zero_normal_body) * cos
            + constant_vector::<T>(&self.quarter_normal()) * sin
    }

    /// The angle about the axis at which the cell normal makes `sun_offset_rad` with the Sun's direction (a unit
    /// vector in the body frame), tilted by `tilt_sign` about the axis from the Sun-facing angle.
    ///
    /// The offset is measured in space, not in the panel's plane of rotation. Where the Sun is so near the axis that
    /// no angle gives the offset, the nearest is taken: cells turned straight at (or away from) the Sun's projection.
    /// With the Sun on the axis itself every angle gives 90 deg; then the answer is 0.
    pub fn angle_for_sun_offset<T: Scalar>(
        &self,
        sun_body: &Vector3<T>,
        sun_offset_rad: T,
        tilt_sign: f64,
    ) -> T {
        let toward_zero = dot(&self.zero_normal_body, sun_body);
        let toward_quarter = dot(&self.quarter_normal(), sun_body);
        let in_plane_squared = toward_zero * toward_zero + toward_quarter * toward_quarter;
        if in_plane_squared.value() == 0.0 {
            return T::constant(0.0);
        }
        let facing = T::polar_angle(toward_quarter, toward_zero);
        // n.s = |s in the plane| cos(angle - facing): at least -|s|, at most |s|.
        let cos_tilt = in_plane_squared.sqrt().recip() * sun_offset_rad.cos();
        let tilt = if cos_tilt.value() >= 1.0 {
            T::constant(0.0)
        } else if cos_tilt.value() <= -1.0 {
            T::constant(core::f64::consts::PI)
        } else {
            cos_tilt.acos()
        };
        facing + tilt * tilt_sign
    }

    /// Unit normal of the cell side at 90 deg, body frame.
    pub fn quarter_normal(&self) -> Vector3<f64> {
        self.axis_body.cross(&self.zero_normal_body)
    }
}

fn dot<T: Scalar>(constant: &Vector3<f64>, vector: &Vector3<T>) -> T {
    vector.x * constant.x + vector.y * constant.y + vector.z * constant.z
}

#[cfg(test)]
mod tests {
    //! The cell normal makes the asked angle with the Sun, on the asked side, wherever that is possible.

    use approx::assert_relative_eq;
    use proptest::prelude::*;

    use super::*;
    use crate::numerics::scalar::Dual64;

    fn panel() -> Panel {
        Panel {
            name: "right".to_owned(),
            area_m2: 2.5,
            center_body_m: Vector3::new(2.28, 0.0, 0.0),
            axis_body: Vector3::x(),
            zero_normal_body: -Vector3::y(),
            optics: Optics::from_reflectivities(0.52, 0.07),
            rear_optics: None,
            thermal: Thermal::insulated(&Optics::from_reflectivities(0.52, 0.07), None),
            polygon: None,
            control: PanelControl::SunOffset,
            sun_offset_rad: 65_f64.to_radians(),
            tilt_sign: 1.0,
            angle_rad: 0.0,
            mass: None,
        }
    }

    #[test]
    fn zero_angle_looks_along_minus_y_and_a_quarter_turn_along_minus_z() {
        assert_relative_eq!(panel().normal_body(0.0), -Vector3::y(), epsilon = 1e-15);
        assert_relative_eq!(
            panel().normal_body(core::f64::consts::FRAC_PI_2),
            -Vector3::z(),
            epsilon = 1e-15
        );
    }

    #[test]
    fn with_the_sun_ahead_the_angle_is_the_offset_itself() {
        let sun: Vector3<f64> = -Vector3::y();
        for (offset, sign) in [(1.1, 1.0), (1.1, -1.0), (0.0, 1.0), (2.5, -1.0)] {
            assert_relative_eq!(
                panel().angle_for_sun_offset(&sun, offset, sign),
                offset * sign,
                epsilon = 1e-15
            );
        }
    }

    #[test]
    fn with_the_sun_on_the_axis_the_answer_is_finite() {
        assert_eq!(panel().angle_for_sun_offset(&Vector3::<f64>::x(), 1.0, 1.0), 0.0);
        let sun = Vector3::x().map(Dual64::constant);
        assert_eq!(panel().angle_for_sun_offset(&sun, Dual64::constant(1.0), 1.0).eps, 0.0);
    }

    proptest! {
        #[test]
        fn the_offset_is_met_or_else_is_as_near_as_it_gets(
            azimuth in -3.1..3.1_f64, z in -0.999..0.999_f64, offset in 0.0..3.1_f64, positive: bool,
        ) {
            let rho = (1.0 - z * z).sqrt();
            let sun = Vector3::new(rho * azimuth.cos(), rho * azimuth.sin(), z);
            let sign = if positive { 1.0 } else { -1.0 };
            let panel = panel();
            let angle = panel.angle_for_sun_offset(&sun, offset, sign);
            let normal = panel.normal_body(angle);
            let met = normal.dot(&sun).clamp(-1.0, 1.0).acos();
            // Independent of the formula: scan all angles for the least miss.
            let least = (0..7200)
                .map(|i| panel.normal_body(f64::from(i) * core::f64::consts::TAU / 7200.0))
                .map(|n| (n.dot(&sun).clamp(-1.0, 1.0).acos() - offset).abs())
                .fold(f64::INFINITY, f64::min);
            prop_assert!((met - offset).abs() <= least + 1e-7, "miss {} against {least}", met - offset);
            // The asked side: the normal is the Sun-facing one turned by `sign` about the axis.
            prop_assert!(sign * panel.axis_body.cross(&sun).dot(&normal) >= -1e-12);
        }
    }
}
