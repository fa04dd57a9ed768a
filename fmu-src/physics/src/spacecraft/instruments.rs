//! Instruments: where each looks, fixed in the body frame or on a gimbal.

use nalgebra::Vector3;
use serde::Serialize;

/// An instrument.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Instrument {
    /// For messages and the manual.
    pub name: String,
    /// Unit vector of its boresight; on a gimbal at angle 0.
    pub boresight_body: Vector3<f64>,
    /// Gimbal that turns the instrument; `None` if it is fixed to the body.
    pub gimbal: Option<GimbalMount>,
}

/// A gimbal of one axis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GimbalMount {
    /// Unit vector of the axis about which it turns right-handed, perpendicular to the boresight.
    pub axis_body: Vector3<f64>,
    /// Least angle, in rad.
    pub minimum_rad: f64,
    /// Greatest angle, in rad.
    pub maximum_rad: f64,
}
