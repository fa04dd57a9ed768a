//! Surfaces light falls on: optics, flat plates, the cylindrical section and the sunshade made of either.

use nalgebra::{Matrix3, Vector3};
use serde::Serialize;

use super::gas_surface::GasSurface;
use super::optics::Optics;
use super::polygon::Polygon;
use super::thermal::{FaceThermal, Thermal};
use crate::enumeration::enumeration;

/// Most surfaces of a spacecraft, copies and facets of shapes among them.
pub const MOST_SURFACES: usize = 4000;

/// Light, heat and air of front and rear of a plate or panel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FaceProperties {
    /// Optics of the front face.
    pub optics: Optics,
    /// Optics of the rear face; `None` where no light can reach it.
    pub rear_optics: Option<Optics>,
    /// Front and rear in the air; the rear counts where light can reach it.
    pub gas_surface: [GasSurface; 2],
    /// Heat of both faces.
    pub thermal: Thermal,
    /// Places of the materials of front and rear among the spacecraft's; `None` for a face of no named material.
    pub materials: [Option<usize>; 2],
}

impl FaceProperties {
    /// Insulated faces of assumed accommodation and of no named material.
    pub fn insulated(optics: Optics, rear_optics: Option<Optics>) -> Self {
        let thermal = Thermal::insulated(&optics, rear_optics.as_ref());
        Self { optics, rear_optics, gas_surface: [GasSurface::ASSUMED; 2], thermal, materials: [None; 2] }
    }
}

/// A flat surface fixed in a frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plate {
    /// For messages and pictures.
    pub name: String,
    /// Area in m2.
    pub area_m2: f64,
    /// Centre of area from the frame's origin, in m.
    pub center_m: Vector3<f64>,
    /// Unit vector out of the front face.
    pub normal: Vector3<f64>,
    /// Its faces.
    pub faces: FaceProperties,
    /// Outline, counter-clockwise seen from the front; surfaces without one neither shadow nor are shadowed.
    pub polygon: Option<Polygon>,
}

impl Plate {
    /// One whose faces are insulated and of assumed accommodation, without an outline.
    pub fn insulated(
        name: String,
        area_m2: f64,
        center_m: Vector3<f64>,
        normal: Vector3<f64>,
        (optics, rear_optics): (Optics, Option<Optics>),
    ) -> Self {
        let faces = FaceProperties::insulated(optics, rear_optics);
        Self { name, area_m2, center_m, normal, faces, polygon: None }
    }

    /// One of this outline whose faces are insulated.
    pub fn outlined(name: String, outline: Polygon, optics: Optics, rear_optics: Option<Optics>) -> Self {
        let (area_m2, center_m, normal) = (outline.area_m2(), outline.centroid_m(), outline.normal());
        let plate = Self::insulated(name, area_m2, center_m, normal, (optics, rear_optics));
        Self { polygon: Some(outline), ..plate }
    }

    /// The same plate in another frame with the same origin.
    pub fn rotated(&self, rotation: &Matrix3<f64>) -> Self {
        Self {
            center_m: rotation * self.center_m,
            normal: rotation * self.normal,
            polygon: self.polygon.as_ref().map(|polygon| polygon.moved(|v| rotation * v)),
            ..self.clone()
        }
    }
}

/// Part of a cylinder's outside (paper 000, Figure 2a): axis along Z through the shade frame's origin, symmetric about
/// the XY plane, and about the -Y direction.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Cylinder {
    /// Radius R in m.
    pub radius_m: f64,
    /// Total height 2 h0 in m.
    pub height_m: f64,
    /// Half the angle subtended at the axis, theta0, in rad; up to pi.
    pub half_angle_rad: f64,
    /// Optics of the outside; the inside receives no light.
    pub optics: Optics,
    /// The outside in the air.
    pub gas_surface: GasSurface,
    /// The outside in the infrared.
    pub thermal: FaceThermal,
    /// Place of its material among the spacecraft's; `None` where it has no named one.
    pub material: Option<usize>,
}

enumeration! {
    /// Which description of the sunshade is used.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, serde::Deserialize)]
    #[serde(rename_all = "lowercase")]
    pub enum SunshadeModel {
        /// Flat plates.
        1 => Plates,
        /// Section of a cylinder.
        2 => Cylinder,
    }
}

/// A sunshade in its own frame, which shares the body frame's origin.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sunshade {
    /// The description used unless somebody chooses the other.
    pub model: SunshadeModel,
    /// Rotation Q_sh^sc: components in the shade frame to components in the body frame.
    pub dcm_body_from_shade: Matrix3<f64>,
    /// Plates in the shade frame; empty if the shade is described as cylinder only.
    pub plates: Vec<Plate>,
    /// The cylindrical section in the shade frame.
    pub cylinder: Option<Cylinder>,
}

impl Sunshade {
    /// Whether the shade is described this way.
    pub fn has(&self, model: SunshadeModel) -> bool {
        match model {
            SunshadeModel::Plates => !self.plates.is_empty(),
            SunshadeModel::Cylinder => self.cylinder.is_some(),
        }
    }
}
