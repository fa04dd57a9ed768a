//! What inputs give over a step: an orbit's position and velocity, panels that move.

use fmi_export::{InputsOverTime, Real, Values};
use nalgebra::Vector3;
use physics::environment::CartesianState;

use crate::momentum_plant::setup::Plan;
use crate::momentum_plant::variables::PlantVariables;
use crate::momentum_plant::variables::choices::OrbitSource;

/// Whether position and velocity are inputs.
pub fn is_given(variables: &PlantVariables, values: &Values) -> bool {
    matches!(values.choice(variables.orbit.source), OrbitSource::Inputs | OrbitSource::Held)
}

/// Position and velocity that are set.
pub fn given_state(variables: &PlantVariables, values: &Values) -> CartesianState {
    CartesianState {
        position_m: Vector3::from(values.vector(variables.orbit.position)),
        velocity_m_s: Vector3::from(values.vector(variables.orbit.velocity)),
    }
}

/// Whether a panel's angle moves as an input does within a step.
pub fn panels_move(context: &Plan<'_>, inputs: InputsOverTime<'_>) -> bool {
    let moves = |input: Real| inputs.derivatives(input).next().is_some();
    context.variables.panel.iter().any(|panel| moves(panel.angle) || moves(panel.sun_offset_command))
}
