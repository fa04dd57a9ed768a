//! Directions in the body frame as azimuth and elevation (paper 000, "Spacecraft coordinate system").

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::math;

/// Azimuth A and elevation E of a direction: u = [cos E sin A, -cos E cos A, -sin E].
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct SunAngles {
    /// From the -Y axis toward +X, -pi..pi, in rad.
    pub azimuth_rad: f64,
    /// Positive toward -Z, -pi/2..pi/2, in rad.
    pub elevation_rad: f64,
}

impl SunAngles {
    /// Angles of a body-frame direction of any length; along the Z axis the azimuth is 0.
    pub fn from_direction(direction_body: &Vector3<f64>) -> Self {
        let across = direction_body.xy().norm();
        let azimuth_rad = if across == 0.0 { 0.0 } else { math::atan2(direction_body.x, -direction_body.y) };
        Self { azimuth_rad, elevation_rad: math::atan2(-direction_body.z, across) }
    }

    /// Distance inside a keep-in zone that is symmetric in both angles, in rad; negative outside.
    pub fn keep_in_margin_rad(&self, azimuth_limit_rad: f64, elevation_limit_rad: f64) -> f64 {
        (azimuth_limit_rad - self.azimuth_rad.abs()).min(elevation_limit_rad - self.elevation_rad.abs())
    }
}

/// Body-frame unit vector of azimuth and elevation.
pub fn direction_from_angles(angles: SunAngles) -> Vector3<f64> {
    let (sin_a, cos_a) = math::sin_cos(angles.azimuth_rad);
    let (sin_e, cos_e) = math::sin_cos(angles.elevation_rad);
    Vector3::new(cos_e * sin_a, -cos_e * cos_a, -sin_e)
}

/// Angle between two vectors of any length, in rad, accurate near 0 and near pi.
#[inline]
pub fn angle_between_rad(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    math::atan2(a.cross(b).norm(), a.dot(b))
}

#[cfg(test)]
mod tests {
    //! The angles of the axes are stated in words by the paper.
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn the_axes_have_the_angles_the_paper_says() {
        let of = |x, y, z| SunAngles::from_direction(&Vector3::new(x, y, z));
        assert_eq!(of(0.0, -1.0, 0.0), SunAngles { azimuth_rad: 0.0, elevation_rad: 0.0 });
        assert_relative_eq!(of(1.0, 0.0, 0.0).azimuth_rad, FRAC_PI_2);
        assert_relative_eq!(of(0.0, 1.0, 0.0).azimuth_rad.abs(), PI);
        assert_relative_eq!(of(0.0, 0.0, -1.0).elevation_rad, FRAC_PI_2);
        assert_relative_eq!(of(0.0, 0.0, 1.0).elevation_rad, -FRAC_PI_2);
    }

    #[test]
    fn there_and_back() {
        for a in -8..=8 {
            for e in -7..=7 {
                let angles =
                    SunAngles { azimuth_rad: f64::from(a) * 0.39, elevation_rad: f64::from(e) * 0.22 };
                let back = SunAngles::from_direction(&(3.0 * direction_from_angles(angles)));
                assert_relative_eq!(back.azimuth_rad, angles.azimuth_rad, epsilon = 1e-14);
                assert_relative_eq!(back.elevation_rad, angles.elevation_rad, epsilon = 1e-14);
            }
        }
    }
}
