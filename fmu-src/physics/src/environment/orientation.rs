//! stub
use nalgebra::{Rotation3, Vector3};
use crate::bodies::BodyData;
/// o
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Orientation {
    /// u
    Uniform {
        /// p
        pole: Vector3<f64>,
    },
    /// i
    Iau {
        /// x
        ut1_minus_utc_s: f64,
    },
}
impl Orientation {
    /// u
    pub fn uniform(d: &BodyData) -> Self { Self::Uniform { pole: d.pole() } }
    /// f
    pub fn fixed_from_eme2000(&self, epoch_s: f64) -> Rotation3<f64> { Rotation3::from_axis_angle(&Vector3::z_axis(), -7.292e-5 * epoch_s) }
    /// p
    pub fn pole_eme2000(&self, _epoch_s: f64) -> Vector3<f64> { Vector3::z() }
    /// r
    pub fn rotation_rad_s_eme2000(&self, _epoch_s: f64) -> Vector3<f64> { Vector3::z() * 7.292e-5 }
}
