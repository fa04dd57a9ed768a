//! Node of a radiation segment: geometry, light and heat at one time.

use nalgebra::Vector3;

use crate::loads::{Effect, Loads};
use crate::radiation::disturbance::{self, DisturbanceModel, PlanetGeometry, Recoil, Workspace};
use crate::refusal::Refusal;

/// One time at which light and heat are computed.
#[derive(Clone, Debug)]
pub(crate) struct RadiationNode {
    pub viewing: ViewingGeometry,
    pub found: Loads,
    pub workspace: Workspace<f64>,
    pub heat_w: Vec<f64>,
    pub temperatures_k: Vec<f64>,
}

/// Sun and planet from the spacecraft, and how it stands.
#[derive(Clone, Debug)]
pub(crate) struct ViewingGeometry {
    pub sun_direction_body: Vector3<f64>,
    pub sun_sine: f64,
    pub sun_flux_w_m2: f64,
    pub solar_scale: f64,
    pub lit_fraction: f64,
    pub planet: Option<PlanetGeometry<f64>>,
    pub panel_angles_rad: Vec<f64>,
    pub center_of_mass_body_m: Vector3<f64>,
}

impl RadiationNode {
    pub(crate) fn new(panels: usize, faces: usize) -> Self {
        Self {
            viewing: ViewingGeometry {
                sun_direction_body: Vector3::zeros(),
                sun_sine: 0.0,
                sun_flux_w_m2: 0.0,
                solar_scale: 1.0,
                lit_fraction: 1.0,
                planet: None,
                panel_angles_rad: vec![0.0; panels],
                center_of_mass_body_m: Vector3::zeros(),
            },
            found: Loads::zero(),
            workspace: Workspace::default(),
            heat_w: vec![0.0; faces],
            temperatures_k: vec![0.0; faces],
        }
    }

    /// Computes light and heat, every surface in balance with its light.
    pub(crate) fn balance(&mut self, model: &DisturbanceModel) -> Result<(), Refusal> {
        self.found = model.evaluate(&self.viewing.geometry(), Recoil::Balance, &mut self.workspace)?;
        model.heat_w(&self.workspace, &mut self.heat_w);
        Ok(())
    }

    /// After [`RadiationNode::balance`]: every surface has the temperature of balance.
    pub(crate) fn take_balance(&mut self) {
        for (kelvin, face) in self.temperatures_k.iter_mut().zip(self.workspace.faces()) {
            *kelvin = face.temperature_k;
        }
    }

    /// After [`RadiationNode::balance`]: the recoil anew, at this node's stored temperatures.
    pub(crate) fn radiate_stored(&mut self, model: &DisturbanceModel) -> Result<(), Refusal> {
        let stored = Recoil::Stored(&self.temperatures_k);
        self.found[Effect::Thermal] = model.recoil(&self.viewing.geometry(), stored, &mut self.workspace)?;
        Ok(())
    }
}

impl ViewingGeometry {
    fn geometry(&self) -> disturbance::Geometry<'_, f64> {
        disturbance::Geometry {
            sun_direction_body: self.sun_direction_body,
            sun_sine: self.sun_sine,
            sun_flux_w_m2: self.sun_flux_w_m2,
            solar_scale: self.solar_scale,
            lit_fraction: self.lit_fraction,
            planet: self.planet,
            panel_angles_rad: &self.panel_angles_rad,
            center_of_mass_body_m: self.center_of_mass_body_m,
        }
    }
}
