//! Wheels as parameters set them: axes, capacities, bias.

use fmi_export::{Failure, Values};
use nalgebra::Vector3;
use physics::attitude::ReactionWheel;
use physics::momentum::{WheelArray, wheels_body_n_m_s};
use physics::spacecraft::free_capacity_n_m_s;

use crate::momentum_plant::setup::{Plan, Read};
use crate::momentum_plant::variables::body::WheelVariables;

/// Distribution of momentum over the wheels; those without a direction hold nothing.
pub(crate) fn array(read: Read<'_>) -> WheelArray {
    let wheels = read.variables.wheel.iter();
    let axes = wheels.map(|wheel| read.vector(wheel.axis).try_normalize(0.0).unwrap_or_default());
    WheelArray::from_axes(&axes.collect::<Vec<_>>())
}

/// Sum of the wheels' biases, body frame, in N m s.
pub(crate) fn bias_body_n_m_s(read: Read<'_>) -> Vector3<f64> {
    let wheels = read.variables.wheel.iter();
    wheels_body_n_m_s(wheels.map(|wheel| (read.vector(wheel.axis), read.real(wheel.bias_momentum))))
}

/// The largest dump threshold at which no wheel saturates, in N m s.
pub(crate) fn guaranteed_threshold_n_m_s(read: Read<'_>) -> f64 {
    let free_n_m_s = |wheel: &WheelVariables| {
        free_capacity_n_m_s(read.real(wheel.capacity), read.real(wheel.bias_momentum))
    };
    array(read).guaranteed_threshold_n_m_s(read.variables.wheel.iter().map(free_n_m_s))
}

/// Momentum of a wheel where a flight by torque begins, in N m s: its bias unless the other is set.
pub(super) fn start_n_m_s(read: Read<'_>, wheel: &WheelVariables) -> f64 {
    let start = wheel.start_momentum;
    let is_given = read.given(&[start.into()]).has(start);
    read.real(if is_given { start } else { wheel.bias_momentum })
}

/// Writes where the wheels start, as it acts.
pub(super) fn write_start(context: &Plan<'_>, values: &mut Values) {
    for wheel in &context.variables.wheel {
        let start_n_m_s = start_n_m_s(Read::new(context, values), wheel);
        values.set_real(wheel.start_momentum, start_n_m_s);
    }
}

/// The reaction wheels by parameters.
pub(super) fn rotors(read: Read<'_>) -> Vec<ReactionWheel> {
    let wheels = read.variables.wheel.iter().map(|wheel| ReactionWheel {
        axis_body: read.vector(wheel.axis),
        inertia_kg_m2: read.real(wheel.inertia),
        max_torque_n_m: read.real(wheel.max_torque),
        capacity_n_m_s: read.real(wheel.capacity),
        bias_n_m_s: read.real(wheel.bias_momentum),
        coulomb_friction_n_m: read.real(wheel.coulomb_friction),
        viscous_friction_n_m_s: read.real(wheel.viscous_friction),
        locked: read.boolean(wheel.locked),
    });
    wheels.collect()
}

/// Refuses a bias beyond the capacity.
pub(super) fn check(read: Read<'_>) -> Result<(), Failure> {
    for (index, wheel) in read.variables.wheel.iter().enumerate() {
        let [found, allowed] = [wheel.bias_momentum, wheel.capacity].map(|it| read.real(it));
        if found.abs() > allowed {
            let number = index.saturating_add(1);
            return Err(Failure::new(format!(
                "wheel[{number}].biasMomentum: found {found:?} N.m.s, allowed: up to {allowed:?} N.m.s either way, its capacity"
            )));
        }
    }
    Ok(())
}
