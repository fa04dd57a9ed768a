//! Sunlight on the whole spacecraft: direct sum over plates, cylinder and panels (paper 000, eqs 1, 2, 10, 12).
//!
//! No surface shadows another here; a face is lit when the Sun is in front of it.

use nalgebra::Vector3;

use super::cylinder::CylinderFace;
use super::flat_plate::Beam;
use crate::loads::ForceTorque;
use crate::numerics::scalar::{Scalar, constant_vector};
use crate::spacecraft::{Optics, Panel, Plate, Spacecraft, Sunshade, SunshadeModel};

/// A spacecraft prepared for sunlight: whatever does not change is computed once.
///
/// Evaluation does not allocate and costs a few nanoseconds a face.
#[derive(Clone, Debug, PartialEq)]
pub struct SolarModel {
    body: FaceSet,
    sunshade: Shade,
    panels: Vec<TurningPanel>,
}

/// A panel with what does not turn computed once.
#[derive(Clone, Debug, PartialEq)]
struct TurningPanel {
    zero_normal_body: Vector3<f64>,
    quarter_normal_body: Vector3<f64>,
    center_body_m: Vector3<f64>,
    cells: Areas,
    rear: Option<Areas>,
}

#[derive(Clone, Debug, PartialEq)]
enum Shade {
    None,
    Plates(FaceSet),
    Cylinder(CylinderFace),
}

/// A sunshade was requested in a form its file does not describe.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the spacecraft's file does not describe its sunshade as {0:?}")]
pub struct NoSuchSunshade(pub SunshadeModel);

impl SolarModel {
    /// Prepares a spacecraft, with the sunshade in the form its file chooses.
    pub fn new(spacecraft: &Spacecraft) -> Self {
        let sunshade = spacecraft.sunshade.as_ref();
        Self::with_shade(spacecraft, sunshade.map_or(Shade::None, |shade| Shade::new(shade, shade.model)))
    }

    /// Prepares a spacecraft with the sunshade in another form; a spacecraft without a sunshade takes any.
    ///
    /// # Errors
    ///
    /// The file has a sunshade but not in this form.
    pub fn with_sunshade_model(
        spacecraft: &Spacecraft,
        model: SunshadeModel,
    ) -> Result<Self, NoSuchSunshade> {
        match &spacecraft.sunshade {
            Some(shade) if !shade.has(model) => Err(NoSuchSunshade(model)),
            shade => Ok(Self::with_shade(
                spacecraft,
                shade.as_ref().map_or(Shade::None, |shade| Shade::new(shade, model)),
            )),
        }
    }

    fn with_shade(spacecraft: &Spacecraft, sunshade: Shade) -> Self {
        let panels = spacecraft.panels.iter().map(TurningPanel::new).collect();
        Self { body: FaceSet::new(&spacecraft.plates), sunshade, panels }
    }

    /// Number of faces: those of plates, shade and panels, rear faces by themselves.
    pub fn face_count(&self) -> usize {
        let shade = match &self.sunshade {
            Shade::Plates(faces) => faces.0.len(),
            _ => 1,
        };
        self.body.0.len() + shade + 2 * self.panels.len()
    }

    /// Number of panels, hence of angles [`SolarModel::total`] takes.
    pub fn panel_count(&self) -> usize {
        self.panels.len()
    }

    /// On the sunshade, about the centre of mass (body frame, m).
    pub fn sunshade<T: Scalar>(&self, beam: &Beam<T>, center_of_mass_body_m: &Vector3<T>) -> ForceTorque<T> {
        match &self.sunshade {
            Shade::None => ForceTorque::zero(),
            Shade::Plates(faces) => faces.force_torque_about_origin(beam),
            Shade::Cylinder(cylinder) => cylinder.force_torque_about_origin(beam),
        }
        .about(center_of_mass_body_m)
    }

    /// On the plates that do not belong to the sunshade, about the centre of mass.
    pub fn body<T: Scalar>(&self, beam: &Beam<T>, center_of_mass_body_m: &Vector3<T>) -> ForceTorque<T> {
        self.body.force_torque_about_origin(beam).about(center_of_mass_body_m)
    }

    /// On panel `index` (from 0) at an angle about its axis, about the centre of mass; nothing if there is no such panel.
    pub fn panel<T: Scalar>(
        &self,
        index: usize,
        beam: &Beam<T>,
        angle_rad: T,
        center_of_mass_body_m: &Vector3<T>,
    ) -> ForceTorque<T> {
        self.panels.get(index).map_or_else(ForceTorque::zero, |panel| {
            panel.force_torque(beam, angle_rad, center_of_mass_body_m)
        })
    }

    /// On everything, about the centre of mass; one angle about its axis, in rad, for each panel.
    pub fn total<T: Scalar>(
        &self,
        beam: &Beam<T>,
        panel_angles_rad: &[T],
        center_of_mass_body_m: &Vector3<T>,
    ) -> ForceTorque<T> {
        debug_assert_eq!(panel_angles_rad.len(), self.panels.len());
        let panels: ForceTorque<T> = self
            .panels
            .iter()
            .zip(panel_angles_rad)
            .map(|(panel, angle)| panel.force_torque(beam, *angle, center_of_mass_body_m))
            .sum();
        self.sunshade(beam, center_of_mass_body_m) + self.body(beam, center_of_mass_body_m) + panels
    }
}

impl Shade {
    fn new(shade: &Sunshade, model: SunshadeModel) -> Self {
        match (model, shade.cylinder) {
            (SunshadeModel::Cylinder, Some(cylinder)) => {
                Self::Cylinder(CylinderFace { cylinder, dcm_body_from_shade: shade.dcm_body_from_shade })
            }
            _ => {
                let plates: Vec<Plate> =
                    shade.plates.iter().map(|plate| plate.rotated(&shade.dcm_body_from_shade)).collect();
                Self::Plates(FaceSet::new(&plates))
            }
        }
    }
}

impl TurningPanel {
    fn new(panel: &Panel) -> Self {
        Self {
            zero_normal_body: panel.zero_normal_body,
            quarter_normal_body: panel.quarter_normal(),
            center_body_m: panel.center_body_m,
            cells: Areas::new(panel.area_m2, &panel.optics),
            rear: panel.rear_optics.map(|optics| Areas::new(panel.area_m2, &optics)),
        }
    }

    fn force_torque<T: Scalar>(
        &self,
        beam: &Beam<T>,
        angle_rad: T,
        center_of_mass_body_m: &Vector3<T>,
    ) -> ForceTorque<T> {
        let (sin, cos) = angle_rad.sin_cos();
        let mut normal = Vector3::<T>::zeros();
        add_scaled(&mut normal, &self.zero_normal_body, cos);
        add_scaled(&mut normal, &self.quarter_normal_body, sin);
        let cos_incidence = normal.dot(&beam.source_body);
        let areas = if cos_incidence.value() > 0.0 { Some(&self.cells) } else { self.rear.as_ref() };
        let Some(areas) = areas else { return ForceTorque::zero() };
        // Seen from behind, cosine and normal both change their sign: their product with each other does not.
        let facing = if cos_incidence.value() > 0.0 { 1.0 } else { -1.0 };
        let (along_light, along_normal) = areas.of(cos_incidence * facing);
        let force_n = -(beam.source_body * along_light + normal * (along_normal * facing)) * beam.pressure_pa;
        ForceTorque::at_arm(&(constant_vector::<T>(&self.center_body_m) - center_of_mass_body_m), force_n)
    }
}

/// The flat-plate law with area and optics multiplied out.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Areas {
    /// A (alpha + gD): along the light, per cos, in m2.
    light_m2: f64,
    /// (2/3) A gD: along the normal, per cos, in m2.
    diffuse_m2: f64,
    /// 2 A gS: along the normal, per cos^2, in m2.
    specular_m2: f64,
}

impl Areas {
    fn new(area_m2: f64, optics: &Optics) -> Self {
        Self {
            light_m2: area_m2 * (optics.absorptivity + optics.diffuse),
            diffuse_m2: area_m2 * optics.diffuse * 2.0 / 3.0,
            specular_m2: area_m2 * optics.specular * 2.0,
        }
    }

    /// Along the light and along the normal, in m2, at the cosine of the angle of incidence.
    #[inline]
    fn of<T: Scalar>(&self, cos: T) -> (T, T) {
        (cos * self.light_m2, cos * (cos * self.specular_m2 + self.diffuse_m2))
    }
}

/// Faces fixed in the body frame, rear faces listed as faces of their own.
#[derive(Clone, Debug, PartialEq)]
struct FaceSet(Vec<Face>);

/// A face with everything constant multiplied out.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Face {
    normal: Vector3<f64>,
    center_m: Vector3<f64>,
    /// center x normal, in m.
    arm_m: Vector3<f64>,
    areas: Areas,
}

impl Face {
    fn new(plate: &Plate, normal: Vector3<f64>, optics: &Optics) -> Self {
        Self {
            normal,
            center_m: plate.center_m,
            arm_m: plate.center_m.cross(&normal),
            areas: Areas::new(plate.area_m2, optics),
        }
    }
}

impl FaceSet {
    fn new(plates: &[Plate]) -> Self {
        let faces = plates.iter().flat_map(|plate| {
            let front = Face::new(plate, plate.normal, &plate.optics);
            let rear = plate.rear_optics.map(|optics| Face::new(plate, -plate.normal, &optics));
            [Some(front), rear].into_iter().flatten()
        });
        Self(faces.collect())
    }

    /// Force, and torque about the body frame's origin. The cross product with the light's direction is the same for
    /// every face and waits until after the sum.
    fn force_torque_about_origin<T: Scalar>(&self, beam: &Beam<T>) -> ForceTorque<T> {
        let sun = &beam.source_body;
        let mut light_area = T::constant(0.0);
        let mut light_moment = Vector3::<T>::zeros();
        let mut normal_area = Vector3::<T>::zeros();
        let mut normal_moment = Vector3::<T>::zeros();
        for face in &self.0 {
            let cos = sun.x * face.normal.x + sun.y * face.normal.y + sun.z * face.normal.z;
            if cos.value() <= 0.0 {
                continue;
            }
            let (along_light, along_normal) = face.areas.of(cos);
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

#[inline]
fn add_scaled<T: Scalar>(sum: &mut Vector3<T>, constant: &Vector3<f64>, factor: T) {
    sum.x += factor * constant.x;
    sum.y += factor * constant.y;
    sum.z += factor * constant.z;
}
