//! Attitudes as the FMUs have them, and angles that stay exact when they are small.

use nalgebra::{UnitQuaternion, Vector3};

/// Three components.
pub(crate) type Vector = Vector3<f64>;

/// From EME2000 to the body frame as a passive rotation: as an active one it takes body components to inertial ones.
pub(crate) type Attitude = UnitQuaternion<f64>;

/// Angle between two vectors, in rad.
pub(crate) fn angle_rad(a: &Vector, b: &Vector) -> f64 {
    a.cross(b).norm().atan2(a.dot(b))
}

/// The greatest magnitude; 0 of none.
pub(crate) fn greatest(values: impl Iterator<Item = f64>) -> f64 {
    values.map(f64::abs).fold(0.0, f64::max)
}

/// The part of v across the unit vector `axis`.
pub(crate) fn across(v: &Vector, axis: &Vector) -> Vector {
    v - axis * v.dot(axis)
}

/// Azimuth from -Y toward +X and elevation toward -Z of a body direction, in deg; azimuths from -90 to 270 deg, so that
/// neither -Y nor +Y is at a jump.
pub(crate) fn body_angles_deg(direction: &Vector) -> [f64; 2] {
    let azimuth_deg = direction.x.atan2(-direction.y).to_degrees();
    let turns = if azimuth_deg < -90.0 { 360.0 } else { 0.0 };
    [azimuth_deg + turns, (-direction.z).atan2(direction.x.hypot(direction.y)).to_degrees()]
}

/// The body direction of an azimuth and an elevation, in rad.
pub(crate) fn body_direction(azimuth_rad: f64, elevation_rad: f64) -> Vector {
    let ((sin_a, cos_a), (sin_e, cos_e)) = (azimuth_rad.sin_cos(), elevation_rad.sin_cos());
    Vector::new(cos_e * sin_a, -cos_e * cos_a, -sin_e)
}

#[cfg(test)]
mod tests {
    //! The sense of an FMU's quaternion, in closed form.
    use super::*;

    #[test]
    fn a_body_that_turns_about_z_sees_x_go_toward_minus_y() {
        let q = Attitude::from_scaled_axis(Vector::new(0.0, 0.0, 0.5));
        assert!((q.k - 0.25f64.sin()).abs() < 1e-15);
        let seen = q.inverse_transform_vector(&Vector::x());
        assert!((seen - Vector::new(0.5f64.cos(), -(0.5f64.sin()), 0.0)).norm() < 1e-15, "{seen:?}");
        assert!((angle_rad(&Vector::x(), &seen) - 0.5).abs() < 1e-15);
    }
}
