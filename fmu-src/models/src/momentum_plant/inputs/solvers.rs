//! Surfaces in air and in the light of Sun and planet, from parameters; refuses what cannot be simulated, by name.

use fmi_export::Failure;
use physics::bodies::surface::PlanetSurface;
use physics::loads::Switch;
use physics::plant::{AerodynamicSolver, Configuration, RadiationSolver};

use crate::momentum_plant::setup::Read;

/// Surfaces in air; `None` where that does not act.
pub(super) fn air(
    read: Read<'_>,
    configuration: &Configuration,
) -> Result<Option<AerodynamicSolver>, Failure> {
    let spacecraft = &read.setup.spacecraft;
    if !configuration.effects.is_on(Switch::Aerodynamics) {
        return Ok(None);
    }
    let options =
        read.variables.laws.aerodynamics.options(read.values, spacecraft, configuration.sunshade)?;
    let solver = AerodynamicSolver::new(spacecraft, configuration, &options);
    solver.map(Some).map_err(|error| Failure::new(format!("aerodynamics.*, sunshade.shape: {error}")))
}

/// Solver of planet light, heat and loads per plate; `None` if direct sunlight alone acts.
pub(super) fn light(
    read: Read<'_>,
    configuration: &Configuration,
    surface: &PlanetSurface,
) -> Result<Option<RadiationSolver>, Failure> {
    let variables = read.variables;
    if !configuration.has_light_and_heat() && variables.plate.is_empty() {
        return Ok(None);
    }
    let nodes = usize::try_from(read.values.integer(variables.planet_light.nodes)).unwrap_or(0);
    let spacecraft = &read.setup.spacecraft;
    let requested = spacecraft.sunshade.as_ref().map_or(configuration.sunshade, |shade| shade.model);
    if !variables.plate.is_empty() && requested != configuration.sunshade {
        return Err(Failure::new(
            "sunshade.shape: found another than the spacecraft file's, allowed: the file's, whose faces plate[k] are",
        ));
    }
    RadiationSolver::new(spacecraft, configuration, surface, nodes)
        .map(Some)
        .map_err(|error| Failure::new(format!("planet.*, planetLight.nodes, sunshade.shape: {error}")))
}
