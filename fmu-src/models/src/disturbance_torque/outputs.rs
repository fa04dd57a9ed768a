//! From an outcome to the output variables.

use fmi_export::{Real, RealVector, Values};
use nalgebra::Vector3;
use physics::numerics::scalar::Scalar;
use physics::radiation::disturbance::Workspace;

use super::prepared::Outcome;
use super::variables::DisturbanceVariables;

/// Writes every output.
pub fn write(
    variables: &DisturbanceVariables,
    values: &mut Values,
    outcome: &Outcome<f64>,
    workspace: &Workspace<f64>,
) {
    for (handle, vector) in vectors(variables, outcome) {
        values.set_vector(handle, vector.into());
    }
    values.set_real(variables.sun.lit_fraction, outcome.lit_fraction);
    for (plate, face) in variables.plate.iter().zip(workspace.faces()) {
        values.set_real(plate.temperature, face.temperature_k);
        values.set_vector(plate.force, face.force_body_n().into());
    }
}

/// The value of an output.
pub fn value<T: Scalar>(
    variables: &DisturbanceVariables,
    outcome: &Outcome<T>,
    workspace: &Workspace<T>,
    output: Real,
) -> Option<T> {
    if output == variables.sun.lit_fraction {
        return Some(outcome.lit_fraction);
    }
    let element =
        |(handle, vector): (RealVector<3>, Vector3<T>)| handle.index_of(output).map(|index| vector[index]);
    if let Some(value) = vectors(variables, outcome).into_iter().find_map(element) {
        return Some(value);
    }
    variables.plate.iter().zip(workspace.faces()).find_map(|(plate, face)| {
        let force = || element((plate.force, face.force_body_n()));
        (output == plate.temperature).then_some(face.temperature_k).or_else(force)
    })
}

fn vectors<T: Scalar>(
    variables: &DisturbanceVariables,
    outcome: &Outcome<T>,
) -> [(RealVector<3>, Vector3<T>); 11] {
    let (torque, force) = (&variables.torque, &variables.force);
    let found = &outcome.disturbance;
    let total = found.total();
    [
        (torque.solar, found.solar.torque_body_n_m),
        (torque.albedo, found.albedo.torque_body_n_m),
        (torque.infrared, found.infrared.torque_body_n_m),
        (torque.thermal, found.thermal.torque_body_n_m),
        (torque.gravity_gradient, outcome.gravity_gradient_n_m),
        (torque.total, total.torque_body_n_m + outcome.gravity_gradient_n_m),
        (force.solar, found.solar.force_body_n),
        (force.albedo, found.albedo.force_body_n),
        (force.infrared, found.infrared.force_body_n),
        (force.thermal, found.thermal.force_body_n),
        (force.total, total.force_body_n),
    ]
}
