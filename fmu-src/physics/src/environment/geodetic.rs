//! stub
use nalgebra::{Matrix3, Vector3};
/// e
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipsoid {
    /// a
    pub equatorial_radius_m: f64,
    /// f
    pub flattening: f64,
}
/// g
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geodetic {
    /// l
    pub latitude_rad: f64,
    /// l
    pub longitude_rad: f64,
    /// h
    pub height_m: f64,
}
impl Ellipsoid {
    /// g
    pub fn geodetic(&self, p: &Vector3<f64>) -> Geodetic { Geodetic { latitude_rad: 0.0, longitude_rad: 0.0, height_m: p.norm() - self.equatorial_radius_m } }
}
impl Geodetic {
    /// e
    pub fn east_north_up(&self) -> Matrix3<f64> { Matrix3::identity() }
}
