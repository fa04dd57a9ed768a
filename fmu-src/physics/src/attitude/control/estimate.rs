//! Estimate of attitude and rate.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::attitude::rotation::Attitude;

/// Estimated attitude and rate at a sample.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// EME2000 to body; relative to an unknown inertial frame where not valid.
    pub attitude: Attitude,
    /// Whether the attitude is known in EME2000.
    pub is_valid: bool,
    /// Body rate, in rad/s; `None` where nothing measures it.
    pub rate_body_rad_s: Option<Vector3<f64>>,
}
