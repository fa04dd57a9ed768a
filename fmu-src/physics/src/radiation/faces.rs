//! The spacecraft taken apart into faces, for light, heat and air.

use core::ops::Range;

use nalgebra::Vector3;

use super::cylinder::CylinderFace;
use super::shadow::{Hinge, Outline, ShadowScene};
use super::thermal::balance::FaceEnvironment;
use super::thermal::transient::HeatStore;
use crate::math;
use crate::numerics::scalar::{Scalar, constant_vector};
use crate::refusal::Refusal;
use crate::spacecraft::{
    BusLink, Cylinder, Emission, FaceProperties, Material, Panel, Plate, Spacecraft, SunshadeModel, Thermal,
};

/// Strips a cylindrical shade is cut into for planet light and heat; sunlight on it has a closed form.
const CYLINDER_STRIPS: u32 = 24;

/// One side of a surface.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Face {
    /// Index of its normal among the distinct ones.
    pub normal: usize,
    /// Index of its surface.
    pub surface: usize,
    /// Index of its material.
    pub material: usize,
    /// Heat from inside, in W.
    pub internal_heat_w: f64,
}

/// A plate, panel or strip with one or two faces.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Surface {
    pub name: String,
    pub area_m2: f64,
    pub center_body_m: Vector3<f64>,
    /// Its faces among all; the rear follows the front.
    pub faces: Range<usize>,
    pub thermal: Thermal,
    /// Temperature of the space it sees, in K.
    pub background_k: f64,
    /// Whether sunlight's force on it is computed elsewhere, in closed form.
    pub closed_form_sun: bool,
    /// Index of its outline among the outlines, if it has one.
    pub outline: Option<usize>,
}

impl Surface {
    /// Returns the thermal surroundings of front and rear from the surface's own `faces`; a missing face emits no heat.
    pub(super) fn environments<T: Scalar>(
        &self,
        faces: &[Face],
        materials: &[Material<T>],
    ) -> [FaceEnvironment<T>; 2] {
        [0, 1].map(|side| {
            let face = faces.get(side);
            let none = || Emission::constant(0.0).map(T::constant);
            let emission = face.map_or_else(none, |face| materials[face.material].thermal.emission);
            let bus = face.map_or(BusLink::NONE, |_| self.thermal.bus[side]);
            FaceEnvironment { emission, background_k: self.background_k, bus }
        })
    }

    /// Advances the temperatures of the surface's faces by `duration_s` in place, from the heat of every face at the start and at the end;
    /// `temperatures_k` has those of `all` faces. Does nothing where the surface stores no heat.
    pub(super) fn advance_temperatures(
        &self,
        all: &Faces,
        temperatures_k: &mut [f64],
        heat_w: [&[f64]; 2],
        duration_s: f64,
    ) {
        let Thermal { conduction, heat_capacity_j_m2_k, .. } = self.thermal;
        if heat_capacity_j_m2_k <= 0.0 {
            return;
        }
        let (first, count) = (self.faces.start, self.faces.len());
        let pick = |values: &[f64], scale: f64| {
            let at = |side: usize| values.get(first + side).map_or(0.0, |value| value * scale);
            if count == 2 { [at(0), at(1)] } else { [at(0), 0.0] }
        };
        let faces = self.environments(&all.faces[self.faces.clone()], &all.materials);
        let store = HeatStore { faces, conduction, heat_capacity_j_m2_k };
        let per_area = 1.0 / self.area_m2;
        let heat = heat_w.map(|heat_w| pick(heat_w, per_area));
        let next = store.advance(pick(temperatures_k, 1.0), heat, duration_s);
        for (side, value) in next.into_iter().enumerate().take(count) {
            if let Some(temperature_k) = temperatures_k.get_mut(first + side) {
                *temperature_k = value;
            }
        }
    }
}

/// Source of a normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Normal {
    /// Fixed in the body.
    Fixed(Vector3<f64>),
    /// Cell side of a panel.
    Front(usize),
    /// Back of a panel.
    Rear(usize),
}

/// Refuses a form of the sunshade that the spacecraft's file does not give.
pub(super) fn no_such_sunshade(form: SunshadeModel) -> Refusal {
    Refusal::new(format_args!("the spacecraft's file does not describe its sunshade as {form:?}"), "")
}

/// Surfaces, faces and distinct normals of a spacecraft: plates, sunshade, panels, in this order.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Faces {
    pub surfaces: Vec<Surface>,
    pub faces: Vec<Face>,
    /// The spacecraft's materials in its order, then materials of faces without a named one.
    pub materials: Vec<Material>,
    pub normals: Vec<Normal>,
    /// Temperature of the space that all of them see, in K.
    pub background_k: f64,
    pub outlines: Vec<Outline>,
    pub panels: Vec<Panel>,
    /// A cylindrical shade, on which sunlight has a closed form.
    pub(super) cylinder: Option<CylinderFace>,
}

impl Faces {
    /// With the sunshade in this form, or in the one its file chooses; a spacecraft without a sunshade takes any.
    ///
    /// # Errors
    /// The file has a sunshade but not in this form.
    pub(crate) fn new(spacecraft: &Spacecraft, form: Option<SunshadeModel>) -> Result<Self, Refusal> {
        let materials = spacecraft.materials.iter().map(|named| named.material).collect();
        let mut faces = Self { background_k: spacecraft.background_k, materials, ..Self::default() };
        for plate in &spacecraft.plates {
            faces.add_plate(plate);
        }
        if let Some(shade) = &spacecraft.sunshade {
            let form = form.unwrap_or(shade.model);
            if !shade.has(form) {
                return Err(no_such_sunshade(form));
            }
            let dcm_body_from_shade = shade.dcm_body_from_shade;
            let cylinder = shade.cylinder.filter(|_| form == SunshadeModel::Cylinder);
            faces.cylinder = cylinder.map(|cylinder| {
                let Cylinder { optics, thermal, gas_surface, .. } = cylinder;
                let material = faces.material(cylinder.material, Material { optics, thermal, gas_surface });
                CylinderFace { cylinder, material, dcm_body_from_shade }
            });
            let plates = cylinder.map_or(shade.plates.clone(), |cylinder| strips(&cylinder).collect());
            for plate in plates {
                faces.add_plate(&plate.rotated(&dcm_body_from_shade));
            }
        }
        faces.panels = spacecraft.panels.clone();
        for (index, panel) in spacecraft.panels.iter().enumerate() {
            let hinge = Hinge { panel: index, point_body_m: panel.center_body_m, axis_body: panel.axis_body };
            faces.add(&panel.plate_at_zero(), [Normal::Front(index), Normal::Rear(index)], Some(hinge));
        }
        Ok(faces)
    }

    /// The distinct normals with the panels at these angles, body frame; 0 for a panel without an angle.
    pub(crate) fn turn_normals<T: Scalar>(&self, panel_angles_rad: &[T], normals_body: &mut [Vector3<T>]) {
        let turned = |panel: usize| {
            let angle_rad = panel_angles_rad.get(panel).copied().unwrap_or(T::constant(0.0));
            self.panels.get(panel).map_or(Vector3::zeros(), |panel| panel.normal_body(angle_rad))
        };
        for (normal, source) in normals_body.iter_mut().zip(&self.normals) {
            *normal = match *source {
                Normal::Fixed(fixed) => constant_vector(&fixed),
                Normal::Front(panel) => turned(panel),
                Normal::Rear(panel) => -turned(panel),
            };
        }
    }

    /// Moves the outlines into a scene of shadows; `None` where no surface can shadow another.
    pub(crate) fn extract_scene(&mut self) -> Option<ShadowScene> {
        let scene = ShadowScene::new(core::mem::take(&mut self.outlines));
        (scene.candidate_pairs() > 0).then_some(scene)
    }

    /// Sets the spacecraft's material of this index.
    pub(crate) fn set_material(&mut self, place: usize, material: &Material) {
        if let Some(known) = self.materials.get_mut(place) {
            *known = *material;
        }
    }

    /// Returns the index of a surface's material: that in the spacecraft's list, or a new entry where the surface was given another.
    fn material(&mut self, place: Option<usize>, material: Material) -> usize {
        place.filter(|&place| self.materials.get(place) == Some(&material)).unwrap_or_else(|| {
            self.materials.push(material);
            self.materials.len() - 1
        })
    }

    fn add_plate(&mut self, plate: &Plate) {
        self.add(plate, [Normal::Fixed(plate.normal), Normal::Fixed(-plate.normal)], None);
    }

    fn add(&mut self, plate: &Plate, normals: [Normal; 2], hinge: Option<Hinge>) {
        let FaceProperties { optics, rear_optics, gas_surface, thermal, materials } = plate.faces;
        let Thermal { front, rear, internal_heat_w, .. } = thermal;
        let sides = [Some((optics, front)), rear_optics.map(|optics| (optics, rear.unwrap_or(front)))];
        let first_face = self.faces.len();
        for (side, (optics, of_face)) in sides.into_iter().flatten().enumerate() {
            let normal = self.normal(normals[side]);
            let surface = self.surfaces.len();
            let material = Material { optics, thermal: of_face, gas_surface: gas_surface[side] };
            let material = self.material(materials[side], material);
            self.faces.push(Face { normal, surface, material, internal_heat_w: internal_heat_w[side] });
        }
        let two_sided = rear_optics.is_some();
        let outline = plate.polygon.clone().map(|polygon| Outline { polygon, hinge, two_sided });
        self.surfaces.push(Surface {
            name: plate.name.clone(),
            area_m2: plate.area_m2,
            center_body_m: plate.center_m,
            faces: first_face..self.faces.len(),
            thermal,
            background_k: self.background_k,
            // Plates come before a cylinder, panels have a hinge.
            closed_form_sun: self.cylinder.is_some() && hinge.is_none(),
            outline: outline.is_some().then_some(self.outlines.len()),
        });
        self.outlines.extend(outline);
    }

    fn normal(&mut self, normal: Normal) -> usize {
        self.normals.iter().position(|known| *known == normal).unwrap_or_else(|| {
            self.normals.push(normal);
            self.normals.len() - 1
        })
    }
}

/// Flat strips of a cylinder in the shade frame, of its area and with its mean normal.
fn strips(cylinder: &Cylinder) -> impl Iterator<Item = Plate> + '_ {
    let width_rad = 2.0 * cylinder.half_angle_rad / f64::from(CYLINDER_STRIPS);
    (0..CYLINDER_STRIPS).map(move |i| {
        let angle_rad = (f64::from(i) + 0.5) * width_rad - cylinder.half_angle_rad;
        let normal = Vector3::new(math::sin(angle_rad), -math::cos(angle_rad), 0.0);
        let name = format!("shade strip {}", i + 1);
        let area_m2 = cylinder.radius_m * width_rad * cylinder.height_m;
        let center_m = normal * cylinder.radius_m;
        let plate = Plate::insulated(name, area_m2, center_m, normal, (cylinder.optics, None));
        let thermal = Thermal { front: cylinder.thermal, ..plate.faces.thermal };
        let (gas_surface, materials) = ([cylinder.gas_surface; 2], [cylinder.material, None]);
        Plate { faces: FaceProperties { gas_surface, thermal, materials, ..plate.faces }, ..plate }
    })
}
