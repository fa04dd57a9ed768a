//! Aerodynamic model of a spacecraft: force and torque from the flow.

use nalgebra::Vector3;

use super::flow::{AirFlow, IncidentFlow};
use super::law::{AerodynamicLaw, LawAtFlow, Reemission};
use crate::loads::ForceTorque;
use crate::numerics::scalar::{Scalar, constant_vector, scratch};
use crate::radiation::faces::Faces;
use crate::radiation::shadow::{ShadowScene, ShadowWorkspace};
use crate::refusal::Refusal;
use crate::spacecraft::{Material, Spacecraft, SunshadeModel};

/// Laws and effects of an evaluation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AerodynamicOptions {
    /// Law of the force on a face.
    pub law: AerodynamicLaw,
    /// Temperature of the incident energy in the law sentman.
    pub reemission: Reemission,
    /// Whether surfaces with an outline shadow one another from the flow.
    pub shadowing: bool,
    /// The sunshade's form, if not the one its file chooses.
    pub sunshade_model: Option<SunshadeModel>,
}

impl Default for AerodynamicOptions {
    fn default() -> Self {
        Self {
            law: AerodynamicLaw::Sentman,
            reemission: Reemission::Effusive,
            shadowing: true,
            sunshade_model: None,
        }
    }
}

/// Aerodynamic model of a spacecraft, with everything constant computed once.
#[derive(Clone, Debug)]
pub struct AerodynamicModel {
    faces: Faces,
    options: AerodynamicOptions,
    /// Present only where some surface can shadow another.
    scene: Option<ShadowScene>,
}

scratch! {
/// Scratch space of [`AerodynamicModel::load`]. Starts empty; the first evaluation sizes it, later ones do not allocate unless
/// surfaces shadow one another.
pub struct AerodynamicWorkspace<T: Scalar> {
    normals: Vec<Vector3<T>>,
    incident: Vec<IncidentFlow<T>>,
    shadow: ShadowWorkspace<T>,
}
}

impl<T: Scalar> AerodynamicWorkspace<T> {
    /// How many shadows of one outline on another the last evaluation cut out, about a microsecond each.
    pub fn shadows_cut(&self) -> usize {
        self.shadow.clipped_pairs()
    }
}

/// Faces in the flow as something else says: their temperatures and materials.
#[derive(Clone, Copy, Debug)]
pub struct Walls<'a, T: Scalar> {
    /// Temperature of every face, in K, in the order of [`crate::radiation::disturbance::DisturbanceModel::face_names`]; where there
    /// is none, the material's.
    pub temperatures_k: Option<&'a [T]>,
    /// Materials in the order of [`crate::radiation::disturbance::DisturbanceModel::materials`]; where there is none, the model's.
    pub materials: Option<&'a [Material<T>]>,
}

impl<T: Scalar> Walls<'_, T> {
    /// As the model has them.
    pub const OWN: Self = Self { temperatures_k: None, materials: None };
}

impl AerodynamicModel {
    /// Prepares a spacecraft. A cylindrical sunshade is cut into the strips that planet light and heat have.
    ///
    /// # Errors
    /// The file has a sunshade but not in this form.
    pub fn new(spacecraft: &Spacecraft, options: &AerodynamicOptions) -> Result<Self, Refusal> {
        let mut faces = Faces::new(spacecraft, options.sunshade_model)?;
        let scene = if options.shadowing { faces.extract_scene() } else { None };
        Ok(Self { faces, options: *options, scene })
    }

    /// Sets the material in this place of the spacecraft's.
    pub fn set_material(&mut self, place: usize, material: &Material) {
        self.faces.set_material(place, material);
    }

    /// Number of faces, in the order of [`crate::radiation::disturbance::DisturbanceModel::face_names`].
    pub fn face_count(&self) -> usize {
        self.faces.faces.len()
    }

    /// About how many microseconds an evaluation takes; cutting out shadows comes on top
    /// ([`AerodynamicWorkspace::shadows_cut`]).
    pub fn evaluation_units(&self) -> u32 {
        let search = self.scene.as_ref().map_or(0, |scene| scene.candidate_pairs() as u32 / 200);
        1 + self.face_count() as u32 / 8 + search
    }

    /// Force, and torque about the centre of mass (body frame, m), of this flow with the panels at these angles (from 0 about
    /// their axes, in rad; 0 for one that is not given) and the faces like that.
    pub fn load<T: Scalar>(
        &self,
        flow: &AirFlow<T>,
        panel_angles_rad: &[T],
        center_of_mass_body_m: &Vector3<T>,
        walls: Walls<'_, T>,
        workspace: &mut AerodynamicWorkspace<T>,
    ) -> ForceTorque<T> {
        // A vacuum, the density's derivative included.
        if flow.density_kg_m3.same(T::constant(0.0)) {
            return ForceTorque::zero();
        }
        let law = LawAtFlow::new(self.options.law, self.options.reemission, flow);
        workspace.normals.resize(self.faces.normals.len(), Vector3::zeros());
        self.faces.turn_normals(panel_angles_rad, &mut workspace.normals);
        workspace.incident.clear();
        let speeds_m_s = workspace.normals.iter().map(|normal| normal.dot(&flow.velocity_body_m_s));
        workspace.incident.extend(speeds_m_s.map(|normal_m_s| law.incident(normal_m_s)));
        let upstream = self.scene.as_ref().zip(flow.upstream());
        let has_shadows = upstream.is_some();
        if let Some((scene, upstream)) = upstream {
            scene.evaluate(&upstream, panel_angles_rad, &mut workspace.shadow);
        }

        let mut sum = ForceTorque::zero();
        for (index, face) in self.faces.faces.iter().enumerate() {
            let surface = &self.faces.surfaces[face.surface];
            let normal = &workspace.normals[face.normal];
            let given = walls.materials.and_then(|all| all.get(face.material));
            let own = || self.faces.materials[face.material].gas_surface.map(T::constant);
            let gas_surface = given.map_or_else(own, |material| material.gas_surface);
            let given_k = walls.temperatures_k.and_then(|all| all.get(index).copied());
            let wall_k = given_k.unwrap_or(gas_surface.wall_temperature_k);
            let pressure =
                |incident: &IncidentFlow<T>| law.force_per_area_pa(&gas_surface, wall_k, normal, incident);
            let whole_m2 = T::constant(surface.area_m2);
            let center_m = constant_vector::<T>(&surface.center_body_m);
            let open_pa = pressure(&workspace.incident[face.normal]);
            let normal_m_s = normal.dot(&flow.velocity_body_m_s);
            let outline = surface.outline.filter(|_| has_shadows && normal_m_s.value() > 0.0);
            let Some((open_m2, open_center_m)) = outline.and_then(|o| workspace.shadow.lit(o)) else {
                sum += ForceTorque::at_arm(&center_m, open_pa * whole_m2);
                continue;
            };
            // The shadowed part has the incident flux of a face at the opposite angle to the flow: of thermal motion alone. It
            // vanishes at normal incidence and is continuous with the open part's at grazing incidence.
            let shadowed_pa = pressure(&law.incident(-normal_m_s));
            let open_moment = open_center_m * open_m2;
            let shadowed_moment = center_m * whole_m2 - open_moment;
            sum += ForceTorque {
                force_body_n: open_pa * open_m2 + shadowed_pa * (whole_m2 - open_m2),
                torque_body_n_m: open_moment.cross(&open_pa) + shadowed_moment.cross(&shadowed_pa),
            };
        }
        sum.about(center_of_mass_body_m)
    }
}
