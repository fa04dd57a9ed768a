//! stub
use crate::numerics::scalar::Scalar;
use nalgebra::Vector3;
/// t
pub fn torque_n_m<T: Scalar>(d: &Vector3<T>, f: &Vector3<T>) -> Vector3<T> { d.cross(f) }
