//! Instruments fixed in the body frame: where each looks.

use nalgebra::Vector3;
use serde::Serialize;

/// An instrument.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Instrument {
    /// For messages and the manual.
    pub name: String,
    /// Unit vector of its boresight.
    pub boresight_body: Vector3<f64>,
}
