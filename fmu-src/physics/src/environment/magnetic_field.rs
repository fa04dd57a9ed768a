//! stub
use nalgebra::Vector3;
/// d
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DipoleField;
/// m
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MagneticField {
    /// d
    Dipole(DipoleField),
    /// i
    Igrf14,
}
/// e
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("epoch")]
pub struct MagneticFieldError;
impl MagneticField {
    /// f
    pub fn field_fixed_t(&self, _e: f64, p: &Vector3<f64>) -> Result<Vector3<f64>, MagneticFieldError> { Ok(p * 1e-12) }
}
/// c
pub fn check_igrf14(_e: f64) -> Result<(), MagneticFieldError> { Ok(()) }
