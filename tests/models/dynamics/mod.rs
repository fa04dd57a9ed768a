//! Controlled and free flight: rigid body, wheels, controller, sensors.

mod burns;
mod control;
mod flexibility;
mod momentum;
mod panel_momentum;
mod panel_turns;
mod refusals;
mod sensors;
mod spin_light;
mod tanks;
mod thrusters;

use models::MomentumPlant;
use nalgebra::{Matrix3, UnitQuaternion, Vector3};

use super::named_model::{NamedInstance, NamedModel};

type PlantInstance<'a> = NamedInstance<'a, MomentumPlant>;
type Start<'a> = &'a [(&'a str, f64)];

/// Plant without any source of torque.
const DARK: Start<'_> = &[
    ("solar.flux", 0.0),
    ("gravityGradient.enabled", 0.0),
    ("aerodynamics.enabled", 0.0),
    ("magnetics.enabled", 0.0),
];
const CONTROLLED: Start<'_> = &[("attitude.source", 3.0)];
/// At rest in EME2000.
const FREE: Start<'_> = &[("attitude.source", 4.0), ("start.q[4]", 1.0)];
/// The orbit phase's own guidance.
const GUIDANCE: Start<'_> = &[("command.source", 2.0)];

fn with<'a>(parts: &[Start<'a>]) -> Vec<(&'a str, f64)> {
    parts.iter().flat_map(|part| part.iter().copied()).collect()
}

/// Body to inertial, from the output quaternion.
fn to_inertial(flight: &PlantInstance<'_>) -> UnitQuaternion<f64> {
    flight.to_inertial("attitude.q")
}

fn inertia() -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(199.6, 507.1, 484.9))
}

/// Spin axes of the shipped spacecraft.
fn axes(flight: &PlantInstance<'_>) -> Vec<Vector3<f64>> {
    (1..=4).map(|k| flight.vector(&format!("wheel[{k}].axis")).normalize()).collect()
}

fn held_momentum(flight: &PlantInstance<'_>) -> Vector3<f64> {
    let wheels = (1..).zip(axes(flight));
    wheels.map(|(k, axis)| axis * flight.real(&format!("wheel[{k}].momentum"))).sum()
}

/// C(q) transposed applied to J w + sum of h a, from the outputs.
fn formed_momentum(flight: &PlantInstance<'_>) -> Vector3<f64> {
    to_inertial(flight) * (inertia() * flight.vector("attitude.rate") + held_momentum(flight))
}

fn set_quaternion(flight: &mut PlantInstance<'_>, name: &str, attitude: &UnitQuaternion<f64>) {
    flight.set_elements(name, attitude.coords.iter());
}

fn initialize<'a>(named: &'a NamedModel<MomentumPlant>, parts: &[Start<'_>]) -> PlantInstance<'a> {
    named.initialize(0.0, &with(parts)).unwrap()
}
