//! Context of a simulation: everything beside its state and the spacecraft.

use crate::environment::ephemeris::Ephemeris;
use crate::plant::settings::configuration::Configuration;
use crate::plant::settings::prepared_spacecraft::PreparedSpacecraft;
use crate::plant::settings::work::Work;
use crate::plant::sources::Sources;
use crate::plant::state::propagator_state::PropagatorState;
use crate::plant::thrusters::allocation::ThrusterAllocator;
use crate::radiation::SolarModel;
use crate::spacecraft::{MassProperties, Material};

/// Configuration, environment and work limit of a simulation: everything beside its state.
#[derive(Clone, Debug)]
pub struct SimulationContext {
    /// Spacecraft and orbit; the attitude is set during the simulation.
    pub configuration: Configuration,
    /// Mass properties with every panel at angle 0 and the propellant left.
    pub current_mass_panels_stowed: MassProperties,
    /// Planets.
    pub ephemeris: Ephemeris,
    /// The spacecraft in sunlight, where its materials can be set; else as it was prepared.
    pub solar: Option<SolarModel>,
    /// Sources of loads.
    pub sources: Sources,
    /// Settings of thrusters and tanks, and the last selections among them.
    pub allocator: ThrusterAllocator,
    /// Work of the step so far.
    pub work: Work,
    /// Scratch states of forks, reused without allocation.
    pub fork_scratch: [PropagatorState; 3],
}

impl SimulationContext {
    /// Context of this configuration with full tanks, without light and heat beyond direct sunlight.
    pub fn new(configuration: Configuration) -> Self {
        Self {
            current_mass_panels_stowed: configuration.wet_mass_properties(),
            configuration,
            ephemeris: Ephemeris::default(),
            solar: None,
            sources: Sources::default(),
            allocator: ThrusterAllocator::default(),
            work: Work::new(u32::MAX, 0),
            fork_scratch: Default::default(),
        }
    }

    /// The spacecraft in sunlight as it is here.
    pub(crate) fn in_sunlight<'c>(&'c self, prepared: PreparedSpacecraft<'c>) -> PreparedSpacecraft<'c> {
        PreparedSpacecraft { solar: self.solar.as_ref().unwrap_or(prepared.solar), ..prepared }
    }

    /// Sets the material with this index where it differs from the present one; allocates nothing.
    pub fn set_material(&mut self, place: usize, material: &Material) {
        let Self { solar, sources, .. } = self;
        let Some(solar) = solar.as_mut().filter(|it| it.materials().get(place) != Some(material)) else {
            return;
        };
        solar.set_material(place, material);
        sources.set_material(place, material);
    }

    /// A step begins: nothing spent of `limit` units of about a microsecond.
    pub fn begin_work(&mut self, limit: u32) {
        self.ephemeris.count_from_here();
        self.work = Work::new(limit, self.ephemeris.evaluations());
    }
}
