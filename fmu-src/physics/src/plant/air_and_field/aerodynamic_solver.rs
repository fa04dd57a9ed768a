//! Aerodynamic solver of the plant: the aerodynamic model with its workspace.

use nalgebra::Vector3;

use crate::aerodynamics::{AerodynamicModel, AerodynamicOptions, AerodynamicWorkspace, AirFlow, Walls};
use crate::loads::ForceTorque;
use crate::plant::light::radiation_segment::RadiationSegment;
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
    wall_temperatures_k: Vec<f64>,
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
            wall_temperatures_k: vec![0.0; model.face_count()],
            workspace: AerodynamicWorkspace::default(),
            panels,
            model,
        })
    }

    /// Force and torque about the centre of mass, panels at the angles of their settings; wall temperatures are those of `light`
    /// where it has them, else the materials'.
    pub(crate) fn load(
        &mut self,
        (configuration, panels): (&Configuration, &[Panel]),
        light: Option<(&RadiationSegment, f64)>,
        sun: &SunAt,
        flow: &AirFlow<f64>,
        center_of_mass_body_m: &Vector3<f64>,
    ) -> ForceTorque {
        configuration.panel_angles_rad(panels, &self.panels, sun, &mut self.panel_angles_rad);
        let is_known = light.is_some_and(|(segment, time_s)| {
            segment.wall_temperatures_at(time_s, &mut self.wall_temperatures_k)
        });
        let temperatures_k = is_known.then_some(self.wall_temperatures_k.as_slice());
        self.model.load(
            flow,
            &self.panel_angles_rad,
            center_of_mass_body_m,
            Walls { temperatures_k, ..Walls::OWN },
            &mut self.workspace,
        )
    }

    /// Sets the material in this place of the spacecraft's.
    pub(crate) fn set_material(&mut self, place: usize, material: &Material) {
        self.model.set_material(place, material);
    }

    /// About how many microseconds an evaluation takes.
    pub(crate) fn evaluation_units(&self) -> u32 {
        self.model.evaluation_units()
    }
}
