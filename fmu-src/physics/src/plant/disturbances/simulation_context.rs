//! Context of a simulation: everything beside its state and the spacecraft.

use super::evaluation::External;
use super::plant::{Plant, PlantSettings};
use super::simulation_models::SimulationModels;
use crate::plant::settings::attitude_source::Turning;
use crate::plant::settings::configuration::Configuration;
use crate::plant::settings::prepared_spacecraft::PreparedSpacecraft;
use crate::plant::state::ideal_state::IdealState;
use crate::plant::state::propagator_state::PropagatorState;
use crate::plant::thrusters::allocation::ThrusterAllocator;
use crate::spacecraft::MassProperties;

/// Configuration, models and work limit of a simulation: everything beside its state.
#[derive(Clone, Debug)]
pub struct SimulationContext {
    /// Spacecraft and orbit.
    pub configuration: Configuration,
    /// Mass properties with every panel at angle 0 and the propellant left.
    pub current_mass_panels_stowed: MassProperties,
    /// Models and caches.
    pub models: SimulationModels,
    /// Settings of thrusters and tanks, and the last selections among them.
    pub allocator: ThrusterAllocator,
    pub(crate) fork: Box<ForkScratch>,
}

/// Memory of forks: they copy settings and state into it and allocate nothing.
#[derive(Clone, Debug)]
pub(crate) struct ForkScratch {
    /// Settings of a fork.
    pub configuration: Configuration,
    /// Mass properties with every panel at angle 0.
    pub current_mass_panels_stowed: MassProperties,
    /// Momentum and events of a fork.
    pub ideal: Option<IdealState>,
    /// State of a fork, and the states of its last two waypoints.
    pub states: [PropagatorState; 3],
}

impl SimulationContext {
    /// Context of this configuration with full tanks, without light and heat beyond direct sunlight.
    pub fn new(configuration: Configuration) -> Self {
        Self {
            current_mass_panels_stowed: configuration.wet_mass,
            models: SimulationModels::default(),
            allocator: ThrusterAllocator::default(),
            fork: Box::new(ForkScratch {
                configuration: configuration.clone(),
                current_mass_panels_stowed: configuration.wet_mass,
                ideal: None,
                states: Default::default(),
            }),
            configuration,
        }
    }

    /// The plant whose body turns like this where it turns by torque; `external` gives the load from outside at any time.
    pub fn plant<'a>(
        &'a mut self,
        prepared: PreparedSpacecraft<'a>,
        turning: Turning,
        propagator: &'a mut PropagatorState,
        external: &'a External<'a>,
    ) -> Plant<'a> {
        let Self { configuration, current_mass_panels_stowed, models, .. } = self;
        let settings =
            PlantSettings { configuration, current_mass_panels_stowed: *current_mass_panels_stowed, turning };
        Plant::new(prepared, settings, models, propagator, external)
    }
}
