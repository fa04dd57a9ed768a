//! An orbit whose position and velocity are inputs.

use fmi_export::Values;
use nalgebra::Vector3;
use physics::environment::CartesianState;

use crate::momentum_plant::variables::PlantVariables;
use crate::momentum_plant::variables::choices::OrbitSource;

/// Whether position and velocity are inputs.
pub fn is_given(variables: &PlantVariables, values: &Values) -> bool {
    matches!(values.choice(variables.orbit.source), Some(OrbitSource::Inputs | OrbitSource::Held))
}

/// Position and velocity that are set.
pub fn given_state(variables: &PlantVariables, values: &Values) -> CartesianState {
    CartesianState {
        position_m: Vector3::from(values.vector(variables.orbit.position)),
        velocity_m_s: Vector3::from(values.vector(variables.orbit.velocity)),
    }
}
