//! From what acts by source to the output variables.

use fmi_export::{OutputGroups, Real, RealVector, Values};
use nalgebra::Vector3;
use physics::numerics::scalar::Scalar;
use physics::plant::BySource;
use physics::radiation::disturbance::Workspace;

use super::variables::DisturbanceVariables;
use crate::common::loads;

/// Source of the outputs: the loads found, and the model they come from.
pub(super) struct DisturbanceOutputs<'v, T: Scalar> {
    pub variables: &'v DisturbanceVariables,
    pub found: &'v BySource<T>,
    pub workspace: &'v Workspace<T>,
}

impl DisturbanceOutputs<'_, f64> {
    /// Writes the outputs of these groups.
    pub(super) fn write(&self, values: &mut Values, groups: OutputGroups) {
        let Self { variables, found, workspace } = self;
        if groups.contains(0) {
            self.totals().for_each(|(handle, vector)| values.set_vector(handle, vector.into()));
            values.set_real(variables.sun.lit_fraction, found.lit_fraction);
        }
        if groups.contains(1) {
            self.by_source().for_each(|(handle, vector)| values.set_vector(handle, vector.into()));
        }
        if groups.contains(2) {
            for (plate, face) in variables.plate.iter().zip(workspace.faces()) {
                values.set_real(plate.temperature, face.temperature_k);
                values.set_vector(plate.force, face.force_body_n(found.active).into());
            }
        }
    }
}

impl<T: Scalar> DisturbanceOutputs<'_, T> {
    /// The value of an output.
    pub(super) fn value(&self, output: Real) -> Option<T> {
        let Self { variables, found, workspace } = self;
        if output == variables.sun.lit_fraction {
            return Some(found.lit_fraction);
        }
        let element = |(handle, vector): (RealVector<3>, Vector3<T>)| {
            handle.index_of(output).map(|index| vector[index])
        };
        if let Some(value) = self.by_source().chain(self.totals()).find_map(element) {
            return Some(value);
        }
        variables.plate.iter().zip(workspace.faces()).find_map(|(plate, face)| {
            let force = || element((plate.force, face.force_body_n(found.active)));
            (output == plate.temperature).then_some(face.temperature_k).or_else(force)
        })
    }

    /// Torque and force by source.
    fn by_source(&self) -> impl Iterator<Item = (RealVector<3>, Vector3<T>)> + '_ {
        let (torque, force) = (&self.variables.torque.by_source, &self.variables.force.by_source);
        loads::vectors(torque, force, &self.found.loads)
    }

    /// Torque and force of all sources.
    fn totals(&self) -> impl Iterator<Item = (RealVector<3>, Vector3<T>)> + use<T> {
        let total = self.found.loads.total();
        let (torque, force) = (self.variables.torque.total, self.variables.force.total);
        [(torque, total.torque_body_n_m), (force, total.force_body_n)].into_iter()
    }
}
