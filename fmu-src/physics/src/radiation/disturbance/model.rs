//! A spacecraft and a planet prepared for evaluation.

use super::error::ModelError;
use super::faces::{Faces, Normal};
use super::planet_rule::{PlanetLightMethod, PlanetRule};
use crate::bodies::surface::PlanetSurface;
use crate::radiation::shadow::{Hinge, Outline, ShadowScene};
use crate::radiation::solar::SolarModel;
use crate::radiation::thermal::transient::HeatStore;
use crate::spacecraft::{Emission, Panel, Spacecraft, SunshadeModel};

/// What an evaluation takes into account.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The planet's surface; without it albedo and infrared are nothing.
    pub planet: Option<PlanetSurface>,
    /// How light of the planet is summed.
    pub planet_light: PlanetLightMethod,
    /// Whether surfaces with an outline shadow one another from the Sun.
    pub self_shadowing: bool,
    /// The sunshade's form, if not the one its file chooses.
    pub sunshade_model: Option<SunshadeModel>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            planet: None,
            planet_light: PlanetLightMethod::default(),
            self_shadowing: true,
            sunshade_model: None,
        }
    }
}

/// A spacecraft prepared for light and heat; whatever does not change is computed once.
#[derive(Clone, Debug)]
pub struct DisturbanceModel {
    pub(super) faces: Faces,
    pub(super) panels: Vec<Panel>,
    /// Sunlight on a cylindrical shade in closed form.
    pub(super) cylinder: Option<SolarModel>,
    pub(super) planet_light: PlanetRule,
    pub(super) planet: Option<PlanetSurface>,
    /// Present only where some surface can shadow another.
    pub(super) scene: Option<ShadowScene>,
}

impl DisturbanceModel {
    /// Prepares a spacecraft.
    ///
    /// # Errors
    /// An impossible planet surface, number of nodes or cells, or form of the sunshade.
    pub fn new(spacecraft: &Spacecraft, options: &Options) -> Result<Self, ModelError> {
        if let Some(planet) = &options.planet {
            planet.validate()?;
        }
        let form = options.sunshade_model.or(spacecraft.sunshade.as_ref().map(|shade| shade.model));
        let cylinder = match form {
            Some(SunshadeModel::Cylinder) => {
                Some(SolarModel::with_sunshade_model(spacecraft, SunshadeModel::Cylinder)?)
            }
            Some(SunshadeModel::Plates) => {
                SolarModel::with_sunshade_model(spacecraft, SunshadeModel::Plates)?;
                None
            }
            None => None,
        };
        let faces = Faces::new(spacecraft, form);
        let scene = options
            .self_shadowing
            .then(|| ShadowScene::new(outlines(&faces, spacecraft, form)))
            .filter(ShadowScene::has_pairs);
        Ok(Self {
            faces,
            panels: spacecraft.panels.clone(),
            cylinder,
            planet_light: PlanetRule::new(&options.planet_light)?,
            planet: options.planet,
            scene,
        })
    }

    /// Number of panels, hence of angles a geometry has.
    pub fn panel_count(&self) -> usize {
        self.panels.len()
    }

    /// Number of faces, hence of temperatures a thermal state has.
    pub fn face_count(&self) -> usize {
        self.faces.faces.len()
    }

    /// Names of the faces in their order: plates, sunshade, panels, the back of a surface after its front.
    pub fn face_names(&self) -> impl Iterator<Item = String> + '_ {
        self.faces.surfaces.iter().flat_map(|surface| {
            let rear = surface.two_sided.then(|| format!("{}, rear", surface.name));
            core::iter::once(surface.name.clone()).chain(rear)
        })
    }

    /// For every face the panel it belongs to, if to one.
    pub fn face_panels(&self) -> impl Iterator<Item = Option<usize>> + '_ {
        self.faces.faces.iter().map(|face| match self.faces.normals[face.normal] {
            Normal::Fixed(_) => None,
            Normal::Front(panel) | Normal::Rear(panel) => Some(panel),
        })
    }

    /// About how many microseconds an evaluation takes: Sun and heat on every face, the planet's light on it, and the search
    /// for shadows; cutting them out comes on top ([`super::Workspace::shadows_cut`]).
    pub fn evaluation_units(&self) -> u32 {
        let faces = self.face_count() as u32;
        let planet = if self.planet.is_some() { self.planet_light.evaluation_units(faces) } else { 0 };
        let shadows = self.scene.as_ref().map_or(0, |scene| scene.candidate_pairs() as u32 / 200);
        1 + faces / 8 + planet + shadows
    }

    /// What can shadow a face, or the other face of its surface where heat goes from one to the other: for each such
    /// surface the panel it is, if one.
    pub fn shadowers(&self, face: usize) -> Vec<Option<usize>> {
        let found = self.faces.faces.get(face).map(|found| &self.faces.surfaces[found.surface]);
        let Some((surface, scene, outline)) =
            found.and_then(|surface| Some((surface, self.scene.as_ref()?, surface.outline?)))
        else {
            return Vec::new();
        };
        let rear = face > surface.first_face;
        let other = surface.thermal.conduction.is_some().then(|| scene.before(outline, !rear));
        scene.before(outline, rear).chain(other.into_iter().flatten()).collect()
    }

    /// Whether a face's recoil can push along a body axis: its normal can have a part along it.
    pub fn recoils_along(&self, face: usize, axis: usize) -> bool {
        self.faces.faces.get(face).is_some_and(|face| match self.faces.normals[face.normal] {
            Normal::Fixed(normal) => normal[axis] != 0.0,
            Normal::Front(panel) | Normal::Rear(panel) => self.panels[panel].axis_body[axis].abs() < 1.0,
        })
    }

    /// Whether a face stores heat.
    pub fn face_stores_heat(&self, face: usize) -> bool {
        let surface = self.faces.faces.get(face).map(|face| &self.faces.surfaces[face.surface]);
        surface.is_some_and(|surface| surface.thermal.heat_capacity_j_m2_k > 0.0)
    }

    /// Area of a face in m2; 0 for a face there is not.
    pub fn face_area_m2(&self, face: usize) -> f64 {
        self.faces.faces.get(face).map_or(0.0, |face| self.faces.surfaces[face.surface].area_m2)
    }

    /// Whether any surface can shadow another at some direction of the Sun and angle of the panels.
    pub fn can_shadow(&self) -> bool {
        self.scene.is_some()
    }

    /// Whether any face stores heat, so that [`super::Recoil::Stored`] differs from balance.
    pub fn stores_heat(&self) -> bool {
        self.faces.surfaces.iter().any(|surface| surface.thermal.heat_capacity_j_m2_k > 0.0)
    }

    /// Temperatures of all faces `duration_s` later, in place.
    ///
    /// `heat_w` is what each face takes in ([`super::DisturbanceModel::heat_w`]) at the start and at the end; in between
    /// it runs along a straight line. Faces that store no heat are left as they are. Slices shorter than the number of
    /// faces leave the faces beyond alone.
    pub fn advance_temperatures(
        &self,
        temperatures_k: &mut [f64],
        start_heat_w: &[f64],
        end_heat_w: &[f64],
        duration_s: f64,
    ) {
        for surface in &self.faces.surfaces {
            if surface.thermal.heat_capacity_j_m2_k <= 0.0 {
                continue;
            }
            let first = surface.first_face;
            let count = if surface.two_sided { 2 } else { 1 };
            let pick = |values: &[f64], scale: f64| {
                let at = |side: usize| values.get(first + side).map_or(0.0, |value| value * scale);
                if count == 2 { [at(0), at(1)] } else { [at(0), 0.0] }
            };
            let rear = surface.thermal.rear.map_or(Emission::constant(0.0), |rear| rear.emission);
            let store = HeatStore {
                emission: [surface.thermal.front.emission, rear],
                conduction: surface.thermal.conduction,
                heat_capacity_j_m2_k: surface.thermal.heat_capacity_j_m2_k,
            };
            let per_area = 1.0 / surface.area_m2;
            let heat = [pick(start_heat_w, per_area), pick(end_heat_w, per_area)];
            let next = store.advance(pick(temperatures_k, 1.0), heat, duration_s);
            for (side, value) in next.into_iter().enumerate().take(count) {
                if let Some(temperature_k) = temperatures_k.get_mut(first + side) {
                    *temperature_k = value;
                }
            }
        }
    }
}

/// Outlines of plates and panels in the order of the faces' outlines.
fn outlines(faces: &Faces, spacecraft: &Spacecraft, form: Option<SunshadeModel>) -> Vec<Outline> {
    let plates = spacecraft.plates_body(form.unwrap_or(SunshadeModel::Plates));
    let fixed = plates.iter().filter_map(|plate| {
        let two_sided = plate.rear_optics.is_some();
        plate.polygon.as_ref().map(|polygon| Outline { polygon: polygon.clone(), hinge: None, two_sided })
    });
    let turning = spacecraft.panels.iter().enumerate().filter_map(|(index, panel)| {
        panel.polygon.as_ref().map(|polygon| Outline {
            polygon: polygon.clone(),
            two_sided: panel.rear_optics.is_some(),
            hinge: Some(Hinge {
                panel: index,
                point_body_m: panel.center_body_m,
                axis_body: panel.axis_body,
            }),
        })
    });
    let outlines: Vec<Outline> = fixed.chain(turning).collect();
    debug_assert_eq!(outlines.len(), faces.outlines.len());
    outlines
}
