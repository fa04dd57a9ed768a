//! Node of a radiation segment: geometry, light and heat at one time.

use nalgebra::Vector3;

use crate::loads::{Effect, Loads};
use crate::radiation::disturbance::{DisturbanceModel, Geometry, Recoil, Workspace};
use crate::refusal::Refusal;

/// One time at which light and heat are computed.
#[derive(Clone, Debug)]
pub(crate) struct RadiationNode {
    /// Sun and planet from the spacecraft, without its panels.
    pub viewing: Geometry<'static, f64>,
    pub panel_angles_rad: Vec<f64>,
    pub found: Loads,
    pub workspace: Workspace<f64>,
    pub heat_w: Vec<f64>,
    pub temperatures_k: Vec<f64>,
}

impl RadiationNode {
    pub(crate) fn new(panels: usize, faces: usize) -> Self {
        Self {
            viewing: Geometry::sunlit(Vector3::zeros(), 0.0),
            panel_angles_rad: vec![0.0; panels],
            found: Loads::zero(),
            workspace: Workspace::default(),
            heat_w: vec![0.0; faces],
            temperatures_k: vec![0.0; faces],
        }
    }

    /// Computes light and heat, every surface in balance with its light.
    pub(crate) fn balance(&mut self, model: &DisturbanceModel) -> Result<(), Refusal> {
        let geometry = Geometry { panel_angles_rad: &self.panel_angles_rad, ..self.viewing };
        self.found = model.evaluate(&geometry, Recoil::Balance, &mut self.workspace)?;
        model.heat_w(&self.workspace, &mut self.heat_w);
        Ok(())
    }

    /// After [`RadiationNode::balance`]: every surface has the temperature of balance.
    pub(crate) fn store_balance(&mut self) {
        for (kelvin, face) in self.temperatures_k.iter_mut().zip(self.workspace.faces()) {
            *kelvin = face.temperature_k;
        }
    }

    /// After [`RadiationNode::balance`]: the recoil anew, at this node's stored temperatures.
    pub(crate) fn radiate_stored(&mut self, model: &DisturbanceModel) -> Result<(), Refusal> {
        let stored = Recoil::Stored(&self.temperatures_k);
        let geometry = Geometry { panel_angles_rad: &self.panel_angles_rad, ..self.viewing };
        self.found[Effect::Thermal] = model.recoil(&geometry, stored, &mut self.workspace)?;
        Ok(())
    }
}
