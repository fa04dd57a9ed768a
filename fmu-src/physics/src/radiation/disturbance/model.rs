//! A spacecraft and a planet prepared for evaluation; from geometry to force and torque.

use nalgebra::Vector3;

use super::face_loads::FaceLoads;
use super::geometry::{Geometry, Recoil};
use super::planet_rule::{PlanetLightMethod, PlanetRule};
use super::workspace::Workspace;
use crate::bodies::surface::PlanetSurface;
use crate::loads::{Effect, ForceTorque, Loads};
use crate::numerics::scalar::Scalar;
use crate::radiation::faces::{Faces, Normal};
use crate::radiation::flat_plate::Beam;
use crate::radiation::planet_light::PlanetLight;
use crate::radiation::shadow::{DIRECTIONS, ShadowScene, SunDisc};
use crate::refusal::Refusal;
use crate::spacecraft::{Material, Spacecraft, SunshadeModel};

/// Effects and methods of an evaluation.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The planet's surface; without it albedo and infrared are nothing.
    pub planet: Option<PlanetSurface>,
    /// How light of the planet is summed.
    pub planet_light: PlanetLightMethod,
    /// Whether surfaces with an outline shadow one another from the Sun.
    pub self_shadowing: bool,
    /// Whether those shadows are softened by the Sun's disc; otherwise the Sun is a point.
    pub sun_disc: bool,
    /// The sunshade's form, if not the one its file chooses.
    pub sunshade_model: Option<SunshadeModel>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            planet: None,
            planet_light: PlanetLightMethod::default(),
            self_shadowing: true,
            sun_disc: false,
            sunshade_model: None,
        }
    }
}

/// A spacecraft prepared for light and heat; whatever does not change is computed once.
#[derive(Clone, Debug)]
pub struct DisturbanceModel {
    faces: Faces,
    planet_light: PlanetRule,
    planet: Option<PlanetSurface>,
    /// Present only where some surface can shadow another.
    scene: Option<ShadowScene>,
    sun_disc: bool,
}

impl DisturbanceModel {
    /// Prepares a spacecraft.
    ///
    /// # Errors
    /// An impossible planet surface, number of nodes or cells, or form of the sunshade.
    pub fn new(spacecraft: &Spacecraft, options: &Options) -> Result<Self, Refusal> {
        if let Some(planet) = &options.planet {
            planet.validate()?;
        }
        let mut faces = Faces::new(spacecraft, options.sunshade_model)?;
        let scene = if options.self_shadowing { faces.extract_scene() } else { None };
        Ok(Self {
            faces,
            planet_light: PlanetRule::new(&options.planet_light)?,
            planet: options.planet,
            scene,
            sun_disc: options.sun_disc,
        })
    }

    /// Materials of the faces, those of the spacecraft in their places.
    pub fn materials(&self) -> &[Material] {
        &self.faces.materials
    }

    /// Sets the material in this place of the spacecraft's.
    pub fn set_material(&mut self, place: usize, material: &Material) {
        self.faces.set_material(place, material);
    }

    /// Number of faces, hence of temperatures a thermal state has.
    pub fn face_count(&self) -> usize {
        self.faces.faces.len()
    }

    /// Names of the faces in their order: plates, sunshade, panels, the back of a surface after its front.
    pub fn face_names(&self) -> impl Iterator<Item = String> + '_ {
        self.faces.surfaces.iter().flat_map(|surface| {
            let rear = (surface.faces.len() == 2).then(|| format!("{}, rear", surface.name));
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
        let directions = if self.sun_disc { DIRECTIONS } else { 1 };
        let shadows =
            self.scene.as_ref().map_or(0, |scene| (directions * scene.candidate_pairs()) as u32 / 200);
        1 + faces / 8 + planet + shadows
    }

    /// Refuses a model whose evaluation takes more than `limit_units` of work, of about a microsecond each.
    ///
    /// # Errors
    /// More work than that.
    pub fn within(self, limit_units: u32) -> Result<Self, Refusal> {
        let units = self.evaluation_units();
        if units > limit_units {
            let found = format_args!("one evaluation takes {units} units of work");
            return Err(Refusal::new(found, limit_units));
        }
        Ok(self)
    }

    /// Whether any surface can shadow another at some direction of the Sun and angle of the panels.
    pub fn can_shadow(&self) -> bool {
        self.scene.is_some()
    }

    /// Whether any face stores heat, so that [`super::Recoil::Stored`] differs from balance.
    pub fn stores_heat(&self) -> bool {
        self.faces.surfaces.iter().any(|surface| surface.thermal.heat_capacity_j_m2_k > 0.0)
    }

    /// Force and torque about the centre of mass by effect; by face in the workspace.
    ///
    /// Does not allocate once the workspace has been used, unless surfaces shadow one another.
    ///
    /// # Errors
    /// A geometry without meaning: not finite, spacecraft inside the planet, Sun without direction, wrong number of
    /// angles or temperatures.
    pub fn evaluate<T: Scalar>(
        &self,
        geometry: &Geometry<'_, T>,
        recoil: Recoil<'_>,
        workspace: &mut Workspace<T>,
    ) -> Result<Loads<T>, Refusal> {
        let surface = self.planet.map(|surface| surface.constant());
        self.evaluate_on(surface.as_ref(), None, geometry, recoil, workspace)
    }

    /// As [`DisturbanceModel::evaluate`] with these materials instead of the model's, in the order of
    /// [`DisturbanceModel::materials`], near a planet of this surface; both may depend on the seed, and neither is checked.
    ///
    /// # Errors
    /// Too few materials; see [`DisturbanceModel::evaluate`].
    pub fn evaluate_on<T: Scalar>(
        &self,
        surface: Option<&PlanetSurface<T>>,
        materials: Option<&[Material<T>]>,
        geometry: &Geometry<'_, T>,
        recoil: Recoil<'_>,
        workspace: &mut Workspace<T>,
    ) -> Result<Loads<T>, Refusal> {
        workspace.materials.clear();
        if let Some(materials) = materials {
            workspace.materials.extend_from_slice(materials);
        } else {
            workspace.materials.extend(self.faces.materials.iter().map(|own| own.map(T::constant)));
        }
        let (found, allowed) = (workspace.materials.len(), self.faces.materials.len());
        if found != allowed {
            return Err(Refusal::new(format_args!("{found} materials"), allowed));
        }
        geometry.check(self.faces.panels.len())?;
        self.check_temperatures(recoil)?;
        workspace.prepare(self.faces.normals.len(), self.faces.faces.len());
        self.faces.turn_normals(geometry.panel_angles_rad, &mut workspace.normals);
        self.light_planet(surface, geometry, workspace)?;
        if let Some(scene) = &self.scene {
            let (sun, angles_rad) = (&geometry.sun_direction_body, geometry.panel_angles_rad);
            if self.sun_disc {
                let disc = SunDisc::new(sun, geometry.sun_sine);
                scene.evaluate_disc(&disc, angles_rad, &mut workspace.shadow);
            } else {
                scene.evaluate(sun, angles_rad, &mut workspace.shadow);
            }
        }
        let loads = self.loads(geometry);
        let mut sum = loads.receive(workspace);
        sum[Effect::Thermal] = loads.radiate(recoil, workspace);
        if let Some(cylinder) = &self.faces.cylinder {
            let beam = geometry.beam();
            let beam = Beam { pressure_pa: beam.pressure_pa * geometry.solar_scale, ..beam };
            let optics = &workspace.materials[cylinder.material].optics;
            let sunlight = cylinder.force_torque_about_origin(optics, &beam);
            sum[Effect::Solar] += sunlight.about(&geometry.center_of_mass_body_m);
        }
        Ok(sum)
    }

    /// Recoil of heat anew for the light of the last evaluation, at other temperatures.
    ///
    /// # Errors
    /// Not one temperature for each face, or a workspace of another model.
    pub fn recoil<T: Scalar>(
        &self,
        geometry: &Geometry<'_, T>,
        recoil: Recoil<'_>,
        workspace: &mut Workspace<T>,
    ) -> Result<ForceTorque<T>, Refusal> {
        self.check_temperatures(recoil)?;
        self.check_faces(workspace.faces.len())?;
        Ok(self.loads(geometry).radiate(recoil, workspace))
    }

    /// Heat every face takes in, in W, as of the last evaluation: absorbed light and heat from inside. Written to
    /// `heat_w`, face by face, as far as both reach.
    pub fn heat_w(&self, workspace: &Workspace<f64>, heat_w: &mut [f64]) {
        for ((heat_w, state), face) in heat_w.iter_mut().zip(&workspace.faces).zip(&self.faces.faces) {
            *heat_w = state.absorbed_sun_w + state.absorbed_planet_w + face.internal_heat_w;
        }
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
            let heat_w = [start_heat_w, end_heat_w];
            surface.advance_temperatures(&self.faces, temperatures_k, heat_w, duration_s);
        }
    }

    fn check_temperatures(&self, recoil: Recoil<'_>) -> Result<(), Refusal> {
        match recoil {
            Recoil::Stored(temperatures_k) => self.check_faces(temperatures_k.len()),
            Recoil::Balance | Recoil::Ignored => Ok(()),
        }
    }

    fn check_faces(&self, found: usize) -> Result<(), Refusal> {
        let allowed = self.face_count();
        if found == allowed {
            return Ok(());
        }
        let found = format_args!("{found} face temperatures");
        Err(Refusal::new(found, format_args!("{allowed}, one for each face")))
    }

    fn loads<'a, T: Scalar>(&'a self, geometry: &'a Geometry<'a, T>) -> FaceLoads<'a, T> {
        FaceLoads { faces: &self.faces, geometry, shadowing: self.scene.is_some() }
    }

    /// Planet light for every distinct normal.
    fn light_planet<T: Scalar>(
        &self,
        surface: Option<&PlanetSurface<T>>,
        geometry: &Geometry<'_, T>,
        workspace: &mut Workspace<T>,
    ) -> Result<(), Refusal> {
        let (Some(surface), Some(planet)) = (surface, &geometry.planet) else {
            workspace.lights.fill(PlanetLight::dark());
            return Ok(());
        };
        let planet_source = self.planet_light.planet_source(surface, planet)?;
        for (index, normal) in workspace.normals.iter().enumerate() {
            // Panels that stand alike, or like a plate, see the same.
            let turns = !matches!(self.faces.normals[index], Normal::Fixed(_));
            let alike =
                turns.then(|| workspace.normals[..index].iter().position(|known| same(known, normal)));
            let known = alike.flatten().map(|known| workspace.lights[known]);
            workspace.lights[index] = known.unwrap_or_else(|| planet_source.receive(normal));
        }
        Ok(())
    }
}

fn same<T: Scalar>(a: &Vector3<T>, b: &Vector3<T>) -> bool {
    a.iter().zip(b.iter()).all(|(a, b)| a.same(*b))
}
