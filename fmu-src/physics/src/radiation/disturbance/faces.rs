//! The spacecraft taken apart into faces.

use nalgebra::Vector3;

use crate::radiation::shadow::{Hinge, Outline};
use crate::radiation::thermal::balance::FaceEnvironment;
use crate::radiation::thermal::transient::HeatStore;
use crate::spacecraft::{
    BusLink, Cylinder, Emission, FaceThermal, Optics, Panel, Plate, Spacecraft, SunshadeModel, Thermal,
};

/// Strips a cylindrical shade is cut into for planet light and heat; sunlight on it has a closed form.
const CYLINDER_STRIPS: u32 = 24;

/// One side of a surface.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Face {
    /// Which of the distinct normals.
    pub normal: usize,
    /// Which of the surfaces.
    pub surface: usize,
    /// Sunlight's optics.
    pub optics: Optics,
    /// Infrared optics and emission.
    pub thermal: FaceThermal,
    /// Heat from inside, in W.
    pub internal_heat_w: f64,
}

/// A plate, panel or strip with one or two faces.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Surface {
    pub name: String,
    pub area_m2: f64,
    pub center_body_m: Vector3<f64>,
    /// First of its faces; the rear follows the front.
    pub first_face: usize,
    pub two_sided: bool,
    pub thermal: Thermal,
    /// Temperature of the space it sees, in K.
    pub background_k: f64,
    /// Whether sunlight's force on it is computed elsewhere, in closed form.
    pub closed_form_sun: bool,
    /// Index of its outline among the outlines, if it has one.
    pub outline: Option<usize>,
}

impl Surface {
    /// What front and rear give off heat to; a face there is not gives off none.
    pub fn surroundings(&self) -> [FaceEnvironment; 2] {
        let Thermal { front, rear, bus, .. } = &self.thermal;
        let rear = rear.map_or(Emission::constant(0.0), |rear| rear.emission);
        let face = |emission, bus| FaceEnvironment { emission, background_k: self.background_k, bus };
        let rear_bus = if self.two_sided { bus[1] } else { BusLink::NONE };
        [face(front.emission, bus[0]), face(rear, rear_bus)]
    }

    /// Temperatures of its faces `duration_s` later, in place, for the heat of every face at the start and at the end; left
    /// as they are where it stores no heat.
    pub fn advance_temperatures(&self, temperatures_k: &mut [f64], heat_w: [&[f64]; 2], duration_s: f64) {
        if self.thermal.heat_capacity_j_m2_k <= 0.0 {
            return;
        }
        let first = self.first_face;
        let count = if self.two_sided { 2 } else { 1 };
        let pick = |values: &[f64], scale: f64| {
            let at = |side: usize| values.get(first + side).map_or(0.0, |value| value * scale);
            if count == 2 { [at(0), at(1)] } else { [at(0), 0.0] }
        };
        let store = HeatStore {
            faces: self.surroundings(),
            conduction: self.thermal.conduction,
            heat_capacity_j_m2_k: self.thermal.heat_capacity_j_m2_k,
        };
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

/// Where a normal comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Normal {
    /// Fixed in the body.
    Fixed(Vector3<f64>),
    /// Cell side of a panel.
    Front(usize),
    /// Back of a panel.
    Rear(usize),
}

/// Surfaces, faces and distinct normals of a spacecraft: plates, sunshade, panels, in this order.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Faces {
    pub surfaces: Vec<Surface>,
    pub faces: Vec<Face>,
    pub normals: Vec<Normal>,
    /// Temperature of the space that all of them see, in K.
    pub background_k: f64,
    /// Outlines: surface and, for panels, which.
    pub outlines: Vec<(usize, Option<usize>)>,
}

impl Faces {
    pub fn new(spacecraft: &Spacecraft, sunshade_model: Option<SunshadeModel>) -> Self {
        let mut faces = Self { background_k: spacecraft.background_k, ..Self::default() };
        for plate in &spacecraft.plates {
            faces.add_plate(plate, false);
        }
        if let Some(shade) = &spacecraft.sunshade {
            match (sunshade_model.unwrap_or(shade.model), &shade.cylinder) {
                (SunshadeModel::Cylinder, Some(cylinder)) => {
                    for strip in strips(cylinder) {
                        faces.add_plate(&strip.rotated(&shade.dcm_body_from_shade), true);
                    }
                }
                _ => {
                    for plate in &shade.plates {
                        faces.add_plate(&plate.rotated(&shade.dcm_body_from_shade), false);
                    }
                }
            }
        }
        for (index, panel) in spacecraft.panels.iter().enumerate() {
            faces.add_panel(index, panel);
        }
        faces
    }

    fn add_plate(&mut self, plate: &Plate, closed_form_sun: bool) {
        self.add(
            Surface {
                name: plate.name.clone(),
                area_m2: plate.area_m2,
                center_body_m: plate.center_m,
                first_face: self.faces.len(),
                two_sided: plate.rear_optics.is_some(),
                thermal: plate.thermal,
                background_k: self.background_k,
                closed_form_sun,
                outline: plate.polygon.as_ref().map(|_| self.outlines.len()),
            },
            [plate.optics, plate.rear_optics.unwrap_or(plate.optics)],
            [Normal::Fixed(plate.normal), Normal::Fixed(-plate.normal)],
            None,
        );
    }

    fn add_panel(&mut self, index: usize, panel: &Panel) {
        self.add(
            Surface {
                name: panel.name.clone(),
                area_m2: panel.area_m2,
                center_body_m: panel.center_body_m,
                first_face: self.faces.len(),
                two_sided: panel.rear_optics.is_some(),
                thermal: panel.thermal,
                background_k: self.background_k,
                closed_form_sun: false,
                outline: panel.polygon.as_ref().map(|_| self.outlines.len()),
            },
            [panel.optics, panel.rear_optics.unwrap_or(panel.optics)],
            [Normal::Front(index), Normal::Rear(index)],
            Some(index),
        );
    }

    fn add(&mut self, surface: Surface, optics: [Optics; 2], normals: [Normal; 2], panel: Option<usize>) {
        let index = self.surfaces.len();
        let thermals = [surface.thermal.front, surface.thermal.rear.unwrap_or(surface.thermal.front)];
        for side in 0..if surface.two_sided { 2 } else { 1 } {
            let normal = self.normal(normals[side]);
            self.faces.push(Face {
                normal,
                surface: index,
                optics: optics[side],
                thermal: thermals[side],
                internal_heat_w: surface.thermal.internal_heat_w[side],
            });
        }
        if surface.outline.is_some() {
            self.outlines.push((index, panel));
        }
        self.surfaces.push(surface);
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
        let normal = Vector3::new(angle_rad.sin(), -angle_rad.cos(), 0.0);
        Plate {
            name: format!("shade strip {}", i + 1),
            area_m2: cylinder.radius_m * width_rad * cylinder.height_m,
            center_m: normal * cylinder.radius_m,
            normal,
            optics: cylinder.optics,
            rear_optics: None,
            thermal: Thermal::insulated(&cylinder.optics, None),
            polygon: None,
        }
    })
}

/// Outlines of plates and panels in the order of the faces' outlines.
pub(super) fn outlines(faces: &Faces, spacecraft: &Spacecraft, form: Option<SunshadeModel>) -> Vec<Outline> {
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
