//! From what acts by source to the output variables.

use fmi_export::{Real, RealVector, Values};
use nalgebra::Vector3;
use physics::numerics::scalar::Scalar;
use physics::plant::BySource;
use physics::radiation::disturbance::Workspace;

use super::variables::DisturbanceVariables;
use crate::common::loads;

/// Writes every output.
pub(super) fn write(
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
        values.set_vector(plate.force, face.force_body_n(found.active).into());
    }
}

/// The value of an output.
pub(super) fn value<T: Scalar>(
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
    if let Some(value) = vectors(variables, found).find_map(element) {
        return Some(value);
    }
    variables.plate.iter().zip(workspace.faces()).find_map(|(plate, face)| {
        let force = || element((plate.force, face.force_body_n(found.active)));
        (output == plate.temperature).then_some(face.temperature_k).or_else(force)
    })
}

/// The outputs that are vectors.
fn vectors<'v, T: Scalar>(
    variables: &'v DisturbanceVariables,
    found: &'v BySource<T>,
) -> impl Iterator<Item = (RealVector<3>, Vector3<T>)> + 'v {
    let (torque, force, total) = (&variables.torque, &variables.force, found.loads.total());
    let totals = [(torque.total, total.torque_body_n_m), (force.total, total.force_body_n)];
    loads::vectors(&torque.by_source, &force.by_source, &found.loads).chain(totals)
}
