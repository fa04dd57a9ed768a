//! Sunlight on the whole spacecraft: direct sum over plates, cylinder and panels (paper 000, eqs 1, 2, 10, 12).
//!
//! No surface shadows another here; a face is lit when the Sun is in front of it.

use nalgebra::Vector3;

use super::cylinder::CylinderFace;
use super::faces::{Faces, Normal};
use super::flat_plate::{Beam, force_per_area_pa};
use crate::loads::ForceTorque;
use crate::numerics::scalar::{Scalar, constant_vector};
use crate::refusal::Refusal;
use crate::spacecraft::{Material, Optics, Panel, Spacecraft, SunshadeModel};

/// A spacecraft prepared for sunlight: whatever does not change is computed once.
///
/// Evaluation does not allocate and costs a few nanoseconds a face.
#[derive(Clone, Debug, PartialEq)]
pub struct SolarModel {
    /// The spacecraft's materials in its order, then materials of faces without a named one.
    materials: Vec<Material>,
    fixed: Vec<FixedFace>,
    /// Area in m2 and material of every fixed face.
    fixed_surfaces: Vec<(f64, usize)>,
    cylinder: Option<CylinderFace>,
    panels: Vec<Panel>,
}

/// A face fixed in the body frame, everything constant of the flat-plate law multiplied out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct FixedFace {
    normal: Vector3<f64>,
    center_m: Vector3<f64>,
    /// center x normal, in m.
    arm_m: Vector3<f64>,
    /// A (alpha + gD): along the light, per cos, in m2.
    light_m2: f64,
    /// (2/3) A gD: along the normal, per cos, in m2.
    diffuse_m2: f64,
    /// 2 A gS: along the normal, per cos^2, in m2.
    specular_m2: f64,
}

impl SolarModel {
    /// Prepares a spacecraft, with the sunshade in this form or in the one its file chooses; a spacecraft without a sunshade
    /// takes any.
    ///
    /// # Errors
    /// The file has a sunshade but not in this form.
    pub fn new(spacecraft: &Spacecraft, form: Option<SunshadeModel>) -> Result<Self, Refusal> {
        let Faces { surfaces, faces, materials, normals, cylinder, panels, .. } =
            Faces::new(spacecraft, form)?;
        let fixed = faces.iter().filter_map(|face| match (normals[face.normal], &surfaces[face.surface]) {
            (Normal::Fixed(normal), surface) if !surface.closed_form_sun => {
                let (center_m, area_m2) = (surface.center_body_m, surface.area_m2);
                let dark =
                    FixedFace { normal, center_m, arm_m: center_m.cross(&normal), ..FixedFace::default() };
                let fixed = dark.with_optics(area_m2, &materials[face.material].optics);
                Some((fixed, (area_m2, face.material)))
            }
            _ => None,
        });
        let (fixed, fixed_surfaces) = fixed.unzip();
        Ok(Self { materials, fixed, fixed_surfaces, cylinder, panels })
    }

    /// Materials of the faces, those of the spacecraft in their places.
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// Sets the spacecraft's material of this index if it differs from the present one; allocates nothing.
    pub fn set_material(&mut self, place: usize, material: &Material) {
        let Some(known) = self.materials.get_mut(place).filter(|known| *known != material) else { return };
        *known = *material;
        for (face, (area_m2, of_face)) in self.fixed.iter_mut().zip(&self.fixed_surfaces) {
            if *of_face == place {
                *face = face.with_optics(*area_m2, &material.optics);
            }
        }
        for panel in &mut self.panels {
            let [front, rear] = panel.faces.materials.map(|of_side| of_side == Some(place));
            if front {
                panel.faces.optics = material.optics;
            }
            if let Some(optics) = panel.faces.rear_optics.as_mut().filter(|_| rear) {
                *optics = material.optics;
            }
        }
    }

    /// Number of faces: those of plates, shade and panels, rear faces by themselves.
    pub fn face_count(&self) -> usize {
        self.fixed.len() + usize::from(self.cylinder.is_some()) + 2 * self.panels.len()
    }

    /// On all surfaces, about the centre of mass (body frame, m); `normal_body` gives the unit normal of each panel's cell side
    /// (by index), `None` for a panel that is left out.
    #[inline]
    pub fn load<T: Scalar>(
        &self,
        beam: &Beam<T>,
        normal_body: impl Fn(usize, &Panel) -> Option<Vector3<T>>,
        center_of_mass_body_m: &Vector3<T>,
    ) -> ForceTorque<T> {
        let mut sum = self.fixed_about_origin(beam);
        if let Some(cylinder) = &self.cylinder {
            let optics = self.materials[cylinder.material].optics.map(T::constant);
            sum += cylinder.force_torque_about_origin(&optics, beam);
        }
        let mut sum = sum.about(center_of_mass_body_m);
        for (index, panel) in self.panels.iter().enumerate() {
            if let Some(normal) = normal_body(index, panel) {
                let arm_m = constant_vector::<T>(&panel.center_body_m) - center_of_mass_body_m;
                sum += ForceTorque::at_arm(&arm_m, panel_force_n(panel, beam, normal));
            }
        }
        sum
    }

    /// On the faces fixed in the body, about the body frame's origin. The cross product with the light's direction is the
    /// same for every face and waits until after the sum.
    fn fixed_about_origin<T: Scalar>(&self, beam: &Beam<T>) -> ForceTorque<T> {
        let sun = &beam.source_body;
        let mut light_area = T::constant(0.0);
        let mut light_moment = Vector3::<T>::zeros();
        let mut normal_area = Vector3::<T>::zeros();
        let mut normal_moment = Vector3::<T>::zeros();
        for face in &self.fixed {
            let cos = sun.x * face.normal.x + sun.y * face.normal.y + sun.z * face.normal.z;
            if cos.value() <= 0.0 {
                continue;
            }
            let along_light = cos * face.light_m2;
            let along_normal = cos * (cos * face.specular_m2 + face.diffuse_m2);
            light_area += along_light;
            add_scaled(&mut light_moment, &face.center_m, along_light);
            add_scaled(&mut normal_area, &face.normal, along_normal);
            add_scaled(&mut normal_moment, &face.arm_m, along_normal);
        }
        ForceTorque {
            force_body_n: -(sun * light_area + normal_area) * beam.pressure_pa,
            torque_body_n_m: -(light_moment.cross(sun) + normal_moment) * beam.pressure_pa,
        }
    }
}

impl FixedFace {
    fn with_optics(self, area_m2: f64, optics: &Optics) -> Self {
        Self {
            light_m2: area_m2 * (optics.absorptivity + optics.diffuse),
            diffuse_m2: area_m2 * optics.diffuse * 2.0 / 3.0,
            specular_m2: area_m2 * optics.specular * 2.0,
            ..self
        }
    }
}

/// On the side of a panel that looks at the Sun, in N.
#[inline]
fn panel_force_n<T: Scalar>(panel: &Panel, beam: &Beam<T>, normal: Vector3<T>) -> Vector3<T> {
    let is_front = normal.dot(&beam.source_body).value() > 0.0;
    let (normal, optics) = if is_front {
        (normal, Some(&panel.faces.optics))
    } else {
        (-normal, panel.faces.rear_optics.as_ref())
    };
    optics.map_or_else(Vector3::zeros, |optics| {
        force_per_area_pa(&optics.map(T::constant), &normal, &beam.received(&normal))
            * T::constant(panel.area_m2)
    })
}

#[inline]
fn add_scaled<T: Scalar>(sum: &mut Vector3<T>, constant: &Vector3<f64>, factor: T) {
    *sum += constant.map(|component| factor * component);
}
