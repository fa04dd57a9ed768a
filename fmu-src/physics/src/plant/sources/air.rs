//! Air on the spacecraft's surfaces.

use nalgebra::Vector3;

use super::source::{Source, Workspace};
use crate::aerodynamics::{AerodynamicModel, AerodynamicOptions, AerodynamicWorkspace, AirFlow, Walls};
use crate::loads::{Effect, ForceTorque, Loads};
use crate::plant::instant::conditions::Conditions;
use crate::plant::settings::configuration::Configuration;
use crate::plant::settings::panel_setting::SunAt;
use crate::refusal::Refusal;
use crate::spacecraft::{Material, Panel, Spacecraft};

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

    /// Force and torque about the centre of mass, panels at the angles of their settings; wall temperatures are these of all faces
    /// where they are known, else the materials'.
    fn load(
        &mut self,
        (configuration, panels): (&Configuration, &[Panel]),
        face_temperatures_k: &[f64],
        sun: &SunAt,
        flow: &AirFlow<f64>,
        center_of_mass_body_m: &Vector3<f64>,
    ) -> ForceTorque {
        configuration.panel_angles_rad(panels, &self.panels, sun, &mut self.panel_angles_rad);
        let is_known =
            !face_temperatures_k.is_empty() && face_temperatures_k.len() == self.model.face_count();
        let temperatures_k = is_known.then_some(face_temperatures_k);
        self.model.load(
            flow,
            &self.panel_angles_rad,
            center_of_mass_body_m,
            Walls { temperatures_k, ..Walls::OWN },
            &mut self.workspace,
        )
    }

    /// About how many microseconds an evaluation takes.
    fn evaluation_units(&self) -> u32 {
        self.model.evaluation_units()
    }
}

/// Surfaces in air, where that acts.
impl Source for Option<AerodynamicSolver> {
    const ROWS: &'static [Effect] = &[Effect::Aerodynamic];
    type Settings = Configuration;
    type State = ();

    fn settings(configuration: &Configuration) -> &Configuration {
        configuration
    }

    fn load(
        &mut self,
        configuration: &Configuration,
        (): &(),
        at: &Conditions<'_>,
        workspace: &mut Workspace,
        loads: &mut Loads,
    ) {
        let Some((solver, flow)) = self.as_mut().zip(at.flow) else { return };
        let sun = at.instant.sun_at(at.time_s);
        let (panels, center_of_mass) = (at.spacecraft.panels, &at.mass.center_of_mass_body_m);
        let temperatures_k = workspace.face_temperatures_k.as_slice();
        loads[Effect::Aerodynamic] =
            solver.load((configuration, panels), temperatures_k, &sun, &flow, center_of_mass);
    }

    fn load_units(&self) -> u32 {
        self.as_ref().map_or(0, AerodynamicSolver::evaluation_units)
    }

    fn set_material(&mut self, index: usize, material: &Material) {
        if let Some(solver) = self {
            solver.model.set_material(index, material);
        }
    }
}
