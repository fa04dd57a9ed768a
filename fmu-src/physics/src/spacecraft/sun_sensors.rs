//! Sun sensors: where each looks, and how far about its axis.

use nalgebra::Vector3;
use serde::Serialize;

use crate::toml::{HalfTurn, UnitVector, tables};

tables! {
/// A Sun sensor.
struct SunSensorDescription called "sun sensor" makes #[derive(Clone, Debug, PartialEq, Serialize)] pub struct MountedSunSensor {
    /// Name for messages; numbered unless given.
    name: Option<String>,
    /// Unit vector of its axis, body frame.
    axis as axis_body: UnitVector,
    /// Half the field of view, from the axis, in deg.
    half_field_of_view_deg as half_field_of_view_rad: HalfTurn = HALF_FIELD_OF_VIEW_DEG,
}
}

/// Half the field of view unless the file gives one: six along the body axes then see everywhere (a cube's corner is 54.7 deg
/// from its faces). Assumed: paper 001 says how many there are and no more.
const HALF_FIELD_OF_VIEW_DEG: f64 = 60.0;

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
