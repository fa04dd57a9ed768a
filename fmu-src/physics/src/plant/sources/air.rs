//! Air on the spacecraft's surfaces.

use super::source::{Results, Source};
use crate::aerodynamics::{AerodynamicModel, AerodynamicOptions, AerodynamicWorkspace, Walls};
use crate::loads::Effect;
use crate::plant::instant::conditions::Conditions;
use crate::plant::settings::configuration::Configuration;
use crate::refusal::Refusal;
use crate::spacecraft::{Material, Spacecraft};

/// Aerodynamic model and workspace. All of it follows from setup and configuration: a cache, not state.
#[derive(Clone, Debug)]
pub struct AerodynamicSolver {
    model: AerodynamicModel,
    /// Indices of the enabled panels among all.
    panels: Vec<usize>,
    panel_angles_rad: Vec<f64>,
    workspace: AerodynamicWorkspace<f64>,
}

impl AerodynamicSolver {
    /// Prepares `spacecraft` without the panels the configuration leaves out.
    ///
    /// # Errors
    /// An impossible form of the sunshade.
    pub fn new(
        spacecraft: &Spacecraft,
        configuration: &Configuration,
        options: &AerodynamicOptions,
    ) -> Result<Self, Refusal> {
        let (panels, simulated) = configuration.enabled_panels(spacecraft);
        let model = AerodynamicModel::new(&simulated, options)?;
        Ok(Self {
            panel_angles_rad: vec![0.0; panels.len()],
            workspace: AerodynamicWorkspace::default(),
            panels,
            model,
        })
    }
}

/// Surfaces in air, where that acts.
impl Source for Option<AerodynamicSolver> {
    const ROWS: &'static [Effect] = &[Effect::Aerodynamic];
    type Settings = Configuration;
    type State = ();

    fn load(
        &mut self,
        configuration: &Configuration,
        (): &(),
        at: &Conditions<'_>,
        results: &mut Results<'_>,
    ) {
        let Some((solver, flow)) = self.as_mut().zip(at.flow) else { return };
        let AerodynamicSolver { model, panels, panel_angles_rad, workspace } = solver;
        let sun = &at.instant.sun();
        configuration.panel_angles_rad(at.kinematics.spacecraft.panels, panels, sun, panel_angles_rad);
        // Temperatures of the faces where they are known, else the materials'.
        let temperatures_k = Some(results.face_temperatures_k.as_slice());
        let temperatures_k = temperatures_k.filter(|it| !it.is_empty() && it.len() == model.face_count());
        let walls = Walls { temperatures_k, ..Walls::OWN };
        let center_of_mass_body_m = &at.mass.center_of_mass_body_m;
        results.loads[Effect::Aerodynamic] =
            model.load(&flow, panel_angles_rad, center_of_mass_body_m, walls, workspace);
    }

    fn load_units(&self) -> u32 {
        self.as_ref().map_or(0, |solver| solver.model.evaluation_units())
    }

    fn set_material(&mut self, index: usize, material: &Material) {
        if let Some(solver) = self {
            solver.model.set_material(index, material);
        }
    }
}
