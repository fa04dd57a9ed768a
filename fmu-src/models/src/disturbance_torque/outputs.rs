//! From what acts by source to the output variables.

use fmi_export::{Real, RealVector, Values};
use nalgebra::Vector3;
use physics::numerics::scalar::Scalar;
use physics::radiation::disturbance::{BySource, Workspace};

use super::variables::DisturbanceVariables;

/// Writes every output.
pub fn write(
    variables: &DisturbanceVariables,
    values: &mut Values,
    found: &BySource<f64>,
    workspace: &Workspace<f64>,
) {
    for (handle, vector) in vectors(variables, found) {
        values.set_vector(handle, vector.into());
    }
    values.set_real(variables.sun.lit_fraction, found.lit_fraction);
    for (plate, face) in variables.plate.iter().zip(workspace.faces()) {
        values.set_real(plate.temperature, face.temperature_k);
        values.set_vector(plate.force, face.force_body_n().into());
    }
}

/// The value of an output.
pub fn value<T: Scalar>(
    variables: &DisturbanceVariables,
    found: &BySource<T>,
    workspace: &Workspace<T>,
    output: Real,
) -> Option<T> {
    if output == variables.sun.lit_fraction {
        return Some(found.lit_fraction);
    }
    let element =
        |(handle, vector): (RealVector<3>, Vector3<T>)| handle.index_of(output).map(|index| vector[index]);
    if let Some(value) = vectors(variables, found).into_iter().find_map(element) {
        return Some(value);
    }
    variables.plate.iter().zip(workspace.faces()).find_map(|(plate, face)| {
        let force = || element((plate.force, face.force_body_n()));
        (output == plate.temperature).then_some(face.temperature_k).or_else(force)
    })
}

fn vectors<T: Scalar>(
    variables: &DisturbanceVariables,
    found: &BySource<T>,
) -> [(RealVector<3>, Vector3<T>); 11] {
    let (torque, force) = (&variables.torque, &variables.force);
    let light = &found.disturbance;
    [
        (torque.by_source.solar, light.solar.torque_body_n_m),
        (torque.by_source.albedo, light.albedo.torque_body_n_m),
        (torque.by_source.infrared, light.infrared.torque_body_n_m),
        (torque.by_source.thermal, light.thermal.torque_body_n_m),
        (torque.by_source.gravity_gradient, found.gravity_gradient_n_m),
        (torque.total, found.total_torque_body_n_m()),
        (force.by_source.solar, light.solar.force_body_n),
        (force.by_source.albedo, light.albedo.force_body_n),
        (force.by_source.infrared, light.infrared.force_body_n),
        (force.by_source.thermal, light.thermal.force_body_n),
        (force.total, found.total_force_body_n()),
    ]
}
