//! Air on the spacecraft's surfaces.

use super::source::{Source, Workspace};
use crate::loads::{Effect, Loads};
use crate::plant::air_and_field::aerodynamic_solver::AerodynamicSolver;
use crate::plant::instant::conditions::Conditions;
use crate::plant::settings::configuration::Configuration;
use crate::spacecraft::Material;

/// Surfaces in air, where that acts.
#[derive(Clone, Debug, Default)]
pub(crate) struct AirLoads {
    /// Surfaces in air.
    pub solver: Option<AerodynamicSolver>,
}

impl Source for AirLoads {
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
        let Some((solver, flow)) = self.solver.as_mut().zip(at.flow) else { return };
        let sun = at.instant.sun_at(at.time_s);
        let (panels, center_of_mass) = (at.spacecraft.panels, &at.mass.center_of_mass_body_m);
        let temperatures_k = workspace.face_temperatures_k.as_slice();
        loads[Effect::Aerodynamic] =
            solver.load((configuration, panels), temperatures_k, &sun, &flow, center_of_mass);
    }

    fn load_units(&self) -> u32 {
        self.solver.as_ref().map_or(0, AerodynamicSolver::evaluation_units)
    }

    fn set_material(&mut self, index: usize, material: &Material) {
        if let Some(solver) = &mut self.solver {
            solver.set_material(index, material);
        }
    }
}
