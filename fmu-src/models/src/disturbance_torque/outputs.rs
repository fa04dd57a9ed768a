//! From what acts by source to the output variables.

use fmi_export::{Knowns, OutputGroups, Real, RealVector, Values, knowns};
use nalgebra::Vector3;
use physics::numerics::scalar::Scalar;
use physics::plant::BySource;
use physics::radiation::disturbance::Workspace;

use super::variables::DisturbanceVariables;
use crate::common::loads;

/// The outputs in groups: totals, sources, faces.
pub(super) fn groups(v: &DisturbanceVariables) -> [Knowns; 3] {
    let totals = knowns![v.torque.total, v.force.total, v.sun.lit_fraction];
    [totals, knowns![&v.torque.by_source, &v.force.by_source], knowns![&v.plate]]
}

/// Writes the outputs of these groups.
pub(super) fn write(
    variables: &DisturbanceVariables,
    values: &mut Values,
    (found, workspace): (&BySource<f64>, &Workspace<f64>),
    groups: OutputGroups,
) {
    let (torque, force) = (&variables.torque, &variables.force);
    if groups.contains(0) {
        totals(variables, found).for_each(|(handle, vector)| values.set_vector(handle, vector.into()));
        values.set_real(variables.sun.lit_fraction, found.lit_fraction);
    }
    if groups.contains(1) {
        let by_source = loads::vectors(&torque.by_source, &force.by_source, &found.loads);
        by_source.for_each(|(handle, vector)| values.set_vector(handle, vector.into()));
    }
    if groups.contains(2) {
        for (plate, face) in variables.plate.iter().zip(workspace.faces()) {
            values.set_real(plate.temperature, face.temperature_k);
            values.set_vector(plate.force, face.force_body_n(found.active).into());
        }
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
    let (torque, force) = (&variables.torque.by_source, &variables.force.by_source);
    loads::vectors(torque, force, &found.loads).chain(totals(variables, found))
}

/// Torque and force of all sources.
fn totals<T: Scalar>(
    variables: &DisturbanceVariables,
    found: &BySource<T>,
) -> impl Iterator<Item = (RealVector<3>, Vector3<T>)> + use<T> {
    let total = found.loads.total();
    let (torque, force) = (variables.torque.total, variables.force.total);
    [(torque, total.torque_body_n_m), (force, total.force_body_n)].into_iter()
}
