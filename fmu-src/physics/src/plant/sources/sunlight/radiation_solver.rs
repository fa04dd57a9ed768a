//! Radiation solver of the plant: the spacecraft and the planet prepared for light and heat, with the nodes of a segment.

use crate::bodies::surface::PlanetSurface;
use crate::loads::Effect;
use crate::radiation::disturbance::{DisturbanceModel, Options, PlanetLightMethod};
use crate::refusal::Refusal;
use crate::spacecraft::Spacecraft;

use super::radiation_node::RadiationNode;
use super::radiation_segment::NODES;
use super::stored_heat::HeatRule;
use crate::plant::settings::configuration::Configuration;

/// The spacecraft and the planet's surface prepared for light and heat, with the scratch space of a flight. All of it
/// follows from the setup and the configuration: cache, not state.
#[derive(Clone, Debug)]
pub struct RadiationSolver {
    pub(crate) model: DisturbanceModel,
    /// Place among all panels of those that take part.
    pub(crate) panels: Vec<usize>,
    pub(crate) nodes: Vec<RadiationNode>,
    pub(crate) heat_rule: HeatRule,
}

impl RadiationSolver {
    /// Prepares `spacecraft` without the panels the configuration leaves out; `planet` is the surface below it.
    ///
    /// # Errors
    /// An impossible planet surface, number of nodes or form of the sunshade.
    pub fn new(
        spacecraft: &Spacecraft,
        configuration: &Configuration,
        planet: &PlanetSurface,
        quadrature_nodes: usize,
    ) -> Result<Self, Refusal> {
        let (panels, simulated) = configuration.enabled_panels(spacecraft);
        let effects = &configuration.light_and_heat;
        let over_planet = configuration.effects.has(Effect::Albedo) && configuration.planet().is_some();
        let options = Options {
            planet: over_planet.then_some(*planet),
            planet_light: PlanetLightMethod::Rings(quadrature_nodes),
            self_shadowing: effects.shadowing,
            sun_disc: effects.sun_disc,
            sunshade_model: spacecraft.sunshade.as_ref().map(|_| configuration.sunshade),
        };
        let model = DisturbanceModel::new(&simulated, &options)?;
        let node = RadiationNode::new(panels.len(), model.face_count());
        Ok(Self { nodes: vec![node; NODES], heat_rule: HeatRule::new(), panels, model })
    }

    /// About how many microseconds a segment of light and heat takes.
    pub(crate) fn segment_units(&self, stores: bool) -> u32 {
        let heat = if stores { self.model.face_count() as u32 } else { 0 };
        NODES as u32 * self.model.evaluation_units() + heat
    }
}
