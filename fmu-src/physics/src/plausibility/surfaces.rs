//! The flat surfaces of a spacecraft where they are with the Sun on -Y, with corners.

use core::f64::consts::FRAC_PI_4;

use nalgebra::{Rotation3, Unit, Vector3};

use crate::math;
use crate::spacecraft::{Cylinder, Panel, PanelControl, Plate, Polygon, Spacecraft, SunshadeModel, frame};

/// A flat surface in the body frame.
#[derive(Clone, Debug)]
pub(super) struct Surface {
    /// Plate in the body frame; of a panel with the outline at angle 0.
    pub plate: Plate,
    /// Corners of its outline, or of a square of its area where it has none, body frame, in m.
    pub corners_m: Vec<Vector3<f64>>,
}

impl Surface {
    fn new(plate: Plate) -> Self {
        Self { corners_m: corners(&plate), plate }
    }

    /// How far a corner was off the outline's plane as the file has it, in m.
    pub(super) fn off_plane_m(&self) -> f64 {
        self.plate.polygon.as_ref().map_or(0.0, Polygon::off_plane_m)
    }
}

/// Facets of a cylindrical sunshade.
const STRIPS: u32 = 24;

/// Toward the Sun.
pub(super) fn sun_body() -> Vector3<f64> {
    -Vector3::y()
}

/// The angle of a panel about its axis that the file asks for with the Sun on -Y, in rad.
pub(super) fn panel_angle_rad(panel: &Panel) -> f64 {
    match panel.control {
        PanelControl::Angle => panel.angle_rad,
        PanelControl::SunOffset | PanelControl::Command | PanelControl::Timeline | PanelControl::Distance => {
            panel.angle_for_sun_offset(&sun_body(), panel.sun_offset_rad, panel.tilt_sign)
        }
    }
}

/// Plates, the sunshade in the form that the file chooses, and panels.
pub(super) fn surfaces(spacecraft: &Spacecraft) -> Vec<Surface> {
    let form = spacecraft.sunshade.as_ref().map_or(SunshadeModel::Plates, |shade| shade.model);
    let mut found: Vec<Surface> = spacecraft.plates_body(form).into_iter().map(Surface::new).collect();
    if let (SunshadeModel::Cylinder, Some(shade)) = (form, &spacecraft.sunshade) {
        let strips = shade.cylinder.iter().flat_map(strips);
        found.extend(strips.map(|strip| Surface::new(strip.rotated(&shade.dcm_body_from_shade))));
    }
    found.extend(spacecraft.panels.iter().map(of_panel));
    found
}

fn of_panel(panel: &Panel) -> Surface {
    let turn = Rotation3::from_axis_angle(&Unit::new_unchecked(panel.axis_body), panel_angle_rad(panel));
    let center_m = panel.center_body_m;
    let Surface { plate, corners_m } = Surface::new(panel.plate_at_zero());
    let turned = |corner: &Vector3<f64>| center_m + turn * (corner - center_m);
    let corners_m = corners_m.iter().map(turned).collect();
    Surface { plate: Plate { normal: turn * plate.normal, ..plate }, corners_m }
}

fn corners(plate: &Plate) -> Vec<Vector3<f64>> {
    if let Some(outline) = &plate.polygon {
        return outline.vertices_m().to_vec();
    }
    let (center_m, normal) = (&plate.center_m, &plate.normal);
    let axes = frame(normal);
    let (east, north) = (axes.column(0), axes.column(1));
    let half_diagonal_m = (plate.area_m2 / 2.0).sqrt();
    let corner = |k: u8| {
        let (sin, cos) = math::sin_cos(f64::from(2 * k + 1) * FRAC_PI_4);
        center_m + (east * cos + north * sin) * half_diagonal_m
    };
    (0..4).map(corner).collect()
}

/// The section of a cylinder as flat strips of its area, in the shade frame.
fn strips(cylinder: &Cylinder) -> impl Iterator<Item = Plate> + '_ {
    let width_rad = 2.0 * cylinder.half_angle_rad / f64::from(STRIPS);
    (0..STRIPS).filter_map(move |k| {
        let edge = |k: u32| {
            let (sin, cos) = math::sin_cos(-cylinder.half_angle_rad + width_rad * f64::from(k));
            Vector3::new(sin, -cos, 0.0) * cylinder.radius_m
        };
        let up_m = Vector3::z() * (cylinder.height_m / 2.0);
        let (from, to) = (edge(k), edge(k + 1));
        let outline = Polygon::new(vec![from - up_m, to - up_m, to + up_m, from + up_m]).ok()?;
        let name = format!("sunshade strip {}", k + 1);
        let area_m2 = cylinder.radius_m * width_rad * cylinder.height_m;
        Some(Plate { area_m2, ..Plate::outlined(name, outline, cylinder.optics, None) })
    })
}
