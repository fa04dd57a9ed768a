//! Sun sensors: where each looks, and how far about its axis.

use nalgebra::Vector3;
use serde::Serialize;

/// A Sun sensor on the body.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MountedSunSensor {
    /// For messages and the manual.
    pub name: String,
    /// Unit vector of its axis.
    pub axis_body: Vector3<f64>,
    /// Half the field of view, from the axis, in rad.
    pub half_field_of_view_rad: f64,
}

/// Half the field of view unless the file gives one: six along the body axes then see everywhere (a cube's corner is 54.7 deg
/// from its faces). Assumed: paper 001 says how many there are and no more.
pub(super) const HALF_FIELD_OF_VIEW_DEG: f64 = 60.0;

impl MountedSunSensor {
    /// Six along the body axes.
    pub fn six() -> Vec<Self> {
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        let named = axes
            .iter()
            .zip(["X", "Y", "Z"])
            .flat_map(|(axis, name)| [(format!("+{name}"), *axis), (format!("-{name}"), -axis)]);
        let half_field_of_view_rad = HALF_FIELD_OF_VIEW_DEG.to_radians();
        named.map(|(name, axis_body)| Self { name, axis_body, half_field_of_view_rad }).collect()
    }
}
