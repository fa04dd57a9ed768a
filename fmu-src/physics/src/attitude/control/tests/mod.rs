//! Attitude control against closed forms, searches, and a rigid body integrated by other means.

mod accelerometer;
mod allocation;
mod closed_loop;
mod degraded;
mod estimator;
mod reference;
mod rig;
mod settings;
mod sun_sensors;

use nalgebra::Vector3;

use crate::attitude::Attitude;
use crate::numerics::noise::{Channel, normal_vector};

/// A random vector of independent normal components, by number.
fn random(number: u64) -> Vector3<f64> {
    normal_vector(17, Channel::StarTrackerAxes, number)
}

/// A random unit vector, by number.
fn random_unit(number: u64) -> Vector3<f64> {
    random(number).normalize()
}

/// A random attitude, by number.
fn random_attitude(number: u64) -> Attitude {
    let (v, w) = (random(2 * number), random(2 * number + 1));
    let norm = (v.norm_squared() + w.x * w.x).sqrt();
    Attitude::from_quaternion([v.x / norm, v.y / norm, v.z / norm, w.x / norm]).unwrap()
}
