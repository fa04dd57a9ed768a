//! Time derivatives of the outputs that the plant integrates.

use fmi_export::{OutputRates, Real, RealVector, Values};
use nalgebra::Vector3;
use physics::attitude::Attitude;

use crate::momentum_plant::setup::{MomentumPlant, Plan};
use crate::momentum_plant::state::PlantState;

impl OutputRates for MomentumPlant {
    /// First time derivative of an output, from the rates at the same time; `None` of outputs that are not integrated.
    fn output_rate(context: &Plan<'_>, values: &Values, state: &PlantState, output: Real) -> Option<f64> {
        if state.saved.waiting {
            return None;
        }
        let variables = context.variables;
        let convention = state.saved.flight.configuration()?.momentum.convention;
        let mut torque_body = Vector3::from(values.vector(variables.torque.total));
        if values.boolean(variables.dump.active) {
            torque_body = state.saved.flight.with_dump_body_n_m(&torque_body);
        }
        if let Some(element) = variables.attitude.q.index_of(output) {
            let attitude = Attitude::from_quaternion(values.vector(variables.attitude.q)).ok()?;
            return Some(attitude.quaternion_rate(&values.vector(variables.attitude.rate).into())[element]);
        }
        let momentum_rate = |momentum: RealVector<3>, torque_body: &Vector3<f64>, axis: usize| {
            let [momentum_body, rate_body] =
                [momentum, variables.attitude.rate].map(|handle| Vector3::from(values.vector(handle)));
            Some(convention.momentum_rate_body_n_m(&momentum_body, torque_body, &rate_body)[axis])
        };
        if let Some(axis) = variables.momentum.body.index_of(output) {
            return momentum_rate(variables.momentum.body, &torque_body, axis);
        }
        let mut by_source = variables.momentum.by_source.iter();
        let found = by_source.find_map(|(effect, handle)| Some((effect, handle, handle.index_of(output)?)));
        if let Some((effect, handle, axis)) = found {
            let torque = variables.torque.by_source.output(effect).unwrap_or(variables.torque.applied);
            return momentum_rate(handle, &values.vector(torque).into(), axis);
        }
        if let Some(axis) = variables.momentum.inertial.index_of(output) {
            let attitude = Attitude::from_quaternion(values.vector(variables.attitude.q)).ok()?;
            return Some(attitude.to_inertial(&torque_body)[axis]);
        }
        if let Some(axis) = variables.delta_v.index_of(output) {
            return Some(values.vector(variables.acceleration)[axis]);
        }
        let moving = [
            (variables.position, variables.velocity),
            (variables.sun.position_inertial, variables.sun.velocity_inertial),
            (variables.earth.position_inertial, variables.earth.velocity_inertial),
        ];
        let found = moving.iter().find_map(|(place, rate)| place.index_of(output).map(|axis| (rate, axis)));
        found.map(|(rate, axis)| values.vector(*rate)[axis])
    }
}
