//! Light and heat beyond plain sunlight, as the plant meets them: planet light, recoil, shadows of its own surfaces.

use nalgebra::Vector3;

use crate::bodies::surface::PlanetSurface;
use crate::constants::SPEED_OF_LIGHT_M_S;
use crate::radiation::disturbance::{
    self, Disturbance, DisturbanceModel, GeometryError, ModelError, Options, PlanetGeometry,
    PlanetLightMethod, Recoil, Workspace,
};
use crate::spacecraft::Spacecraft;

use super::configuration::{Configuration, PanelSetting};
use super::evaluation::{ExternalLoad, Plant};
use super::radiation_segment::NODES;
use super::stored_heat::HeatRule;

/// Which of light's and heat's effects act, and how finely they are resolved in time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadiationSettings {
    /// Light of the planet: albedo and infrared.
    pub planet_light: bool,
    /// Recoil of the heat the spacecraft radiates.
    pub recoil: bool,
    /// Whether surfaces with a heat capacity store heat; otherwise all are in balance with their light.
    pub storage: bool,
    /// Whether surfaces given as polygons shadow one another from the Sun.
    pub shadowing: bool,
    /// Segments of light and heat end at multiples of this, in s.
    pub grid_s: f64,
    /// Largest last Chebyshev term of a segment relative to the largest force and torque in it.
    pub tolerance: f64,
}

impl RadiationSettings {
    /// Direct sunlight alone, unshadowed.
    pub const OFF: Self = Self {
        planet_light: false,
        recoil: false,
        storage: false,
        shadowing: false,
        grid_s: 600.0,
        tolerance: 1e-5,
    };

    /// Whether there is anything beyond direct sunlight.
    pub fn any(&self) -> bool {
        self.planet_light || self.recoil || self.shadowing
    }
}

/// The spacecraft and the planet's surface prepared for light and heat, with the scratch space of a flight. All of it
/// follows from the setup and the configuration: cache, not state.
#[derive(Clone, Debug)]
pub struct RadiationSolver {
    pub(super) model: DisturbanceModel,
    /// Place among all panels of those that take part.
    pub(super) panels: Vec<usize>,
    pub(super) nodes: Vec<RadiationNode>,
    pub(super) heat_rule: HeatRule,
}

/// One time at which light and heat are computed.
#[derive(Clone, Debug)]
pub(super) struct RadiationNode {
    viewing: ViewingGeometry,
    pub found: Disturbance<f64>,
    pub workspace: Workspace<f64>,
    pub heat_w: Vec<f64>,
    pub temperatures_k: Vec<f64>,
}

/// Sun and planet from the spacecraft, and how it stands.
#[derive(Clone, Debug)]
struct ViewingGeometry {
    sun_direction_body: Vector3<f64>,
    sun_flux_w_m2: f64,
    lit_fraction: f64,
    planet: Option<PlanetGeometry<f64>>,
    panel_angles_rad: Vec<f64>,
    center_of_mass_body_m: Vector3<f64>,
}

impl RadiationSolver {
    /// Prepares `spacecraft` without the panels the configuration leaves out; `planet` is the surface it flies over.
    ///
    /// # Errors
    /// An impossible planet surface, number of nodes or form of the sunshade.
    pub fn new(
        spacecraft: &Spacecraft,
        configuration: &Configuration,
        planet: &PlanetSurface,
        quadrature_nodes: usize,
    ) -> Result<Self, ModelError> {
        let takes_part = |index: &usize| configuration.panels.get(*index) != Some(&PanelSetting::Disabled);
        let panels: Vec<usize> = (0..spacecraft.panels.len()).filter(takes_part).collect();
        let mut flown = spacecraft.clone();
        flown.panels = panels.iter().map(|&index| spacecraft.panels[index].clone()).collect();
        let effects = &configuration.light_and_heat;
        let over_planet = effects.planet_light && configuration.center.is_planet();
        let options = Options {
            planet: over_planet.then_some(*planet),
            planet_light: PlanetLightMethod::Rings(quadrature_nodes),
            self_shadowing: effects.shadowing,
            sunshade_model: spacecraft.sunshade.as_ref().map(|_| configuration.sunshade),
        };
        let model = DisturbanceModel::new(&flown, &options)?;
        let node = RadiationNode::new(panels.len(), model.face_count());
        Ok(Self { nodes: vec![node; NODES], heat_rule: HeatRule::new(), panels, model })
    }

    /// Number of faces: those of plates, sunshade and the panels that take part, in this order.
    pub fn face_count(&self) -> usize {
        self.model.face_count()
    }

    /// About how many microseconds a segment of light and heat takes.
    pub(super) fn segment_units(&self, stores: bool) -> u32 {
        let heat = if stores { self.face_count() as u32 } else { 0 };
        NODES as u32 * self.model.evaluation_units() + heat
    }
}

impl RadiationNode {
    fn new(panels: usize, faces: usize) -> Self {
        Self {
            viewing: ViewingGeometry {
                sun_direction_body: Vector3::zeros(),
                sun_flux_w_m2: 0.0,
                lit_fraction: 1.0,
                planet: None,
                panel_angles_rad: vec![0.0; panels],
                center_of_mass_body_m: Vector3::zeros(),
            },
            found: Disturbance::zero(),
            workspace: Workspace::default(),
            heat_w: vec![0.0; faces],
            temperatures_k: vec![0.0; faces],
        }
    }

    /// Computes light and heat, every surface in balance with its light.
    pub fn balance(&mut self, model: &DisturbanceModel) -> Result<(), GeometryError> {
        self.found = model.evaluate(&self.viewing.geometry(), Recoil::Balance, &mut self.workspace)?;
        model.heat_w(&self.workspace, &mut self.heat_w);
        Ok(())
    }

    /// After [`RadiationNode::balance`]: the recoil anew, at this node's stored temperatures.
    pub fn radiate_stored(&mut self, model: &DisturbanceModel) -> Result<(), GeometryError> {
        let stored = Recoil::Stored(&self.temperatures_k);
        self.found.thermal = model.recoil(&self.viewing.geometry(), stored, &mut self.workspace)?;
        Ok(())
    }
}

impl ViewingGeometry {
    fn geometry(&self) -> disturbance::Geometry<'_, f64> {
        disturbance::Geometry {
            sun_direction_body: self.sun_direction_body,
            sun_flux_w_m2: self.sun_flux_w_m2,
            lit_fraction: self.lit_fraction,
            planet: self.planet,
            panel_angles_rad: &self.panel_angles_rad,
            center_of_mass_body_m: self.center_of_mass_body_m,
        }
    }
}

impl<L: Fn(f64) -> ExternalLoad> Plant<'_, L> {
    /// Turns everything at `time_s` into the body frame for `node`.
    pub(super) fn view(&mut self, time_s: f64, light_panels: &[usize], node: &mut RadiationNode) {
        let configuration = self.configuration;
        let instant = self.instant(time_s);
        let viewing = &mut node.viewing;
        viewing.sun_direction_body = instant.sun_body;
        let flux_w_m2 = |distance_m: f64| configuration.light.pressure_pa(distance_m) * SPEED_OF_LIGHT_M_S;
        viewing.sun_flux_w_m2 = flux_w_m2(instant.sun_distance_m);
        // Inside the planet there is no fraction; what is wrong there is the place.
        viewing.lit_fraction = if instant.lit_fraction.is_nan() { 0.0 } else { instant.lit_fraction };
        viewing.center_of_mass_body_m = configuration.center_of_mass_body_m;
        viewing.planet = instant.planet_body_m.map(|position_body_m| {
            let sun_from_planet_body_m = instant.sun_position_body_m() - position_body_m;
            let sun_flux_w_m2 = flux_w_m2(sun_from_planet_body_m.norm());
            PlanetGeometry {
                position_body_m,
                sun_from_planet_body_m,
                sun_flux_w_m2,
                pole_body: -Vector3::z(),
            }
        });
        for (angle_rad, &index) in viewing.panel_angles_rad.iter_mut().zip(light_panels) {
            let setting = configuration.panels.get(index).zip(self.prepared.panels.get(index));
            *angle_rad = setting
                .and_then(|(setting, panel)| setting.angle_rad(panel, &viewing.sun_direction_body))
                .unwrap_or(0.0);
        }
    }
}
