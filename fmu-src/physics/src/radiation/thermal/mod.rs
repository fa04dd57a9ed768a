//! Thermal recoil: how warm surfaces get, and how the heat they give off pushes them (paper 004, eqs 42-50).
//!
//! A face of area A at temperature T radiates eps sigma A T^4 by Lambert's law, whose momentum is 2/3 of its power over
//! the speed of light, along the normal, less the same of what it takes in from space at its background temperature. An
//! insulated face gives off what it takes in (eq 43), one that conducts heat to the bus the rest of it; two faces of a thin
//! structure share their heat (eqs 44-49, with the power 1/4 in eq 48 and the panel's area on both exchange terms).

pub mod balance;
pub mod transient;

use nalgebra::Vector3;

use crate::constants::SPEED_OF_LIGHT_M_S;
use crate::numerics::scalar::Scalar;

/// Recoil of heat radiated by a face (eq 50), in N.
#[inline]
pub fn recoil_n<T: Scalar>(normal: &Vector3<T>, radiated_w: T) -> Vector3<T> {
    *normal * (radiated_w * (-2.0 / (3.0 * SPEED_OF_LIGHT_M_S)))
}
